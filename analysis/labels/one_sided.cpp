// Extents by sampling the branch and bisecting the last step; laws by two-point fits.
#include "analysis/labels/one_sided.hpp"

#include "analysis/labels/plan.hpp"
#include "analysis/labels/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

/// The law |P(x) - x| ~ C d^p next to the point, on the side of `direction`.
stability_side law_of(const return_map_samples& map, double point, double direction,
                      std::uint32_t period = 1) {
    constexpr double near = 1e-6;
    constexpr double far = 1e-5;
    const auto step = [&](double distance) {
        const double x = point + direction * distance;
        return map.at(x, period) - x;
    };
    const double step_near = step(near);
    const double step_far = step(far);
    stability_side side;
    // inward, and beyond the point by no more than the distance: a multiplier between -1 and 1
    const auto comes_nearer = [&](double moved, double distance) {
        return moved * direction < 0.0 && std::abs(moved) < 2.0 * distance;
    };
    side.attracts = comes_nearer(step_near, near) && comes_nearer(step_far, far);
    const bool stays =
        std::abs(step_near) <= neutral_step * near && std::abs(step_far) <= neutral_step * far;
    side.kind = stays           ? side_kind::neutral
                : side.attracts ? side_kind::attracting
                                : side_kind::repelling;
    side.exponent = std::log(step_far / step_near) / std::log(far / near);
    side.coefficient = std::abs(step_near) / std::pow(near, side.exponent);
    return side;
}

/// The row of the lossless point of branch k; its speed may differ from parameter point to point.
bool is_semi_stable(const attractor_row& row, int k) {
    return row.name == fmt::format("fixed point {}", k) && row.multipliers_real == std::vector{1.0};
}

}  // namespace

one_sided_stability one_sided(const return_map_samples& map, const map_branch& branch,
                              double floor) {
    one_sided_stability result{branch.base, law_of(map, branch.base, -1.0),
                               law_of(map, branch.base, 1.0)};
    const auto stays = [&](double direction) {
        return [&map, &branch, direction](double x) {
            const double image = map.at(x);
            return (image - branch.base) * direction >= 0.0 && (image - x) * direction <= 0.0;
        };
    };
    if (result.right.attracts) {
        result.right.extent = last_of_interval(branch.base, branch.end, stays(1.0)) - branch.base;
    }
    if (result.left.attracts) {
        result.left.extent = branch.base - last_of_interval(branch.base, floor, stays(-1.0));
    }
    return result;
}

one_sided_stability one_sided_of_cycle(const return_map_samples& map, double point, int period,
                                       const trap_interval& trap) {
    const auto returns = static_cast<std::uint32_t>(period);
    one_sided_stability result{point, law_of(map, point, -1.0, returns),
                               law_of(map, point, 1.0, returns)};
    if (period == 1) {
        result.left.extent = point - trap.lowest;
        result.right.extent = trap.highest - point;
        return result;
    }
    constexpr std::uint32_t settling = 200;  // visits
    const auto tends = [&](double x) {
        return std::abs(map.at(x, settling * returns) - point) < 1e-6 * std::abs(point);
    };
    result.left.extent = point - last_of_interval(point, trap.lowest, tends);
    result.right.extent = last_of_interval(point, trap.highest, tends) - point;
    return result;
}

std::vector<sided_attractor> sided_attractors(const scene& scene, const label_plan& plan,
                                              const std::vector<double>& parameters) {
    std::vector<sided_attractor> found;
    const return_map_samples map(scene, parameters);
    double floor = 0.0;
    map_branch branch{};
    for (int k = 0; scene.model->branch(k, parameters.data(), branch); ++k) {
        const auto row = std::find_if(
            plan.attractors.begin(), plan.attractors.end(),
            [&](const attractor_row& attractor) { return is_semi_stable(attractor, k); });
        if (row != plan.attractors.end()) {
            found.push_back({&*row, one_sided(map, branch, floor)});
        } else if (k > 0) {
            break;
        }
        floor = branch.end;
    }
    return found;
}

void add_immediate_basins(const scene& scene, label_plan& plan) {
    plan.point_axes = parameter_axes(scene);
    const auto points = parameter_points(scene, plan.point_axes);
    const std::size_t most = plan.attractors.size();
    plan.n_immediate = static_cast<int>(most);
    plan.immediate.assign(points.size() * most, {unbounded, -unbounded, 0});
#pragma omp parallel for schedule(dynamic)
    for (std::size_t p = 0; p < points.size(); ++p) {
        std::size_t slot = p * most;
        for (const auto& [row, sides] : sided_attractors(scene, plan, points[p])) {
            plan.immediate[slot++] = {sides.point - sides.left.extent,
                                      sides.point + sides.right.extent, row->label};
        }
    }
}

}  // namespace hopscotch
