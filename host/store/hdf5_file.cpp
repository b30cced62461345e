#include "host/store/hdf5_file.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/hdf5_types.hpp"

#include <algorithm>

namespace hopscotch {

namespace {

/// Groups that remember the order of their members: readers show them as they were written. No time
/// stamps: the same data give the same file.
hdf5_handle ordered_group(hid_t property_class) {
    const hid_t list = H5Pcreate(property_class);
    H5Pset_obj_track_times(list, false);
    H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_attr_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    return hdf5_handle(list);
}

hdf5_handle access_properties() {
    const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(list, H5F_CLOSE_STRONG);
    H5Pset_file_locking(list, false, true);  // run directories have their own lock
    return hdf5_handle(list);
}

}  // namespace

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

hdf5_file hdf5_file::create_virtual(const std::filesystem::path& path) {
    const hdf5_handle creation = ordered_group(H5P_FILE_CREATE);
    const hdf5_handle access = access_properties();
    H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V110);
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
    H5Pset_fapl_core(access.id(), std::size_t{1} << 16, false);
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
    if (!is_well)
        throw store_error(place_, "cannot be written: " + hdf5_words(reason),
                          hdf5_suggestion(reason));
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
    datasets_[path] = checked(
        H5Dcreate2(file_.id(), path.c_str(), type, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
        path + " cannot be made");
}

void hdf5_file::write_chunk(const std::string& path, const shape_type& origin,
                            std::span<const std::byte> bytes) {
    const std::vector<hsize_t> offset(origin.begin(), origin.end());
    check(H5Dwrite_chunk(dataset(path), H5P_DEFAULT, 0, offset.data(), bytes.size(), bytes.data()),
          path + " cannot be written");
}

void hdf5_file::write_all(const std::string& path, std::span<const double> values) {
    check(H5Dwrite(dataset(path), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
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
    write(path, {texts.size()}, texts);
}

void hdf5_file::write(const std::string& path, const shape_type& shape,
                      std::span<const std::string> texts) {
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    const hdf5_handle type = text_type();
    write_dense(path, hdf5_type::text, shape, type.id(), pointers.data());
}

hdf5_type hdf5_file::type_of(const std::string& path) const {
    const hdf5_handle type(H5Dget_type(dataset(path)));
    for (const hdf5_type each : {hdf5_type::int8, hdf5_type::int16, hdf5_type::int32,
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

hid_t hdf5_file::dataset(const std::string& path) const {
    const auto known = datasets_.find(path);
    if (known != datasets_.end()) return known->second.id();
    hdf5_handle opened =
        checked(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), "dataset " + path + " is missing");
    return datasets_.emplace(path, std::move(opened)).first->second.id();
}

hdf5_handle hdf5_file::object(const std::string& path) const {
    return checked(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), path + " is missing");
}

void hdf5_file::fail(const std::string& action) const {
    const std::string reason = hdf5_reason();
    const std::string words = hdf5_words(reason);
    throw store_error(place_, words.empty() ? action : action + ": " + words,
                      hdf5_suggestion(reason));
}

hdf5_handle hdf5_file::checked(hid_t id, const std::string& action) const {
    if (id < 0) fail(action);
    return hdf5_handle(id);
}

void hdf5_file::check(int status, const std::string& action) const {
    if (status < 0) fail(action);
}

}  // namespace hopscotch
