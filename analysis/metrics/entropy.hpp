// Basin entropy and boundary basin entropy of a map.
#pragma once

#include "analysis/metrics/class_grid.hpp"

namespace hopscotch::metrics {

struct basin_entropy {
    std::uint64_t box = 0;               // cells along each side
    std::uint64_t n_boxes = 0;           // with at least one cell that has a class
    std::uint64_t n_boundary_boxes = 0;  // with more than one class
    double whole = 0.0;                  // S_b
    double boundary = 0.0;               // S_bb; 0 where there is no boundary box
    double boundary_error = 0.0;         // jackknife over parts of the map; NaN where unknown

    /// S_bb > ln 2: sufficient (not necessary) for a fractal boundary.
    bool is_above_ln2() const;
};

/// Boxes of about 25 trajectories, as in the paper: 5 x 5 cells; 25 and 3 x 3 x 3 for other maps;
/// no more than the shortest axis has.
std::uint64_t default_box(const class_grid& grid);

/// The map is covered by boxes of `box` cells along each axis; cells beyond the last complete box
/// are left out. A box's entropy is - sum p ln p over the classes of its cells; cells without a
/// class are left out of the box.
/// Source: Daza, Wagemakers, Georgeot, Guery-Odelin, Sanjuan, Sci. Rep. 6, 31416 (2016).
///
/// \error store_error for a box larger than the map, or of less than two cells
basin_entropy entropy_of(const class_grid& grid, std::uint64_t box);

}  // namespace hopscotch::metrics
