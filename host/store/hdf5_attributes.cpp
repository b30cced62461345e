// Attributes and dimension scales of an hdf5_file.
#include "host/store/hdf5_types.hpp"

#include <hdf5_hl.h>

namespace hopscotch {

void hdf5_file::make_scale(const std::string& path, const std::string& name) {
    check(H5DSset_scale(dataset(path), name.c_str()), path + " cannot be made a dimension scale");
}

void hdf5_file::attach_scale(const std::string& path, const std::string& scale, unsigned axis) {
    check(H5DSattach_scale(dataset(path), dataset(scale), axis),
          scale + " cannot become the scale of " + path);
}

std::vector<std::string> hdf5_file::scales_of(const std::string& path) const {
    std::vector<std::string> names(shape_of(path).size());
    for (unsigned axis = 0; axis < names.size(); ++axis) {
        const auto take_name = [](hid_t, unsigned, hid_t scale, void* to) -> herr_t {
            char name[256] = {};
            H5DSget_scale_name(scale, name, sizeof name);
            *static_cast<std::string*>(to) = name;
            return 1;
        };
        H5DSiterate_scales(dataset(path), axis, nullptr, take_name, &names[axis]);
    }
    return names;
}

void hdf5_file::put_attribute(const std::string& object, const std::string& name, hid_t file_type,
                              hid_t memory_type, const hdf5_handle& space, const void* values) {
    const hdf5_handle owner = this->object(object);
    if (H5Aexists(owner.id(), name.c_str()) > 0) H5Adelete(owner.id(), name.c_str());
    const std::string action = "attribute " + name + " of " + object + " cannot be written";
    const hdf5_handle made = checked(
        H5Acreate2(owner.id(), name.c_str(), file_type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
        action);
    check(H5Awrite(made.id(), memory_type, values), action);
}

void hdf5_file::set_attribute(const std::string& object, const std::string& name,
                              std::string_view text) {
    const std::string terminated(text);
    const hdf5_handle type = text_type(terminated.size());
    put_attribute(object, name, type.id(), type.id(), space_of({}), terminated.c_str());
}

void hdf5_file::set_text(const std::string& object, const std::string& name,
                         const std::string& text) {
    const hdf5_handle type = text_type();
    const char* pointer = text.c_str();
    put_attribute(object, name, type.id(), type.id(), space_of({}), &pointer);
}

void hdf5_file::set_attribute(const std::string& object, const std::string& name,
                              const typed_numbers& values) {
    put_attribute(object, name, file_type_of(values.type), H5T_NATIVE_DOUBLE,
                  space_of({values.values.size()}), values.values.data());
}

void hdf5_file::set_words(const std::string& object, const std::string& name,
                          std::span<const std::uint64_t> words) {
    put_attribute(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, space_of({words.size()}),
                  words.data());
}

std::vector<std::string> hdf5_file::attribute_names(const std::string& object) const {
    const hdf5_handle owner = this->object(object);
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
        static_cast<std::vector<std::string>*>(to)->emplace_back(name);
        return 0;
    };
    if (H5Aiterate2(owner.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, collect, &names) < 0) {
        names.clear();
        H5Aiterate2(owner.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
    }
    return names;
}

bool hdf5_file::has_attribute(const std::string& object, const std::string& name) const {
    return H5Aexists(this->object(object).id(), name.c_str()) > 0;
}

hdf5_handle hdf5_file::attribute(const std::string& object, const std::string& name) const {
    const hdf5_handle owner = this->object(object);
    return checked(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT),
                   "attribute " + name + " of " + object + " is missing");
}

bool hdf5_file::is_text_attribute(const std::string& object, const std::string& name) const {
    const hdf5_handle type(H5Aget_type(attribute(object, name).id()));
    return H5Tget_class(type.id()) == H5T_STRING;
}

std::string hdf5_file::attribute_text(const std::string& object, const std::string& name) const {
    const hdf5_handle handle = attribute(object, name);
    const hdf5_handle stored(H5Aget_type(handle.id()));
    const std::string action = "attribute " + name + " of " + object + " is no text";
    if (H5Tget_class(stored.id()) != H5T_STRING) fail(action);
    if (H5Tis_variable_str(stored.id()) > 0) {
        char* pointer = nullptr;
        check(H5Aread(handle.id(), stored.id(), &pointer), action);
        const std::string text = pointer == nullptr ? "" : pointer;
        H5free_memory(pointer);
        return text;
    }
    std::string text(H5Tget_size(stored.id()), '\0');
    check(H5Aread(handle.id(), stored.id(), text.data()), action);
    return text.substr(0, text.find('\0'));
}

std::vector<double> hdf5_file::attribute_numbers(const std::string& object,
                                                 const std::string& name) const {
    const hdf5_handle handle = attribute(object, name);
    const hdf5_handle space(H5Aget_space(handle.id()));
    std::vector<double> values(points_of(space));
    check(H5Aread(handle.id(), H5T_NATIVE_DOUBLE, values.data()),
          "attribute " + name + " of " + object + " holds no numbers");
    return values;
}

std::vector<std::uint64_t> hdf5_file::attribute_words(const std::string& object,
                                                      const std::string& name) const {
    const hdf5_handle handle = attribute(object, name);
    const hdf5_handle space(H5Aget_space(handle.id()));
    std::vector<std::uint64_t> values(points_of(space));
    check(H5Aread(handle.id(), H5T_NATIVE_UINT64, values.data()),
          "attribute " + name + " of " + object + " holds no numbers");
    return values;
}

}  // namespace hopscotch
