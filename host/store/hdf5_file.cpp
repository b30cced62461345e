#include "host/store/hdf5_file.hpp"

#include "host/store/atomic_file.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace hopscotch {

static_assert(sizeof(hdf5_handle::identifier) == sizeof(hid_t));

namespace {

std::recursive_mutex& hdf5_mutex() {
    static std::recursive_mutex mutex;
    return mutex;
}

hid_t file_type_of(hdf5_type type) {
    switch (type) {
        case hdf5_type::uint8: return H5T_STD_U8LE;
        case hdf5_type::int16: return H5T_STD_I16LE;
        case hdf5_type::int32: return H5T_STD_I32LE;
        case hdf5_type::uint32: return H5T_STD_U32LE;
        case hdf5_type::uint64: return H5T_STD_U64LE;
        case hdf5_type::float64:
        case hdf5_type::text: break;
    }
    return H5T_IEEE_F64LE;
}

/// Text of any length in UTF-8, as netCDF-4 writes it.
hdf5_handle text_type() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return hdf5_handle(type);
}

/// Text of a fixed length: what netCDF calls a character attribute, which every reader of CF knows.
hdf5_handle text_type(std::size_t length) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, std::max<std::size_t>(length, 1));
    H5Tset_strpad(type, H5T_STR_NULLTERM);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return hdf5_handle(type);
}

hdf5_handle space_of(const hdf5_file::shape_type& shape) {
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    return hdf5_handle(extent.empty()
                           ? H5Screate(H5S_SCALAR)
                           : H5Screate_simple(static_cast<int>(extent.size()), extent.data(),
                                              nullptr));
}

std::size_t points_of(const hdf5_handle& space) {
    const hssize_t n = H5Sget_simple_extent_npoints(space.id());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
}

/// Groups that remember the order of their members: readers show them as they were written.
hdf5_handle ordered_group(hid_t property_class) {
    const hid_t list = H5Pcreate(property_class);
    H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_attr_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    return hdf5_handle(list);
}

/// No time stamps: the same data give the same file.
hdf5_handle dataset_properties() {
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(list, false);
    H5Pset_attr_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    return hdf5_handle(list);
}

hdf5_handle access_properties() {
    const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(list, H5F_CLOSE_STRONG);
    H5Pset_file_locking(list, false, true);  // run directories have their own lock
    return hdf5_handle(list);
}

/// HDF5's own explanation of the last failure: its innermost message.
std::string hdf5_reason() {
    std::string reason;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_DOWNWARD,
        [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
            if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
            return 0;
        },
        &reason);
    H5Eclear2(H5E_DEFAULT);
    return reason;
}

/// A suggestion where the failure is the disk's.
std::string suggestion_for(const std::string& reason) {
    const bool is_full = reason.find("errno = 28") != std::string::npos ||
                         reason.find("errno = 27") != std::string::npos ||
                         reason.find("errno = 122") != std::string::npos;
    return is_full ? "free some space and go on with --resume" : "";
}

std::string hdf5_words(const std::string& reason) {
    const std::size_t begin = reason.find("error message = '");
    if (begin == std::string::npos) return reason;
    const std::size_t from = begin + std::string("error message = '").size();
    return reason.substr(from, reason.find('\'', from) - from);
}

}  // namespace

