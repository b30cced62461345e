// The layout of a map on disk, written and read: axes as dimension scales, layers with CF
// attributes, the groups /attractors, /traps and /tiles, global attributes. Everything but the layers'
// numbers, which map_run puts in as chunks. netCDF-4 readers, h5py, ParaView and MATLAB open it
// without this project.
//
//   /<axis>       float64, dimension scale; units, long_name, scale = linear | log
//   /<layer>      on the axes, chunk = tile, shuffle + deflate; units, long_name, _FillValue = "not
//                 computed", flag_values + flag_meanings of categorical layers
//   /attractors   label name period trap share colour, points(label, point, column),
//                 multipliers(label, multiplier, part); rows of unequal length end in NaN
//   /traps        what labels rest on, see host/run/plan_tables.hpp
//   /tiles        origin extent checksum of every tile; attribute compute_seconds; in a file whose
//                 layers are virtual datasets over tile files also `directory`, where those lie
#pragma once

#include "host/map/hash.hpp"
#include "host/map/layout.hpp"
#include "host/map/table_group.hpp"
#include "host/store/hdf5_file.hpp"

#include <string>
#include <vector>

namespace hopscotch {

/// A map without its numbers.
struct map_description {
    map_layout layout;
    attribute_list attributes;
    std::vector<attractor_row> attractors;
    std::vector<std::string> point_columns;

    std::vector<table_group> groups{};  // written with the rest, read one by one

    /// Where the tile files lie, relative to the map file's folder, if the layers are virtual;
    /// empty where the map file holds the numbers itself.
    std::string tile_directory{};
};

/// One row of the tile table.
struct tile_row {
    tile_box box;
    std::vector<layer_sum> sums;
    double seconds = 0.0;
};

inline constexpr const char* cf_conventions = "CF-1.10";

hdf5_type stored_as(number_type type);

/// An axis as a dimension scale, with units and meaning.
void write_axis(hdf5_file& file, const axis& each);
void describe_axis(hdf5_file& file, const axis& each);  // of a dataset that is there

/// Units, meaning, fill value and flags of a layer whose dataset is there.
void describe_layer(hdf5_file& file, const layer& each,
                    const std::vector<attractor_row>& attractors);

/// A description fit for writing: throws store_error where names clash or an axis has no cell; a
/// layer `label` without flags takes the attractors' names.
map_description completed(map_description map, const std::string& place);

void write_description(hdf5_file& file, const map_description& map);
map_description read_description(hdf5_file& file);

void write_attractors(hdf5_file& file, const std::vector<attractor_row>& rows,
                      const std::vector<std::string>& point_columns);
std::vector<attractor_row> read_attractors(hdf5_file& file,
                                           std::vector<std::string>& point_columns);

void write_tile_table(hdf5_file& file, const map_description& map,
                      const std::vector<tile_row>& rows);
std::vector<tile_row> read_tile_table(hdf5_file& file, const map_layout& layout);

/// The names of the files that virtual layers are made of, one per tile.
std::vector<virtual_part> parts_of(const map_layout& layout, const std::string& tile_directory,
                                   const std::string& layer);

/// The value of a global attribute; empty where there is none.
std::string attribute_of(const attribute_list& attributes, std::string_view name);

/// Adds an attribute, or replaces the one of that name in its place.
void set_attribute(attribute_list& attributes, const std::string& name, const std::string& value);

}  // namespace hopscotch
