// The Wada property by merging: do all basins share one boundary?
#pragma once

#include "analysis/metrics/class_grid.hpp"

namespace hopscotch::metrics {

/// How far the boundaries of one class and of all others are apart.
struct merged_boundary {
    std::uint64_t n_cells = 0;   // cells on the boundary of this class with the union of the others
    double radius = 0.0;         // the largest distance, in cells, of any boundary cell from it
    std::vector<double> beyond;  // share of all boundary cells farther than each of `radii`
};

struct wada_test {
    bool is_defined = false;
    std::string why;
    std::vector<double> radii{1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0};  // cells
    std::vector<merged_boundary> classes;  // n_cells = 0 for a class without a boundary

    /// All merged boundaries agree within `tolerance` cells.
    bool is_wada(double tolerance) const { return is_defined && radius() <= tolerance; }

    double radius() const;               // the largest of the classes' radii
    double beyond(std::size_t i) const;  // the largest share beyond radii[i]
};

/// Every basin is set against the union of the others. On a Wada map these merged boundaries are
/// one and the same; on a grid, all boundary cells then lie within a few cells of each of them. The
/// radius is the smallest thickness to which the merged boundaries must be fattened so that each
/// contains all of them.
/// Source: Daza, Wagemakers, Sanjuan, Sci. Rep. 8, 9954 (2018); distances are exact Euclidean ones.
wada_test wada_of(const class_grid& grid);

}  // namespace hopscotch::metrics
