// How our types look to HDF5: in files little-endian, in memory as the machine has them. Only for
// the files that implement hdf5_file.
#pragma once

#include "host/store/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <vector>

namespace hopscotch {

static_assert(sizeof(hdf5_handle::identifier) == sizeof(hid_t));

inline hid_t file_type_of(hdf5_type type) {
    switch (type) {
        case hdf5_type::int8:
            return H5T_STD_I8LE;
        case hdf5_type::int16:
            return H5T_STD_I16LE;
        case hdf5_type::int32:
            return H5T_STD_I32LE;
        case hdf5_type::uint32:
            return H5T_STD_U32LE;
        case hdf5_type::uint64:
            return H5T_STD_U64LE;
        case hdf5_type::float64:
        case hdf5_type::text:
            break;
    }
    return H5T_IEEE_F64LE;
}

/// Text of any length in UTF-8, as netCDF-4 writes it.
inline hdf5_handle text_type() {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return hdf5_handle(type);
}

/// Text of a fixed length: what netCDF calls a character attribute, which every reader of CF knows.
inline hdf5_handle text_type(std::size_t length) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, std::max<std::size_t>(length, 1));
    H5Tset_strpad(type, H5T_STR_NULLTERM);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return hdf5_handle(type);
}

/// Of every dataset. No time stamps: the same data give the same file.
inline hdf5_handle dataset_properties() {
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(list, false);
    H5Pset_attr_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    return hdf5_handle(list);
}

inline hdf5_handle space_of(const hdf5_file::shape_type& shape) {
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    return hdf5_handle(
        extent.empty() ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
}

inline std::size_t points_of(const hdf5_handle& space) {
    const hssize_t n = H5Sget_simple_extent_npoints(space.id());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
}

}  // namespace hopscotch
