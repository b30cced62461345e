// Connected pieces of the basins.
#pragma once

#include "analysis/metrics/class_grid.hpp"

namespace hopscotch::metrics {

struct component_count {
    std::uint64_t n = 0;        // pieces
    std::uint64_t largest = 0;  // cells of the largest one
};

/// Pieces of every class, cells joined through their faces (4 neighbours in a plane, 6 in space).
/// Memory: 28 bytes per run of equal cells along the last axis.
std::vector<component_count> components_of(const class_grid& grid);

}  // namespace hopscotch::metrics
