// Basin boundaries under the microscope: lines through a scene, the places on them where the answer
// changes, and scenes whose cells stand one ulp apart around such a place. There the arithmetic
// really gives wrong labels, so that claims about them can fail.
#pragma once

#include "analysis/labels/plan.hpp"
#include "host/run/labelled_run.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace hopscotch::hard {

/// The scene with one of its column axes alone, the `which`-th (counted around); the other axes
/// stand at the share `place` of theirs.
inline scene line_through(scene from, double place, std::size_t which = 0) {
    const auto is_column = [](const scene_axis& axis) { return axis.kind == axis_kind::column; };
    const auto n_columns =
        static_cast<std::size_t>(std::count_if(from.axes.begin(), from.axes.end(), is_column));
    std::vector<scene_axis> axes;
    std::size_t n_seen = 0;
    for (const scene_axis& axis : from.axes) {
        if (is_column(axis) && n_seen++ == which % n_columns) {
            axes.push_back(axis);
            continue;
        }
        const auto cell = static_cast<std::uint64_t>(place * static_cast<double>(axis.cells));
        auto& values = axis.kind == axis_kind::column ? from.start : from.parameters;
        values[static_cast<std::size_t>(axis.index)] = value_of(axis, cell);
    }
    from.axes = axes;
    return from;
}

/// The same line from low to high, ends included.
inline scene part_of(scene line, double low, double high, std::uint64_t cells) {
    scene_axis& axis = line.axes[0];
    axis.lowest = low;
    axis.highest = high;
    axis.cells = cells;
    axis.scale = axis_scale::linear;
    axis.edges = true;
    return line;
}

inline std::vector<std::uint64_t> all_cells_of(const scene& scene) {
    std::vector<std::uint64_t> cells(scene.n_cells());
    std::iota(cells.begin(), cells.end(), std::uint64_t{0});
    return cells;
}

/// What the map would store of some cells: label, or outcome.
inline std::vector<int> answers_of(const scene& line, const label_plan& plan,
                                   const kernel_choice& kernel,
                                   const std::vector<std::uint64_t>& cells) {
    cell_request request = request_of(line, plan, cells);
    std::vector<std::int16_t> label(cells.size());
    std::vector<std::uint8_t> end(cells.size());
    std::vector<std::uint32_t> returns(cells.size());
    if (line.question.has_labels) request.request.label = label.data();
    request.request.outcome = end.data();
    request.request.returns = returns.data();
    run_labelled(line, plan, kernel.run, request.request);
    std::vector<int> answers;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        answers.push_back(line.question.has_labels ? label[i] : end[i]);
    }
    return answers;
}

inline double ulp_of(double x) {
    return std::nextafter(std::abs(x), std::numeric_limits<double>::infinity()) - std::abs(x);
}

/// Where the answer changes between low and high, as far as doubles tell.
inline double change_between(const scene& line, const label_plan& plan, const kernel_choice& kernel,
                             double low, double high) {
    while (high - low > 16.0 * ulp_of(high)) {
        const scene part = part_of(line, low, high, 17);
        const std::vector<int> answers = answers_of(part, plan, kernel, all_cells_of(part));
        std::uint64_t i = 1;
        while (i + 1 < answers.size() && answers[i] == answers[0]) ++i;
        low = value_of(part.axes[0], i - 1);
        high = value_of(part.axes[0], i);
    }
    return low;
}

/// Up to `most` changes on a line of `cells` cells.
inline std::vector<double> changes_on(const scene& line, const label_plan& plan,
                                      const kernel_choice& kernel, std::uint64_t cells,
                                      std::size_t most) {
    const scene coarse = part_of(line, line.axes[0].lowest, line.axes[0].highest, cells);
    const std::vector<int> answers = answers_of(coarse, plan, kernel, all_cells_of(coarse));
    std::vector<double> changes;
    for (std::uint64_t i = 1; i < answers.size() && changes.size() < most; ++i) {
        if (answers[i] == answers[i - 1]) continue;
        const double at = change_between(line, plan, kernel, value_of(coarse.axes[0], i - 1),
                                         value_of(coarse.axes[0], i));
        // next to zero cells one ulp apart would be finer than the numbers they are added to
        if (std::abs(at) > 1e-3 * (line.axes[0].highest - line.axes[0].lowest))
            changes.push_back(at);
    }
    return changes;
}

}  // namespace hopscotch::hard
