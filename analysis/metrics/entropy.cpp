#include "analysis/metrics/entropy.hpp"

#include "analysis/metrics/parts.hpp"
#include "analysis/metrics/scaling_fit.hpp"
#include "host/store/store_error.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

namespace hopscotch::metrics {
namespace {

/// Where one box lies: its first cell, and its sides (1 along a missing axis).
struct cell_box {
    std::array<std::uint64_t, 3> origin;
    std::array<std::uint64_t, 3> side;
};

/// Entropy of one box; -1 where none of its cells has a class.
double box_entropy(const class_grid& grid, const cell_box& box) {
    std::array<std::uint32_t, most_classes + 1> counts{};
    std::uint32_t n = 0;
    class_set seen = 0;
    for (std::uint64_t a = box.origin[0]; a < box.origin[0] + box.side[0]; ++a) {
        for (std::uint64_t b = box.origin[1]; b < box.origin[1] + box.side[1]; ++b) {
            const class_index* row = grid.row(a, b);
            for (std::uint64_t c = box.origin[2]; c < box.origin[2] + box.side[2]; ++c) {
                if (row[c] == no_class) continue;
                seen |= class_bits[row[c]];
                ++counts[row[c]];
                ++n;
            }
        }
    }
    if (n == 0) return -1.0;
    double entropy = 0.0;
    for (std::size_t k = 0; is_mixed(seen) && k < grid.classes.size(); ++k) {
        if (counts[k] == 0) continue;
        const double p = static_cast<double>(counts[k]) / n;
        entropy -= p * std::log(p);
    }
    return entropy;
}

}  // namespace

bool basin_entropy::is_above_ln2() const { return boundary > std::numbers::ln2; }

std::uint64_t default_box(const class_grid& grid) {
    std::uint64_t box = grid.rank() == 1 ? 25 : grid.rank() == 2 ? 5 : 3;
    for (const axis& each : grid.axes) box = std::min(box, each.size());
    return box;
}

basin_entropy entropy_of(const class_grid& grid, std::uint64_t box) {
    const std::array<std::uint64_t, 3> n = grid.extent();
    std::array<std::uint64_t, 3> side{};
    std::array<std::uint64_t, 3> n_boxes{};
    for (std::size_t i = 0; i < 3; ++i) {
        side[i] = n[i] == 1 ? 1 : box;
        n_boxes[i] = box == 0 ? 0 : n[i] / side[i];
        if (box < 2 || n_boxes[i] == 0) {
            throw store_error(
                fmt::format("box of {} cells", box),
                fmt::format("it needs 2 cells at least and fits into no map of {}",
                            fmt::join(n.begin() + static_cast<std::ptrdiff_t>(3 - grid.rank()),
                                      n.end(), " x ")),
                "--box 2");
        }
    }

    const map_parts parts(n_boxes, grid.rank());
    struct sums {
        double entropy = 0.0;
        double boxes = 0.0;
        double boundary_boxes = 0.0;
    };
    std::vector<double> entropies(n_boxes[0] * n_boxes[1] * n_boxes[2]);
#pragma omp parallel for schedule(static)
    for (std::uint64_t i = 0; i < entropies.size(); ++i) {
        const std::uint64_t row = i / n_boxes[2];
        entropies[i] = box_entropy(grid, {{row / n_boxes[1] * side[0], row % n_boxes[1] * side[1],
                                           i % n_boxes[2] * side[2]},
                                          side});
    }
    std::vector<sums> by_part(parts.size());  // added in order, whatever the threads did
    for (std::uint64_t i = 0; i < entropies.size(); ++i) {
        if (entropies[i] < 0.0) continue;
        const std::uint64_t row = i / n_boxes[2];
        sums& part = by_part[parts.of(row / n_boxes[1], row % n_boxes[1], i % n_boxes[2])];
        part.entropy += entropies[i];
        part.boxes += 1.0;
        part.boundary_boxes += entropies[i] > 0.0 ? 1.0 : 0.0;
    }

    basin_entropy result;
    result.box = box;
    std::vector<double> values;
    std::vector<double> weights;
    double total = 0.0;
    for (const sums& part : by_part) {
        total += part.entropy;
        result.n_boxes += static_cast<std::uint64_t>(part.boxes);
        result.n_boundary_boxes += static_cast<std::uint64_t>(part.boundary_boxes);
        values.push_back(part.entropy);
        weights.push_back(part.boundary_boxes);
    }
    result.whole = result.n_boxes == 0 ? 0.0 : total / static_cast<double>(result.n_boxes);
    const ratio_estimate boundary = ratio_over_parts(values, weights);
    result.boundary = boundary.ratio;
    result.boundary_error = boundary.error;
    return result;
}

}  // namespace hopscotch::metrics
