// The index of a sweep: one file that shows all its maps as one array, with the sweep's axes in
// front, and a table of numbers per map. Its layers are virtual datasets over the map files, which
// it names relative to its own folder; a map that is not there yet reads as `_FillValue`. The maps
// stay ordinary map files.
//
//   /<sweep axis>, /<axis>   dimension scales (axes that move together: the scale `point`, and each
//                            of them along it, named in the layers' attribute `coordinates`)
//   /<layer>                 on the sweep's axes and the map's
//   /<column>                on the sweep's axes and, for some, one more dimension
//   attributes               `sweep_maps` (the folder), `sweep_axes`, and those of a map
#pragma once

#include "host/map/layout.hpp"
#include "host/store/hdf5_file.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

/// A dimension of the table beyond the sweep's axes: numbered or named.
struct index_dimension {
    std::string name;
    std::string long_name;
    std::vector<double> values;      // whole numbers
    std::vector<std::string> texts;  // names, where there are no values
};

/// One column of the table: numbers or texts for every map, in C order.
struct index_column {
    std::string name;
    std::string unit;
    std::string long_name;
    std::vector<std::string> dimensions;  // beyond the sweep's axes
    hdf5_type type = hdf5_type::float64;
    std::vector<double> values;  // NaN (float64) or -1 (int32) where a map is not there
    std::vector<std::string> texts;
};

struct sweep_index {
    attribute_list attributes;
    std::string directory;        // of the maps, relative to the index
    std::vector<axis> axes;       // of the sweep
    std::vector<axis> followers;  // along the only axis, where several move together
    map_layout layout;            // of every map
    std::vector<index_dimension> dimensions;
    std::vector<index_column> columns;
};

/// The file of one map within the directory of a sweep's maps.
std::filesystem::path sweep_map_path(const std::filesystem::path& directory, std::uint64_t point);

/// Replaces the index at once, so that a reader sees the old or the new one. \error store_error
void write_sweep_index(const std::filesystem::path& file, const sweep_index& index);

/// The folder of the maps where the file is an index of a sweep, empty where it is something else.
/// \error store_error where it cannot be read
std::filesystem::path sweep_directory(const std::filesystem::path& file);

/// What an index says of itself and of every map: attributes, and the hashes (empty where a map is
/// missing).
struct sweep_contents {
    attribute_list attributes;
    std::vector<std::string> hashes;
};
sweep_contents read_sweep_contents(const std::filesystem::path& file);

}  // namespace hopscotch
