// How far the cells of every class are from the nearest failing cell.
#pragma once

#include "analysis/metrics/class_grid.hpp"

namespace hopscotch::metrics {

struct distance_summary {
    double shortest = 0.0;
    double median = 0.0;  // within 0.05 % (logarithmic histogram)
};

struct fall_distances {
    bool is_defined = false;
    std::string why;
    std::vector<distance_summary> classes;  // NaN for classes that are falls or have no cell
};

/// From cell centre to cell centre, to the nearest cell of any class that is a fall; the border of
/// failure lies up to one cell nearer.
fall_distances distances_to_falls(const class_grid& grid, length_unit unit);

}  // namespace hopscotch::metrics
