// From a scene to its label plan.
#include "analysis/labels/plan.hpp"

#include "analysis/labels/interval_trap.hpp"
#include "analysis/labels/label_colours.hpp"
#include "analysis/labels/one_sided.hpp"
#include "analysis/labels/period_plan.hpp"
#include "analysis/labels/plan_points.hpp"
#include "analysis/labels/point_search.hpp"
#include "analysis/labels/searched_plan.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace hopscotch {
namespace {

std::string name_of(const label_description& text) {
    return text.index < 0 ? std::string(text.kind) : fmt::format("{} {}", text.kind, text.index);
}

/// The largest value of the section's first column that any cell starts from.
double highest_start(const scene& scene) {
    double highest = scene.start.empty() ? 0.0 : scene.start[0];
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind == axis_kind::column && axis.index == 0) highest = axis.highest;
    }
    return highest;
}

/// Labels of the model's certificate that a start of this map can reach; all of them where the
/// start is a state of more than one column.
label_plan plan_by_certificate(const scene& scene) {
    label_plan plan;
    plan.decided_by = decision::certificate;
    plan.died_label = 1;
    plan.point_columns = {std::string(scene.end_section().columns[0].name)};
    const bool is_direct = &scene.start_section() == &scene.end_section();
    const double highest = is_direct ? highest_start(scene) : unbounded;
    constexpr int most_listed = 64;
    label_description text;
    for (int label = 1; label <= most_listed && scene.model->describe_label(label, text); ++label) {
        if (text.has_point && text.point > highest) break;
        attractor_row row{.label = label, .name = name_of(text), .period = text.period};
        if (text.has_point) {
            row.points = {text.point};
            row.multipliers_real = {text.multiplier};
            row.multipliers_imaginary = {0.0};
        }
        row.trap = text.trap;
        row.colour = colour_of(label);
        plan.attractors.push_back(std::move(row));
        text = {};
    }
    return plan;
}

/// True where no sample of the map on (0, end) lies above the identity: orbits there can only sink.
bool only_sinks(const return_map_samples& map, double end) {
    constexpr int n = 400;
    std::vector<double> x;
    for (int i = 1; i <= n; ++i) x.push_back(end * i / (n + 1.0));
    const std::vector<double> images = map.at(x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (images[i] > x[i]) return false;
    }
    return true;
}

/// A trap before it has a label: where it is, and what distinguishes its attractor.
struct found_trap {
    std::size_t point;  // parameter point
    int branch;
    interval_trap trap;

    /// Canonical order of labels: kind of end, then period, then branch.
    std::tuple<int, int, int> rank() const {
        if (trap.kind == attractor_kind::resting) return {-1, 0, 0};
        const bool is_chaotic = trap.kind == attractor_kind::chaotic;
        return {is_chaotic ? 1 : 0, is_chaotic ? 0 : trap.period, branch};
    }
    std::string name() const {
        switch (trap.kind) {
            case attractor_kind::resting:
                return "hopping dies";
            case attractor_kind::fixed_point:
                return fmt::format("fixed point {}", branch);
            case attractor_kind::cycle:
                return fmt::format("period {} at {}", trap.period, branch);
            case attractor_kind::chaotic:
                return fmt::format("chaotic at {}", branch);
        }
        return {};
    }
};

std::vector<found_trap> traps_at(const scene& scene, std::size_t point,
                                 const std::vector<double>& parameters) {
    const return_map_samples map(scene, parameters);
    std::vector<found_trap> found;
    const double highest = highest_start(scene);
    double floor = 0.0;
    map_branch branch{};
    if (scene.model->branch(1, parameters.data(), branch) && only_sinks(map, branch.base)) {
        found.push_back(
            {point, 0, {0.0, std::nextafter(branch.base, 0.0), attractor_kind::resting}});
    }
    for (int k = 0; scene.model->branch(k, parameters.data(), branch); ++k) {
        if (branch.base > highest + 1.0) break;
        if (auto trap = find_interval_trap(map, branch, floor)) found.push_back({point, k, *trap});
        floor = branch.end;
    }
    return found;
}

attractor_row row_of(const found_trap& found, int label) {
    attractor_row row{.label = label, .name = found.name(), .period = found.trap.period};
    row.points = found.trap.points;
    row.colour = colour_of(label);
    if (found.trap.kind == attractor_kind::resting) {
        row.trap = "an interval on which the map is nowhere above the identity; stuck";
        return row;
    }
    row.multipliers_real = {found.trap.multiplier};
    row.multipliers_imaginary = {0.0};
    row.trap = fmt::format("[{:.17g}, {:.17g}] at parameter point {}, {}", found.trap.lowest,
                           found.trap.highest, found.point, found.trap.evidence());
    return row;
}

