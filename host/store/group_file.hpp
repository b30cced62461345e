// A group of tables in a file: compressed datasets with dimension scales, written and read bit for
// bit. Used for the group /traps of map files.
#pragma once

#include "host/map/table_group.hpp"
#include "host/store/hdf5_file.hpp"

#include <string>

namespace hopscotch {

/// Dimensions become scales of the group, counted from 0.
void write_group(hdf5_file& file, const table_group& group);

/// \error  store_error where the file has no such group, or it cannot be read
table_group read_group(hdf5_file& file, const std::string& name);

}  // namespace hopscotch
