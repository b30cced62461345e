#include "analysis/metrics/uncertainty.hpp"

#include "analysis/metrics/boundary.hpp"
#include "analysis/metrics/class_counts.hpp"
#include "analysis/metrics/parts.hpp"

#include <algorithm>

namespace hopscotch::metrics {
namespace {

std::vector<std::uint64_t> steps_for(const class_grid& grid) {
    std::uint64_t shortest = grid.axes.front().size();
    for (const axis& each : grid.axes) shortest = std::min(shortest, each.size());
    const std::uint64_t longest = std::max<std::uint64_t>(shortest / 16, 4);
    std::vector<std::uint64_t> steps;
    for (std::uint64_t octave = 1; octave <= longest && 3 * octave <= shortest; octave *= 2) {
        steps.push_back(octave);
        const std::uint64_t between = octave + octave / 2;
        if (octave > 1 && between <= longest && 3 * between <= shortest) steps.push_back(between);
    }
    return steps;
}

/// The cells that have a neighbour at the largest step on both sides of every axis.
struct inner_cells {
    std::array<std::uint64_t, 3> margin{};
    std::array<std::uint64_t, 3> extent{};

    inner_cells(const class_grid& grid, std::uint64_t largest) {
        const std::array<std::uint64_t, 3> n = grid.extent();
        for (std::size_t i = 0; i < 3; ++i) {
            margin[i] = n[i] == 1 ? 0 : largest;
            extent[i] = n[i] - 2 * margin[i];
        }
    }
};

}  // namespace

scaling_by_class uncertainty_of(const class_grid& grid) {
    const std::vector<std::uint64_t> steps = steps_for(grid);
    const inner_cells inner(grid, steps.empty() ? 0 : steps.back());
    const map_parts parts(inner.extent, grid.rank());
    class_counts counts(parts.size(), steps.size(), grid.classes.size());
    const std::uint64_t length = grid.extent()[2];
#pragma omp parallel
    {
        class_counts own(parts.size(), steps.size(), grid.classes.size());
        std::vector<class_set> row(length);
#pragma omp for schedule(static)
        for (std::uint64_t r = 0; r < inner.extent[0] * inner.extent[1]; ++r) {
            const std::uint64_t a = r / inner.extent[1];
            const std::uint64_t b = r % inner.extent[1];
            for (std::size_t scale = 0; scale < steps.size(); ++scale) {
                neighbourhoods(grid, a + inner.margin[0], b + inner.margin[1], steps[scale], row);
                for (std::uint64_t c = 0; c < inner.extent[2]; ++c) {
                    const class_set set = row[c + inner.margin[2]];
                    if ((set & undecided_bit) != 0) continue;
                    own.add(parts.of(a, b, c), scale, boundaries_through(set));
                }
            }
        }
#pragma omp critical
        counts.add(own);
    }
    return counts.fit(steps);
}

}  // namespace hopscotch::metrics