hdf5_guard::hdf5_guard() : lock_(hdf5_mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hdf5_handle::hdf5_handle(hdf5_handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}

hdf5_handle& hdf5_handle::operator=(hdf5_handle&& other) noexcept {
    if (this != &other) {
        reset();
        id_ = std::exchange(other.id_, -1);
    }
    return *this;
}

bool hdf5_handle::reset() noexcept {
    if (id_ < 0) return true;
    const hid_t id = std::exchange(id_, -1);
    switch (H5Iget_type(id)) {
        case H5I_FILE: return H5Fclose(id) >= 0;
        case H5I_GROUP: return H5Gclose(id) >= 0;
        case H5I_DATATYPE: return H5Tclose(id) >= 0;
        case H5I_DATASPACE: return H5Sclose(id) >= 0;
        case H5I_DATASET: return H5Dclose(id) >= 0;
        case H5I_ATTR: return H5Aclose(id) >= 0;
        case H5I_GENPROP_LST: return H5Pclose(id) >= 0;
        default: return false;
    }
}

hdf5_file::hdf5_file(hdf5_handle file, std::string place)
    : place_(std::move(place)), file_(std::move(file)) {}

hdf5_file hdf5_file::create(const std::filesystem::path& path) {
    const hdf5_handle creation = ordered_group(H5P_FILE_CREATE);
    const hdf5_handle access = access_properties();
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);  // what netCDF-4 reads
    hdf5_file file(hdf5_handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id())),
                   path.string());
    if (!file.file_) file.fail("cannot be made");
    return file;
}

hdf5_file hdf5_file::create_in_memory(const std::string& place) {
    const hdf5_handle creation = ordered_group(H5P_FILE_CREATE);
    const hdf5_handle access = access_properties();
    // The oldest superblock: H5Fget_file_image breaks the checksum of newer ones (HDF5 1.10.8).
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
    H5Pset_fapl_core(access.id(), std::size_t{1} << 20, false);
    hdf5_file file(hdf5_handle(H5Fcreate(place.c_str(), H5F_ACC_TRUNC, creation.id(), access.id())),
                   place);
    if (!file.file_) file.fail("cannot be made");
    return file;
}

hdf5_file hdf5_file::open(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) {
        throw store_error(path.string(), "there is no such file", "");
    }
    const hdf5_handle access = access_properties();
    hdf5_file file(hdf5_handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id())), path.string());
    if (!file.file_) file.fail("not a readable HDF5 file");
    return file;
}

hdf5_file hdf5_file::open_image(std::span<const std::byte> image, const std::string& place) {
    const hdf5_handle access = access_properties();
    H5Pset_fapl_core(access.id(), std::size_t{1} << 16, false);
    // HDF5 copies the image and never writes to it.
    H5Pset_file_image(access.id(), const_cast<std::byte*>(image.data()), image.size());
    const std::string name = place + std::string(partial_mark) + "image";  // must not exist
    hdf5_file file(hdf5_handle(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.id())), place);
    if (!file.file_) file.fail("not a readable HDF5 file");
    return file;
}

void hdf5_file::close() {
    bool is_well = true;
    for (auto& [path, dataset] : datasets_) is_well = dataset.reset() && is_well;
    datasets_.clear();
    is_well = (!file_ || H5Fflush(file_.id(), H5F_SCOPE_LOCAL) >= 0) && is_well;
    const std::string reason = is_well ? "" : hdf5_reason();
    is_well = file_.reset() && is_well;
    if (!is_well) throw store_error(place_, "cannot be written: " + hdf5_words(reason),
                                    suggestion_for(reason));
}

std::vector<std::byte> hdf5_file::image() {
    check(H5Fflush(file_.id(), H5F_SCOPE_LOCAL), "cannot be flushed");
    const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
    if (size < 0) fail("cannot be copied");
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    if (H5Fget_file_image(file_.id(), bytes.data(), bytes.size()) < 0) fail("cannot be copied");
    return bytes;
}