/// Proofs take longer than the search; maps of more parameter points do without.
constexpr std::size_t most_proved_points = 64;

label_plan plan_by_intervals(const scene& scene) {
    label_plan plan;
    plan.decided_by = decision::intervals;
    plan.died_label = 1;
    plan.point_columns = {std::string(scene.end_section().columns[0].name)};
    plan.point_axes = parameter_axes(scene);
    const auto points = parameter_points(scene, plan.point_axes);
    const plan_points maps(scene, plan.point_axes);
    std::vector<std::vector<found_trap>> found(points.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < points.size(); ++i) {
        found[i] = traps_at(scene, i, points[i]);
        if (points.size() > most_proved_points) continue;
        const map_point map = maps.map_at(i);
        for (found_trap& one : found[i]) {
            if (one.trap.kind != attractor_kind::resting) prove(map, one.trap);
        }
    }

    std::vector<found_trap> kinds;  // one example of each, in canonical order
    std::size_t most = 0;
    for (const auto& at_point : found) {
        most = std::max(most, at_point.size());
        for (const found_trap& trap : at_point) {
            if (std::none_of(kinds.begin(), kinds.end(), [&](const found_trap& other) {
                    return other.rank() == trap.rank();
                })) {
                kinds.push_back(trap);
            }
        }
    }
    std::sort(kinds.begin(), kinds.end(),
              [](const found_trap& a, const found_trap& b) { return a.rank() < b.rank(); });

    found_trap resting{};
    resting.trap.kind = attractor_kind::resting;  // label 1 also names orbits that end stuck
    if (kinds.empty() || kinds.front().rank() != resting.rank())
        kinds.insert(kinds.begin(), resting);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        plan.attractors.push_back(row_of(kinds[i], static_cast<int>(i) + 1));
    }
    plan.n_traps = static_cast<int>(most);
    plan.traps.assign(points.size() * most, {unbounded, -unbounded, 0});
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < found[i].size(); ++j) {
            const auto kind = std::find_if(
                kinds.begin(), kinds.end(),
                [&](const found_trap& other) { return other.rank() == found[i][j].rank(); });
            const interval_trap& trap = found[i][j].trap;
            const auto label = static_cast<std::int16_t>(kind - kinds.begin() + 1);
            plan.traps[i * most + j] = {trap.lowest, trap.highest, label};
            if (trap.kind == attractor_kind::fixed_point || trap.kind == attractor_kind::cycle) {
                plan.placed.push_back({i, label, trap.points});
            }
        }
    }
    return plan;
}

}  // namespace

std::vector<std::vector<double>> parameter_points(const scene& scene,
                                                  const std::vector<std::size_t>& axes) {
    std::vector<std::vector<double>> points{scene.parameters};
    for (const std::size_t axis : axes) {
        const std::vector<double> values = values_of(scene.axes[axis]);
        std::vector<std::vector<double>> product;
        for (const auto& point : points) {
            for (const double value : values) {
                product.push_back(point);
                product.back()[static_cast<std::size_t>(scene.axes[axis].index)] = value;
            }
        }
        points = std::move(product);
    }
    return points;
}

std::vector<std::size_t> parameter_axes(const scene& scene) {
    std::vector<std::size_t> axes;
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
        if (scene.axes[axis].kind == axis_kind::parameter) axes.push_back(axis);
    }
    return axes;
}

label_plan plan_labels(const scene& scene, std::span<const std::uint64_t> searched) {
    label_plan plan;
    if (is_chaos_map(scene)) plan.conserved = conserved_in(scene);
    if (!scene.question.has_labels) return plan;
    const parameter_extremes extremes = extremes_of(scene);
    const variant_query query{extremes.lowest.data(), extremes.highest.data(), scene.options.data(),
                              true};
    const bool is_certain =
        scene.model->certificate_covers && scene.model->certificate_covers(query);
    if (!is_certain && !scene.model->branch) {
        const bool is_by_period = scene.question.kind == "period" && !axes_of_points(scene).empty();
        return is_by_period ? plan_by_period(scene) : plan_by_search(scene, searched);
    }
    plan = is_certain ? plan_by_certificate(scene) : plan_by_intervals(scene);
    if (scene.question.kind == "one_sided" && scene.model->branch) {
        add_immediate_basins(scene, plan);
    }
    return plan;
}

}  // namespace hopscotch
