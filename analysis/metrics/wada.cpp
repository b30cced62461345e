#include "analysis/metrics/wada.hpp"

#include "analysis/metrics/boundary.hpp"
#include "analysis/metrics/distance.hpp"

#include <algorithm>
#include <bit>

namespace hopscotch::metrics {
namespace {

/// The classes whose merged boundary runs through each cell of one slab.
void boundaries_in_slab(const class_grid& grid, std::uint64_t i, std::span<class_set> sets) {
    const std::array<std::uint64_t, 3> n = grid.extent();
    if (grid.rank() == 1) {  // a slab is one cell
        const class_index* row = grid.row(0, 0);
        class_set set = class_bits[row[i]];
        if (i > 0) set |= class_bits[row[i - 1]];
        if (i + 1 < n[2]) set |= class_bits[row[i + 1]];
        sets[0] = boundaries_through(set);
        return;
    }
    const std::uint64_t n_rows = grid.rank() == 2 ? 1 : n[1];
    for (std::uint64_t r = 0; r < n_rows; ++r) {
        const std::span<class_set> row = sets.subspan(r * n[2], n[2]);
        neighbourhoods(grid, grid.rank() == 2 ? 0 : i, grid.rank() == 2 ? i : r, 1, row);
        for (class_set& set : row) set = boundaries_through(set);
    }
}

struct distance_counts {
    std::uint64_t n_cells = 0;
    std::uint64_t n_boundary = 0;
    double largest = 0.0;  // squared
    std::vector<std::uint64_t> beyond;
};

distance_counts counts_for(const class_grid& grid, std::size_t k,
                           const std::vector<double>& radii) {
    const class_set bit = class_bits[k];
    const std::uint64_t size = grid.cells.size() / grid.axes.front().size();
    const distance_transform distances(grid, length_unit::cells,
                                       [&](std::uint64_t i, std::span<std::uint8_t> marks) {
                                           std::vector<class_set> sets(size);
                                           boundaries_in_slab(grid, i, sets);
                                           for (std::uint64_t j = 0; j < size; ++j)
                                               marks[j] = (sets[j] & bit) != 0 ? 1 : 0;
                                       });
    distance_counts total;
    total.beyond.assign(radii.size(), 0);
#pragma omp parallel
    {
        distance_counts own;
        own.beyond.assign(radii.size(), 0);
        std::vector<class_set> sets(size);
        std::vector<double> squared(size);
#pragma omp for schedule(dynamic)
        for (std::uint64_t i = 0; i < distances.n_slabs(); ++i) {
            boundaries_in_slab(grid, i, sets);
            distances.squared(i, squared);
            for (std::uint64_t j = 0; j < size; ++j) {
                if (sets[j] == 0) continue;
                ++own.n_boundary;
                own.n_cells += (sets[j] & bit) != 0 ? 1 : 0;
                own.largest = std::max(own.largest, squared[j]);
                for (std::size_t r = 0; r < radii.size(); ++r) {
                    own.beyond[r] += squared[j] > radii[r] * radii[r] ? 1 : 0;
                }
            }
        }
#pragma omp critical
        {
            total.n_boundary += own.n_boundary;
            total.n_cells += own.n_cells;
            total.largest = std::max(total.largest, own.largest);
            for (std::size_t r = 0; r < radii.size(); ++r) total.beyond[r] += own.beyond[r];
        }
    }
    return total;
}

}  // namespace

double wada_test::radius() const {
    double largest = 0.0;
    for (const merged_boundary& each : classes) largest = std::max(largest, each.radius);
    return largest;
}

double wada_test::beyond(std::size_t i) const {
    double largest = 0.0;
    for (const merged_boundary& each : classes) largest = std::max(largest, each.beyond[i]);
    return largest;
}

wada_test wada_of(const class_grid& grid) {
    wada_test result;
    if (grid.classes.size() < 3) {
        result.why = "it takes three basins or more";
        return result;
    }
    if (grid.n_lumped > 0) {
        result.why = "rare basins are counted together";
        return result;
    }
    result.is_defined = true;
    for (std::size_t k = 0; k < grid.classes.size(); ++k) {
        const distance_counts counts = counts_for(grid, k, result.radii);
        merged_boundary& merged = result.classes.emplace_back();
        merged.n_cells = counts.n_cells;
        merged.radius = std::sqrt(counts.largest);
        for (const std::uint64_t n : counts.beyond) {
            merged.beyond.push_back(static_cast<double>(n) /
                                    static_cast<double>(counts.n_boundary));
        }
    }
    return result;
}

}  // namespace hopscotch::metrics
