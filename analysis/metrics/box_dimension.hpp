// Box-counting dimension of the basin boundaries.
#pragma once

#include "analysis/metrics/uncertainty.hpp"

namespace hopscotch::metrics {

/// Boxes of s = 2, 4, 6, 8, 12, 16 ... steps along each axis cover the map; neighbours share the
/// points on their faces, so that a boundary between two points lies in one box of every size. Each
/// box is looked at through 3 points along each side, whatever its size: with all points of a box,
/// large boxes would find thin filaments that small ones miss, and a fractal's dimension would come
/// out too low (by 0.04 for the map of Grebogi et al. at 1000 x 1000). A box is hit if its points
/// have more than one class; N(s) ~ s^-D. Returned are power laws of the fraction of boxes hit,
/// whose exponent is (axes) - D. The largest boxes fit 6 times along the shortest axis (twice where
/// it has less than 72 steps); steps beyond the last complete one are left out, points without a
/// class ignored.
scaling_by_class box_counts_of(const class_grid& grid);

/// D from such an exponent.
inline double dimension_of(const class_grid& grid, const power_law& counts) {
    return static_cast<double>(grid.rank()) - counts.exponent;
}

}  // namespace hopscotch::metrics
