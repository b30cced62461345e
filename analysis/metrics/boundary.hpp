// Which classes meet at a cell, and how many cells lie on the boundaries.
#pragma once

#include "analysis/metrics/class_grid.hpp"

#include <span>

namespace hopscotch::metrics {

/// For every cell of one row the classes of the cell and of its neighbours `step` cells away along
/// every axis. Neighbours beyond the map's edge are left out; ones without a class count as
/// `undecided_bit`.
void neighbourhoods(const class_grid& grid, std::uint64_t i0, std::uint64_t i1, std::uint64_t step,
                    std::span<class_set> row);

/// The classes on whose boundary a cell with such a neighbourhood lies: all that meet there.
constexpr class_set boundaries_through(class_set neighbourhood) {
    return is_mixed(neighbourhood) ? neighbourhood & ~undecided_bit : class_set{0};
}

struct boundary_counts {
    std::uint64_t n_cells = 0;              // with a face neighbour of another class
    std::vector<std::uint64_t> of_classes;  // of them, cells of each class
};

boundary_counts count_boundary_cells(const class_grid& grid);

}  // namespace hopscotch::metrics
