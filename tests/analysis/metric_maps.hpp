// Maps with known metrics, made by hand: straight boundaries, Cantor sets, Newton's method, and the
// map of Grebogi, McDonald, Ott and Yorke.
#pragma once

#include "analysis/metrics/class_grid.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace hopscotch::test {

/// n cell centres between two ends.
inline axis metric_axis(const std::string& name, double lowest, double highest, std::uint64_t n) {
    axis result;
    result.name = name;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        result.values.push_back(lowest + (highest - lowest) * share);
    }
    return result;
}

/// A map of the given axes; `label_of(values)` gives every cell's label, 0 for an undecided one.
template <class Label>
metrics::class_grid metric_map(std::vector<axis> axes, int n_labels, Label&& label_of) {
    metrics::class_grid grid;
    grid.axes = std::move(axes);
    std::uint64_t n = 1;
    for (const axis& each : grid.axes) n *= each.size();
    for (int label = 1; label <= n_labels; ++label) {
        metrics::basin_class& made = grid.classes.emplace_back();
        made.name = "basin " + std::to_string(label);
        made.value = label;
    }
    grid.cells.resize(n);
    std::vector<double> x(grid.rank());
    for (std::uint64_t cell = 0; cell < n; ++cell) {
        std::uint64_t rest = cell;
        for (std::size_t i = grid.rank(); i-- > 0; rest /= grid.axes[i].size()) {
            x[i] = grid.axes[i].values[rest % grid.axes[i].size()];
        }
        const int label = label_of(x);
        if (label == 0) {
            grid.cells[cell] = metrics::no_class;
            ++grid.n_undecided;
        } else {
            grid.cells[cell] = static_cast<metrics::class_index>(label - 1);
            ++grid.classes[static_cast<std::size_t>(label - 1)].n_cells;
        }
    }
    return grid;
}

/// In which generation of Cantor's construction x in (0, 1) is cut out: the first digit 1 in
/// base 3.
inline int cantor_generation(double x) {
    int generation = 1;
    for (; generation < 60; ++generation) {
        x *= 3.0;
        const double digit = std::floor(x);
        if (digit == 1.0) break;
        x -= digit;
    }
    return generation;
}

/// The gaps of the middle-third Cantor set belong to two basins in turn, so that every point of the
/// set is on the boundary: its dimension is ln 2 / ln 3.
inline int cantor_label(double x) { return 1 + cantor_generation(x) % 2; }

/// The root of z^3 = 1 that Newton's method finds.
inline int newton_label(double re, double im) {
    std::complex<double> z(re, im);
    for (int i = 0; i < 200; ++i) {
        const std::complex<double> square = z * z;
        z -= (square * z - 1.0) / (3.0 * square);
        for (int root = 0; root < 3; ++root) {
            if (std::abs(z - std::polar(1.0, 2.0 * std::numbers::pi * root / 3.0)) < 1e-3) {
                return root + 1;
            }
        }
    }
    return 0;
}

/// theta' = theta + 1.32 sin 2 theta - 0.9 sin 4 theta - x sin theta, x' = -0.3 cos theta: two
/// attracting fixed points, (0, -0.3) and (pi, 0.3).
/// Source: Grebogi, McDonald, Ott, Yorke, Phys. Lett. A 99, 415 (1983), Eqs. (3), (4).
inline int grebogi_label(double theta, double x) {
    for (int i = 0; i < 500; ++i) {
        const double s = std::sin(theta);
        const double c = std::cos(theta);
        if (std::abs(s) < 1e-3 && std::abs(x + 0.3 * c) < 1e-3) return c > 0.0 ? 1 : 2;
        const double next =
            theta + 1.32 * std::sin(2.0 * theta) - 0.9 * std::sin(4.0 * theta) - x * s;
        x = -0.3 * c;
        theta = next;
    }
    return 0;
}

}  // namespace hopscotch::test
