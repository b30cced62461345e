// The shape of a map before and after it is computed: axes, layers, tiles. Shared by the scheduler,
// the store and every reader; knows nothing of models or of HDF5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hopscotch {

/// One axis of the grid. Cells are sampled at `values` (cell centres unless the scene says
/// `edges`).
struct axis {
    std::string name;
    std::string unit;
    std::string long_name;
    std::string scale = "linear";  // or "log"
    std::vector<double> values;    // strictly increasing, one per cell

    std::uint64_t size() const { return values.size(); }
};

/// Signed ones: ParaView's reader of netCDF knows no others.
enum class number_type : std::uint8_t { int8, int16, int32, float64 };

constexpr std::size_t bytes_of(number_type type) {
    switch (type) {
        case number_type::int8:
            return 1;
        case number_type::int16:
            return 2;
        case number_type::int32:
            return 4;
        case number_type::float64:
            return 8;
    }
    return 0;
}

/// One number per cell. `flags` names the values of categorical layers (CF
/// flag_values/flag_meanings).
struct layer {
    std::string name;
    number_type type = number_type::float64;
    std::string unit;
    std::string long_name;
    double fill = 0.0;  // means "not computed"; NaN for float64, else -1
    std::vector<std::pair<int, std::string>> flags;
    bool holds_labels = false;  // its values are attractors: named and coloured like them
};

/// Axes in the scene's order: the first one is the slowest in memory (C order), as in `--cell i,j`.
struct map_layout {
    std::vector<axis> axes;
    std::vector<layer> layers;
    std::vector<std::uint64_t>
        tile;  // cells per tile along each axis (the last tile may be smaller;
               // an entry above the axis' size means the whole axis)

    std::uint64_t n_cells() const;
    std::vector<std::uint64_t> tiles_along() const;  // number of tiles along each axis
    std::uint64_t n_tiles() const;
};

/// A rectangle of cells: where it starts and its extent along each axis.
struct tile_box {
    std::uint64_t index = 0;  // in C order over tiles
    std::vector<std::uint64_t> origin;
    std::vector<std::uint64_t> extent;

    std::uint64_t n_cells() const;
};

/// Coordinates in the map of a box's cell, from its index in C order within the box.
std::vector<std::uint64_t> coordinates_in(const tile_box& box, std::uint64_t cell);

/// The rectangle of a tile. Throws std::out_of_range where the map has no such tile.
tile_box box_of(const map_layout& layout, std::uint64_t tile_index);

/// The extent of a full tile: `layout.tile`, but never more than an axis has.
std::vector<std::uint64_t> full_tile(const map_layout& layout);

/// Index of the layer of that name, or the number of layers where there is none.
std::size_t layer_index(const map_layout& layout, std::string_view name);

/// The computed numbers of one tile: one buffer per layer, C order within the box.
struct tile_data {
    tile_box box;
    std::vector<std::vector<std::byte>> layers;
};

/// One row of the /attractors group.
struct attractor_row {
    int label = 0;
    std::string name;            // "fixed point 2", "period 3", "hopping dies", ...
    int period = 0;              // 0 = aperiodic
    std::vector<double> points;  // period x n_columns, C order; empty where there is none
    std::vector<double> multipliers_real;
    std::vector<double> multipliers_imaginary;
    std::string trap;          // in words: the set whose members are labelled
    double share = 0.0;        // of all cells
    std::uint32_t colour = 0;  // 0xRRGGBB
};

/// Global attributes of a finished map, in the order they are written.
using attribute_list = std::vector<std::pair<std::string, std::string>>;

}  // namespace hopscotch
