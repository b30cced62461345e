#include "analysis/labels/slice_attractors.hpp"

#include "analysis/attractors/settle.hpp"
#include "analysis/labels/plan.hpp"
#include "analysis/labels/plan_points.hpp"
#include "analysis/periodic/periodic_orbit.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>

namespace hopscotch {
namespace {

/// Points of a label at a parameter point, where the plan has them point by point.
std::vector<double> points_at(const label_plan& plan, std::size_t point, int label) {
    std::vector<double> points;
    if (plan.decided_by == decision::intervals) {
        for (const placed_attractor& each : plan.placed) {
            if (each.point == point && each.label == label) return each.points;
        }
        return points;
    }
    const auto n = static_cast<std::size_t>(plan.n_ellipsoids);
    for (const trap_ellipsoid& trap : std::span(plan.ellipsoids).subspan(point * n, n)) {
        if (trap.label != label) continue;
        points.insert(points.end(), trap.centre, trap.centre + trap.n_columns);
    }
    return points;
}

/// A certificate's cycle of that label, found by Newton's method from where starts have settled.
std::vector<double> certified_points(const scene& scene, std::span<const std::uint64_t> coordinates,
                                     const attractor_row& row) {
    constexpr std::size_t n_starts = 64;
    constexpr std::uint32_t settling = 4000;  // returns
    const plan_points points(scene, parameter_axes(scene));
    const std::size_t point = points.point_of(coordinates);
    const map_point map = points.map_at(point);
    const settled_orbits orbits =
        settle(map, scene.section, points.starts_at(point, n_starts), settling);
    for (std::size_t i = 0; i < orbits.size(); ++i) {
        if (orbits.end_of(i) != outcome::ok) continue;
        const std::span<const double> state = orbits.state_of(i);
        if (settle(map, map.section, state, 1, decision::ellipsoids).label[0] != row.label)
            continue;
        const auto orbit = refine_periodic_orbit(map, state, row.period);
        if (orbit && orbit->is_stable()) return orbit->points;
    }
    return {};
}

}  // namespace

std::vector<attractor_row> attractors_at(const scene& scene, const label_plan& plan,
                                         std::span<const std::uint64_t> coordinates) {
    std::vector<attractor_row> rows = plan.attractors;
    for (attractor_row& row : rows) {
        if (plan.decided_by != decision::certificate) {
            row.points = points_at(plan, point_index(scene, plan, coordinates), row.label);
        } else if (row.points.empty() && row.period > 0) {
            row.points = certified_points(scene, coordinates, row);
        }
    }
    std::erase_if(rows, [](const attractor_row& row) { return row.points.empty(); });
    return rows;
}

metrics::slice_choice slices_of(const scene& scene, const label_plan& plan,
                                const std::vector<std::size_t>& axes,
                                std::map<std::string, double> plane) {
    metrics::slice_choice choice;
    for (const std::size_t axis : axes) choice.axes.push_back(scene.axes[axis].name);
    choice.attractors = [&scene, &plan, axes,
                         plane = std::move(plane)](std::span<const std::uint64_t> at) {
        std::vector<std::uint64_t> coordinates(scene.axes.size(), 0);
        metrics::attractor_points points{{}, plan.point_columns, plane};
        for (std::size_t i = 0; i < axes.size(); ++i) {
            coordinates[axes[i]] = at[i];
            const scene_axis& axis = scene.axes[axes[i]];
            if (axis.kind == axis_kind::column) points.plane[axis.name] = value_of(axis, at[i]);
        }
        points.attractors = attractors_at(scene, plan, coordinates);
        return points;
    };
    return choice;
}

}  // namespace hopscotch
