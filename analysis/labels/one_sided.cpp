// Extents by sampling the branch and bisecting the last step; laws by two-point fits.
#include "analysis/labels/one_sided.hpp"

#include "analysis/labels/plan.hpp"
#include "analysis/labels/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

/// The law |P(x) - x| ~ C d^p next to the point, on the side of `direction`.
stability_side law_of(const return_map_samples& map, double point, double direction) {
    constexpr double near = 1e-6;
    constexpr double far = 1e-5;
    const double step_near = map.at(point + direction * near) - (point + direction * near);
    const double step_far = map.at(point + direction * far) - (point + direction * far);
    stability_side side;
    side.attracts = step_near * direction < 0.0 && step_far * direction < 0.0;
    side.exponent = std::log(step_far / step_near) / std::log(far / near);
    side.coefficient = std::abs(step_near) / std::pow(near, side.exponent);
    return side;
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

void add_immediate_basins(const scene& scene, label_plan& plan) {
    plan.point_axes = parameter_axes(scene);
    const auto points = parameter_points(scene, plan.point_axes);
    std::vector<const attractor_row*> rows;
    for (const attractor_row& row : plan.attractors) {
        if (row.period == 1 && !row.points.empty()) rows.push_back(&row);
    }
    plan.n_immediate = static_cast<int>(rows.size());
    plan.immediate.assign(points.size() * rows.size(), {unbounded, -unbounded, 0});
#pragma omp parallel for schedule(dynamic)
    for (std::size_t p = 0; p < points.size(); ++p) {
        const return_map_samples map(scene, points[p]);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            map_branch branch{};
            map_branch before{};
            for (int k = 0; scene.model->branch(k, branch) && branch.base < rows[r]->points[0];
                 ++k) {
                before = branch;
            }
            if (branch.base != rows[r]->points[0]) continue;
            const one_sided_stability found = one_sided(map, branch, before.end);
            plan.immediate[p * rows.size() + r] = {
                branch.base - found.left.extent, branch.base + found.right.extent, rows[r]->label};
        }
    }
}

}  // namespace hopscotch
