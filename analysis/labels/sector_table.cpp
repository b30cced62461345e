// Collects the traps of a parameter point by label and walks the rays of each.
#include "analysis/labels/sector_table.hpp"

#include "analysis/labels/point_search.hpp"

#include <algorithm>
#include <set>

namespace hopscotch {
namespace {

std::vector<int> free_columns(const trap_ellipsoid& trap) {
    std::vector<int> free;
    for (int c = 0; c < trap.n_columns; ++c) {
        if (trap.shape[c * trap.n_columns + c] != 0.0) free.push_back(c);
    }
    return free;
}

const attractor_row& row_of(const label_plan& plan, int label) {
    return *std::find_if(plan.attractors.begin(), plan.attractors.end(),
                         [&](const attractor_row& row) { return row.label == label; });
}

}  // namespace

std::vector<sector_row> sector_table(const scene& scene, const label_plan& plan,
                                     std::size_t most_points) {
    std::vector<sector_row> rows;
    if (plan.decided_by != decision::ellipsoids || plan.of_cell) return rows;
    const plan_points points(scene, plan.point_axes);
    const std::size_t stride =
        std::max<std::size_t>(1, (points.size() + most_points - 1) / most_points);
    const auto n_traps = static_cast<std::size_t>(plan.n_ellipsoids);
    for (std::size_t point = 0; point < points.size(); point += stride) {
        const map_point map = points.map_at(point);
        const auto traps = std::span(plan.ellipsoids).subspan(point * n_traps, n_traps);
        const std::vector<double> scale =
            scale_of(map, scene.section, points.starts_at(point, samples_of(scene, points.size())));
        std::set<int> done;
        for (const trap_ellipsoid& trap : traps) {
            if (trap.label == 0 || !done.insert(trap.label).second) continue;
            const attractor_row& attractor = row_of(plan, trap.label);
            const std::vector<int> free = free_columns(trap);
            const std::span<const double> centre(trap.centre,
                                                 static_cast<std::size_t>(trap.n_columns));
            sector_row row{
                points.values_at(point), attractor.name, {centre.begin(), centre.end()}, scale, {}};
            row.sectors = sectors_of(map, {.point = centre,
                                           .period = attractor.period,
                                           .free = free,
                                           .scale = scale,
                                           .traps = traps,
                                           .label = trap.label});
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

}  // namespace hopscotch
