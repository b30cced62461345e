// One table of labels for all points, and a search per point.
#include "analysis/labels/period_plan.hpp"

#include "analysis/attractors/settle.hpp"
#include "analysis/labels/label_colours.hpp"
#include "analysis/labels/own_labels.hpp"
#include "analysis/labels/point_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace hopscotch {
namespace {

constexpr int longer_by = 4;  // than the longest period: of a search for what was left open

/// Labels: the model's own, then one per period, then chaos, then the longer periods.
class period_labels {
public:
    period_labels(int n_own, int longest) : n_own_(n_own), longest_(longest) {}

    int of(const found_attractor& found) const {
        if (found.kind == attractor_kind::chaotic) return chaos();
        return n_own_ + found.period + (found.period > longest_ ? 1 : 0);
    }
    void add_rows(label_plan& plan) const {
        for (int period = 1; period <= longest_; ++period) add_period(plan, period);
        plan.attractors.push_back({.label = chaos(),
                                   .name = "chaotic",
                                   .period = 0,
                                   .trap = "boxes over sampled states, positive exponent",
                                   .colour = chaos_colour});
        for (int period = longest_ + 1; period <= longer_by * longest_; ++period)
            add_period(plan, period);
    }

private:
    int chaos() const { return n_own_ + longest_ + 1; }
    void add_period(label_plan& plan, int period) const {
        plan.attractors.push_back({.label = n_own_ + period + (period > longest_ ? 1 : 0),
                                   .name = fmt::format("period {}", period),
                                   .period = period,
                                   .trap = "ellipsoids, contraction checked by exact derivatives",
                                   .colour = colour_of(period + 1)});
    }

    int n_own_;
    int longest_;
};

/// A point's starts and, until they are so many, displaced ones.
std::vector<double> starts_near(const scene& scene, const plan_points& points, std::size_t point,
                                std::size_t enough) {
    constexpr double apart = 0x1p-20;
    std::vector<double> starts = points.starts_at(point, samples_of(scene, points.size()));
    const std::size_t n = scene.start_section().columns.size();
    const std::vector<double> own(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(n));
    for (std::size_t i = 1; starts.size() < enough * n; ++i) {
        const double sign = i % 2 == 0 ? 1.0 : -1.0;
        for (const double x : own) {
            const double size = x != 0.0 ? std::abs(x) : apart;
            starts.push_back(x + sign * static_cast<double>(i) * apart * size);
        }
    }
    return starts;
}

/// Whether starts next to each other settle at different times: their transients are chaotic, and
/// on which attractor the start's own orbit ends is a matter of rounding.
bool is_chaotic_transient(const scene& scene, const map_point& map, std::span<const double> starts,
                          const std::vector<found_attractor>& found, std::uint32_t returns) {
    constexpr std::int16_t died = 1;
    std::vector<trap_ellipsoid> traps;
    for (const found_attractor& attractor : found) {
        for (trap_ellipsoid trap : attractor.traps) {
            trap.label = died + 1;
            traps.push_back(trap);
        }
    }
    const settled_orbits orbits =
        settle(map, scene.section, starts, returns, decision::ellipsoids, traps, died);
    const auto [fewest, most] = std::minmax_element(orbits.returns.begin(), orbits.returns.end());
    constexpr std::uint32_t at_most = 8;  // of neighbours that settle alike
    return *most > *fewest + at_most;
}

/// Attractors at one point. Starts that are left open are searched for longer, and where transients
/// are chaotic, more starts are searched: all attractors that neighbours of the start settle on
/// must be known.
std::vector<found_attractor> attractors_near(const scene& scene, const plan_points& points,
                                             std::size_t point, const search_limits& limits) {
    constexpr std::size_t few = 4;
    constexpr std::size_t many = 48;
    const std::vector<double> starts = starts_near(scene, points, point, few);
    attractor_search found = search_point(scene, points, point, starts, limits);
    const auto again = [&](std::size_t enough, const search_limits& wanted) {
        found = search_point(scene, points, point, starts_near(scene, points, point, enough),
                             wanted, std::move(found.attractors));
    };
    if (is_chaotic_transient(scene, points.map_at(point), starts, found.attractors,
                             limits.returns)) {
        again(many, limits);
    }
    if (found.n_open > 0) {
        search_limits thorough = limits;
        thorough.returns *= longer_by;
        thorough.longest_period *= longer_by;
        again(few, thorough);
    }
    return std::move(found.attractors);
}

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
    // a proof (0.2 s) is not worth its while for the one orbit that a cell's trap serves
    search_limits limits = limits_of(scene, points->size());
    limits.wants_proofs = false;
    const period_labels labels(plan.attractors.empty() ? 0 : plan.attractors.back().label,
                               limits.longest_period);
    labels.add_rows(plan);

    label_plan local = plan;
    local.point_axes.clear();
    plan.of_cell = [&scene, points, limits, labels,
                    local](std::span<const std::uint64_t> coordinates) {
        label_plan here = local;
        for (const found_attractor& found :
             attractors_near(scene, *points, points->point_of(coordinates), limits)) {
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
