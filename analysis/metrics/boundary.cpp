#include "analysis/metrics/boundary.hpp"

namespace hopscotch::metrics {
namespace {

void add_row(const class_index* from, std::uint64_t n, std::span<class_set> row) {
    for (std::uint64_t i = 0; i < n; ++i) row[i] |= class_bits[from[i]];
}

}  // namespace

void neighbourhoods(const class_grid& grid, std::uint64_t i0, std::uint64_t i1, std::uint64_t step,
                    std::span<class_set> row) {
    const std::array<std::uint64_t, 3> n = grid.extent();
    const class_index* own = grid.row(i0, i1);
    for (std::uint64_t i = 0; i < n[2]; ++i) row[i] = class_bits[own[i]];
    if (n[2] > step) {
        add_row(own + step, n[2] - step, row);
        add_row(own, n[2] - step, row.subspan(step));
    }
    if (i1 >= step) add_row(grid.row(i0, i1 - step), n[2], row);
    if (i1 + step < n[1]) add_row(grid.row(i0, i1 + step), n[2], row);
    if (i0 >= step) add_row(grid.row(i0 - step, i1), n[2], row);
    if (i0 + step < n[0]) add_row(grid.row(i0 + step, i1), n[2], row);
}

boundary_counts count_boundary_cells(const class_grid& grid) {
    const std::array<std::uint64_t, 3> n = grid.extent();
    std::array<std::uint64_t, 256> counts{};
#pragma omp parallel
    {
        std::vector<class_set> row(n[2]);
        std::array<std::uint64_t, 256> own{};
#pragma omp for schedule(static)
        for (std::uint64_t r = 0; r < n[0] * n[1]; ++r) {
            neighbourhoods(grid, r / n[1], r % n[1], 1, row);
            const class_index* cells = grid.row(r / n[1], r % n[1]);
            for (std::uint64_t i = 0; i < n[2]; ++i) own[cells[i]] += is_mixed(row[i]) ? 1 : 0;
        }
#pragma omp critical
        for (std::size_t k = 0; k < counts.size(); ++k) counts[k] += own[k];
    }
    boundary_counts result;
    for (std::size_t k = 0; k < grid.classes.size(); ++k) {
        result.of_classes.push_back(counts[k]);
        result.n_cells += counts[k];
    }
    return result;
}

}  // namespace hopscotch::metrics
