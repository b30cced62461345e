// The cells of a map that a picture shows: at most so many along each axis, however large the map
// is.
#pragma once

#include "host/store/map_reader.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hopscotch::picture {

/// An axis as it is drawn: the values of the cells shown and the scale's ends half a cell beyond
/// them.
struct drawn_axis {
    std::string name;
    std::string unit;
    bool is_log = false;
    std::vector<double> values;
    double lowest = 0.0;
    double highest = 1.0;

    /// Where a value lies between the ends, 0 to 1.
    double share_of(double value) const;
};

struct image_data {
    layer what;
    drawn_axis across;           // the map's first axis
    drawn_axis up;               // the second one; a single value where there is none
    std::vector<double> values;  // [across][up]
    bool has_second_axis = false;
    bool is_every_cell = true;         // false where cells were left out
    std::vector<std::string> remarks;  // cells of further axes, missing tiles

    double at(std::size_t i, std::size_t j) const { return values[i * up.values.size() + j]; }
    bool is_fill(double value) const;
};

/// \error  store_error where the map has no such layer
image_data read_image(const map_reader& map, const std::string& layer, std::uint64_t most_cells);

}  // namespace hopscotch::picture
