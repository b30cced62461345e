// Cuts a map's classes into slices of fixed values along some of its axes: what is asked parameter
// by parameter is asked of each slice.
#pragma once

#include "analysis/metrics/class_grid.hpp"

#include <span>
#include <string>
#include <vector>

namespace hopscotch::metrics {

class class_slices {
public:
    /// \param axes  names of the axes that are fixed in a slice; those the grid has not (they have
    ///              one cell) are passed over. Borrows the grid.
    class_slices(const class_grid& grid, std::span<const std::string> axes);

    /// Some axis is fixed, and some is not.
    bool is_cut() const { return !fixed_.empty() && !kept_.empty(); }
    std::size_t size() const { return n_slices_; }  // in C order over the fixed axes

    const std::vector<std::size_t>& fixed() const { return fixed_; }  // axes of the grid, rising
    const std::vector<std::size_t>& kept() const { return kept_; }

    /// Indices along the fixed axes of the grid.
    std::vector<std::uint64_t> indices(std::size_t slice) const;

    /// The same along the axes named; 0 along those that the grid has not.
    std::vector<std::uint64_t> named_indices(std::size_t slice) const;

    /// The cells of one slice over the axes that are kept. Counts of cells are not filled in.
    class_grid cut(std::size_t slice) const;

private:
    std::uint64_t stride(std::size_t which) const;

    const class_grid& grid_;
    std::vector<std::size_t> fixed_;
    std::vector<std::size_t> place_;  // of each fixed axis among those named
    std::vector<std::size_t> kept_;
    std::size_t n_named_ = 0;
    std::size_t n_slices_ = 1;
};

}  // namespace hopscotch::metrics
