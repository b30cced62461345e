// One table of labels for all points, and a search per point.
#include "analysis/labels/period_plan.hpp"

#include "analysis/labels/label_colours.hpp"
#include "analysis/labels/own_labels.hpp"
#include "analysis/labels/point_search.hpp"

#include <fmt/format.h>

#include <memory>

namespace hopscotch {
namespace {

/// Labels: the model's own, then one per period, then chaos.
class period_labels {
public:
    period_labels(int n_own, int longest) : n_own_(n_own), longest_(longest) {}

    int of(const found_attractor& found) const {
        const bool is_chaotic = found.kind == attractor_kind::chaotic;
        return n_own_ + (is_chaotic || found.period > longest_ ? longest_ + 1 : found.period);
    }
    void add_rows(label_plan& plan) const {
        for (int period = 1; period <= longest_ + 1; ++period) {
            const bool is_chaotic = period > longest_;
            attractor_row row{.label = n_own_ + period,
                              .name = is_chaotic ? "chaotic" : fmt::format("period {}", period),
                              .period = is_chaotic ? 0 : period};
            row.trap = is_chaotic ? "boxes over sampled states, positive exponent"
                                  : "ellipsoids, contraction checked by exact derivatives";
            row.colour = is_chaotic ? chaos_colour : colour_of(period + 1);
            plan.attractors.push_back(std::move(row));
        }
    }

private:
    int n_own_;
    int longest_;
};

}  // namespace

label_plan plan_by_period(const scene& scene) {
    label_plan plan;
    plan.decided_by = decision::ellipsoids;
    plan.point_axes = axes_of_points(scene);
    for (const column_info& column : scene.end_section().columns) {
        plan.point_columns.emplace_back(column.name);
    }
    add_own_labels(scene, plan);
    const auto points = std::make_shared<const plan_points>(scene, plan.point_axes);
    const search_limits limits = limits_of(scene, points->size());
    const period_labels labels(plan.attractors.empty() ? 0 : plan.attractors.back().label,
                               limits.longest_period);
    labels.add_rows(plan);

    label_plan local = plan;
    local.point_axes.clear();
    plan.of_cell = [&scene, points, limits, labels,
                    local](std::span<const std::uint64_t> coordinates) {
        const std::size_t point = points->point_of(coordinates);
        const std::vector<double> starts =
            points->starts_at(point, samples_of(scene, points->size()));
        label_plan here = local;
        for (const found_attractor& found :
             search_point(scene, *points, point, starts, limits).attractors) {
            const int label = labels.of(found);
            for (trap_ellipsoid trap : found.traps) {
                trap.label = label;
                here.ellipsoids.push_back(trap);
            }
            if (found.kind == attractor_kind::chaotic) {
                here.chaotic.push_back({0, static_cast<std::int16_t>(label), found.cover});
            }
        }
        here.n_ellipsoids = static_cast<int>(here.ellipsoids.size());
        return here;
    };
    return plan;
}

}  // namespace hopscotch