bool hdf5_file::has(const std::string& path) const {
    std::size_t slash = 0;
    while (slash != std::string::npos) {  // every group on the way must be there too
        slash = path.find('/', slash + 1);
        if (H5Lexists(file_.id(), path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    }
    return true;
}

bool hdf5_file::is_dataset(const std::string& path) const {
    return H5Iget_type(object(path).id()) == H5I_DATASET;
}

void hdf5_file::make_group(const std::string& path) {
    const hdf5_handle list = ordered_group(H5P_GROUP_CREATE);
    checked(H5Gcreate2(file_.id(), path.c_str(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
            "group " + path + " cannot be made");
}

std::vector<std::string> hdf5_file::members(const std::string& group) const {
    const hdf5_handle handle = object(group);
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
        static_cast<std::vector<std::string>*>(to)->emplace_back(name);
        return 0;
    };
    if (H5Literate(handle.id(), H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, collect, &names) < 0) {
        names.clear();
        check(H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names),
              "members of " + group + " cannot be listed");
    }
    return names;
}

void hdf5_file::make_dataset(const std::string& path, const chunked_dataset& dataset) {
    const hdf5_handle list = dataset_properties();
    const std::vector<hsize_t> chunk(dataset.chunk.begin(), dataset.chunk.end());
    const hid_t type = file_type_of(dataset.type);
    H5Pset_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data());
    if (H5Tget_size(type) > 1) H5Pset_shuffle(list.id());
    H5Pset_deflate(list.id(), static_cast<unsigned>(std::clamp(dataset.level, 0, 9)));
    H5Pset_fill_value(list.id(), H5T_NATIVE_DOUBLE, &dataset.fill);
    const hdf5_handle space = space_of(dataset.shape);
    datasets_[path] = checked(H5Dcreate2(file_.id(), path.c_str(), type, space.id(), H5P_DEFAULT,
                                         list.id(), H5P_DEFAULT),
                              path + " cannot be made");
}

void hdf5_file::write_chunk(const std::string& path, const shape_type& origin,
                            std::span<const std::byte> bytes) {
    const std::vector<hsize_t> offset(origin.begin(), origin.end());
    check(H5Dwrite_chunk(dataset(path), H5P_DEFAULT, 0, offset.data(), bytes.size(), bytes.data()),
          path + " cannot be written");
}

bool hdf5_file::has_chunk(const std::string& path, const shape_type& origin) const {
    const std::vector<hsize_t> offset(origin.begin(), origin.end());
    hsize_t size = 0;
    return H5Dget_chunk_storage_size(dataset(path), offset.data(), &size) >= 0 && size > 0;
}

std::optional<std::vector<std::byte>> hdf5_file::read_chunk(const std::string& path,
                                                            const shape_type& origin) {
    if (!has_chunk(path, origin)) return std::nullopt;
    const std::vector<hsize_t> offset(origin.begin(), origin.end());
    hsize_t size = 0;
    hsize_t file_size = 0;
    H5Dget_chunk_storage_size(dataset(path), offset.data(), &size);
    H5Fget_filesize(file_.id(), &file_size);
    if (size > file_size) fail("a chunk of " + path + " claims to be larger than the file");
    std::vector<std::byte> bytes(size);
    std::uint32_t filters = 0;
    check(H5Dread_chunk(dataset(path), H5P_DEFAULT, offset.data(), &filters, bytes.data()),
          "a chunk of " + path + " cannot be read");
    return bytes;
}

void hdf5_file::write_dense(const std::string& path, hdf5_type type, const shape_type& shape,
                            hid_t memory_type, const void* values) {
    const hdf5_handle list = dataset_properties();
    const hdf5_handle space = space_of(shape);
    const hdf5_handle text = text_type();
    const hid_t file_type = type == hdf5_type::text ? text.id() : file_type_of(type);
    hdf5_handle made = checked(H5Dcreate2(file_.id(), path.c_str(), file_type, space.id(),
                                          H5P_DEFAULT, list.id(), H5P_DEFAULT),
                               path + " cannot be made");
    check(H5Dwrite(made.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
          path + " cannot be written");
    datasets_[path] = std::move(made);
}

void hdf5_file::write(const std::string& path, const shape_type& shape,
                      std::span<const double> values) {
    write_dense(path, hdf5_type::float64, shape, H5T_NATIVE_DOUBLE, values.data());
}

void hdf5_file::write(const std::string& path, const shape_type& shape,
                      std::span<const std::uint64_t> values) {
    write_dense(path, hdf5_type::uint64, shape, H5T_NATIVE_UINT64, values.data());
}

void hdf5_file::write(const std::string& path, hdf5_type type, const shape_type& shape,
                      std::span<const double> values) {
    write_dense(path, type, shape, H5T_NATIVE_DOUBLE, values.data());
}

void hdf5_file::write(const std::string& path, std::span<const std::string> texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    const hdf5_handle type = text_type();
    write_dense(path, hdf5_type::text, {texts.size()}, type.id(), pointers.data());
}

hdf5_type hdf5_file::type_of(const std::string& path) const {
    const hdf5_handle type(H5Dget_type(dataset(path)));
    for (const hdf5_type each : {hdf5_type::uint8, hdf5_type::int16, hdf5_type::int32,
                                 hdf5_type::uint32, hdf5_type::uint64, hdf5_type::float64}) {
        if (H5Tequal(type.id(), file_type_of(each)) > 0) return each;
    }
    if (H5Tget_class(type.id()) == H5T_STRING) return hdf5_type::text;
    throw store_error(place_ + ": " + path, "its number type is none of ours", "");
}

hdf5_file::shape_type hdf5_file::shape_of(const std::string& path) const {
    const hdf5_handle space(H5Dget_space(dataset(path)));
    const int rank = std::max(H5Sget_simple_extent_ndims(space.id()), 0);
    std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
    return {extent.begin(), extent.end()};
}

hdf5_file::shape_type hdf5_file::chunk_of(const std::string& path) const {
    const hdf5_handle list(H5Dget_create_plist(dataset(path)));
    if (H5Pget_layout(list.id()) != H5D_CHUNKED) return {};
    std::vector<hsize_t> chunk(shape_of(path).size());
    H5Pget_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data());
    return {chunk.begin(), chunk.end()};
}

std::vector<double> hdf5_file::read_doubles(const std::string& path) const {
    const hdf5_handle space(H5Dget_space(dataset(path)));
    std::vector<double> values(points_of(space));
    check(H5Dread(dataset(path), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          path + " cannot be read");
    return values;
}

std::vector<std::uint64_t> hdf5_file::read_words(const std::string& path) const {
    const hdf5_handle space(H5Dget_space(dataset(path)));
    std::vector<std::uint64_t> values(points_of(space));
    check(H5Dread(dataset(path), H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          path + " cannot be read");
    return values;
}

std::vector<std::string> hdf5_file::read_texts(const std::string& path) const {
    const hdf5_handle space(H5Dget_space(dataset(path)));
    const hdf5_handle type = text_type();
    std::vector<char*> pointers(points_of(space), nullptr);
    check(H5Dread(dataset(path), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()),
          path + " cannot be read");
    std::vector<std::string> texts;
    for (const char* each : pointers) texts.emplace_back(each == nullptr ? "" : each);
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, pointers.data());
    return texts;
}

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
    const hdf5_handle made = checked(H5Acreate2(owner.id(), name.c_str(), file_type, space.id(),
                                                H5P_DEFAULT, H5P_DEFAULT),
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
                              const numbers& values) {
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

hid_t hdf5_file::dataset(const std::string& path) const {
    const auto known = datasets_.find(path);
    if (known != datasets_.end()) return known->second.id();
    hdf5_handle opened = checked(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT),
                                 "dataset " + path + " is missing");
    return datasets_.emplace(path, std::move(opened)).first->second.id();
}

hdf5_handle hdf5_file::object(const std::string& path) const {
    return checked(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), path + " is missing");
}

void hdf5_file::fail(const std::string& action) const {
    const std::string reason = hdf5_reason();
    const std::string words = hdf5_words(reason);
    throw store_error(place_, words.empty() ? action : action + ": " + words,
                      suggestion_for(reason));
}

hdf5_handle hdf5_file::checked(hid_t id, const std::string& action) const {
    if (id < 0) fail(action);
    return hdf5_handle(id);
}

void hdf5_file::check(int status, const std::string& action) const {
    if (status < 0) fail(action);
}

}  // namespace hopscotch
