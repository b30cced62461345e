// From a scene's axes to sample values, and from a scene to the layout of its map.
#pragma once

#include "host/map/layout.hpp"
#include "host/scene/scene.hpp"

#include <vector>

namespace hopscotch {

/// Where the cells of an axis are sampled: cell centres, or with `edges` from end to end; evenly
/// spaced in value or in logarithm. Computed in extended precision and rounded once.
std::vector<double> values_of(const scene_axis& axis);

/// Sample value of one cell of the axis.
double value_of(const scene_axis& axis, std::uint64_t cell);

/// Axes with units, layers and tiles of the scene's map.
map_layout layout_of(const scene& scene);

/// Coordinates of a cell along each axis, from its index in C order.
std::vector<std::uint64_t> coordinates_of(const scene& scene, std::uint64_t cell);

/// The complete start of one cell: state columns of the section, then parameters.
struct cell_start {
    std::vector<double> columns;
    std::vector<double> parameters;
};
cell_start start_of(const scene& scene, std::span<const std::uint64_t> coordinates);

/// Extremes of every parameter over the whole map.
struct parameter_extremes {
    std::vector<double> lowest;
    std::vector<double> highest;
};
parameter_extremes extremes_of(const scene& scene);

}  // namespace hopscotch
