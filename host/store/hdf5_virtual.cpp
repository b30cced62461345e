// Virtual datasets of hdf5_file: numbers that lie in other files.
#include "host/store/hdf5_file.hpp"
#include "host/store/hdf5_types.hpp"

namespace hopscotch {

namespace {

/// HDF5 reads `%b` in a source's name as a block number.
std::string escaped(const std::string& name) {
    std::string result;
    for (const char letter : name) result.append(letter == '%' ? 2 : 1, letter);
    return result;
}

/// The rectangle from `origin` on; true where HDF5 took it.
bool select(const hdf5_handle& space, const std::vector<std::uint64_t>& origin,
            const std::vector<std::uint64_t>& extent) {
    const std::vector<hsize_t> start(origin.begin(), origin.end());
    const std::vector<hsize_t> block(extent.begin(), extent.end());
    const std::vector<hsize_t> one(extent.size(), 1);
    return H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, one.data(),
                               block.data()) >= 0;
}

bool add_part(const hdf5_handle& list, const hdf5_handle& space, const virtual_part& part) {
    const hdf5_handle source = space_of(part.source_shape);
    const std::vector<std::uint64_t> corner(part.source_extent.size(), 0);
    return select(space, part.origin, part.extent) && select(source, corner, part.source_extent) &&
           H5Pset_virtual(list.id(), space.id(), escaped(part.file).c_str(),
                          escaped(part.dataset).c_str(), source.id()) >= 0;
}

}  // namespace

void hdf5_file::make_dataset(const std::string& path, const virtual_dataset& dataset) {
    const hdf5_handle list = dataset_properties();
    check(H5Pset_fill_value(list.id(), H5T_NATIVE_DOUBLE, &dataset.fill), path + " cannot be made");
    const hdf5_handle space = space_of(dataset.shape);
    for (const virtual_part& part : dataset.parts) {
        if (!add_part(list, space, part)) fail(path + " cannot refer to " + part.file);
    }
    H5Sselect_all(space.id());
    const hdf5_handle made =
        checked(H5Dcreate2(file_.id(), path.c_str(), file_type_of(dataset.type), space.id(),
                           H5P_DEFAULT, list.id(), H5P_DEFAULT),
                path + " cannot be made");
}

void hdf5_file::let_go(const std::string& path) { datasets_.erase(path); }

bool hdf5_file::is_virtual(const std::string& path) const {
    const hdf5_handle list(H5Dget_create_plist(dataset(path)));
    return H5Pget_layout(list.id()) == H5D_VIRTUAL;
}

}  // namespace hopscotch
