#include "analysis/labels/orbit_sides.hpp"

#include "analysis/attractors/sectors.hpp"
#include "analysis/labels/one_sided.hpp"
#include "analysis/labels/plan_points.hpp"
#include "analysis/labels/point_search.hpp"
#include "analysis/labels/slice_attractors.hpp"
#include "analysis/metrics/class_slices.hpp"
#include "analysis/metrics/shares.hpp"
#include "analysis/periodic/return_equation.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

orbit_side side_of(const stability_side& from, double direction) {
    return {.direction = {direction},
            .kind = from.kind,
            .coefficient = from.coefficient,
            .exponent = from.exponent,
            .extent = from.extent};
}

sided_orbit orbit_of(const attractor_row& row, const one_sided_stability& sides) {
    return {.label = row.label,
            .name = row.name,
            .period = row.period,
            .state = {sides.point},
            .scale = {1.0},
            .sides = {side_of(sides.left, -1.0), side_of(sides.right, 1.0)}};
}

/// Distances of a single free column are told in its own unit, c s (d / s)^e.
orbit_side side_of(const stability_sector& from, double unit) {
    return {.direction = from.direction,
            .kind = from.kind,
            .coefficient = from.step_coefficient * std::pow(unit, 1.0 - from.step_exponent),
            .exponent = from.step_exponent,
            .extent = from.extent * unit,
            .is_bounded = from.is_bounded};
}

/// What is asked at one parameter point.
class point_sides {
public:
    point_sides(const scene& scene, const label_plan& plan, const plan_points& points,
                std::size_t point)
        : scene_(scene),
          plan_(plan),
          points_(points),
          point_(point),
          coordinates_(points.coordinates_of_point(point)) {}

    std::vector<sided_orbit> orbits() const {
        const map_point map = points_.map_at(point_);
        std::vector<sided_orbit> found;
        if (scene_.model->branch && plan_.decided_by != decision::ellipsoids) {
            found = on_branches(map);
        }
        if (plan_.decided_by != decision::intervals) add_by_rays(map, found);
        std::sort(found.begin(), found.end(),
                  [](const sided_orbit& a, const sided_orbit& b) { return a.label < b.label; });
        for (sided_orbit& each : found) each.point = point_;
        return found;
    }

private:
    static bool has(const std::vector<sided_orbit>& found, int label) {
        return std::any_of(found.begin(), found.end(),
                           [&](const sided_orbit& each) { return each.label == label; });
    }

    std::vector<sided_orbit> on_branches(const map_point& map) const {
        std::vector<sided_orbit> found;
        for (const auto& [row, sides] : sided_attractors(scene_, plan_, map.parameters)) {
            found.push_back(orbit_of(*row, sides));
        }
        if (plan_.decided_by != decision::intervals) return found;
        const return_map_samples samples(scene_, map.parameters);
        const std::size_t plan_point = point_index(scene_, plan_, coordinates_);
        const auto n = static_cast<std::size_t>(plan_.n_traps);
        const auto traps = std::span(plan_.traps).subspan(plan_point * n, n);
        for (const attractor_row& row : attractors_at(scene_, plan_, coordinates_)) {
            if (has(found, row.label)) continue;
            const auto trap =
                std::find_if(traps.begin(), traps.end(), [&](const trap_interval& each) {
                    return each.label == row.label && each.lowest <= row.points[0] &&
                           row.points[0] <= each.highest;
                });
            if (trap == traps.end()) continue;
            found.push_back(
                orbit_of(row, one_sided_of_cycle(samples, row.points[0], row.period, *trap)));
        }
        return found;
    }

    void add_by_rays(const map_point& map, std::vector<sided_orbit>& found) const {
        std::vector<attractor_row> rows = attractors_at(scene_, plan_, coordinates_);
        std::erase_if(rows, [&](const attractor_row& row) { return has(found, row.label); });
        if (rows.empty()) return;
        const std::vector<double> starts =
            points_.starts_at(point_, samples_of(scene_, points_.size()));
        const std::vector<double> scale = scale_of(map, scene_.section, starts);
        const auto n_traps = static_cast<std::size_t>(plan_.n_ellipsoids);
        const std::size_t plan_point = point_index(scene_, plan_, coordinates_);
        const auto traps = std::span(plan_.ellipsoids).subspan(plan_point * n_traps, n_traps);
        for (const attractor_row& row : rows) {
            const std::span<const double> point(row.points.data(), scale.size());
            const std::vector<int> free = free_columns(map, point);
            if (free.empty() || row.period == 0) continue;
            const bool is_line = free.size() == 1;
            sided_orbit orbit{.label = row.label,
                              .name = row.name,
                              .period = row.period,
                              .state = {point.begin(), point.end()},
                              .scale = is_line ? std::vector<double>(scale.size(), 1.0) : scale};
            const double unit = is_line ? scale[static_cast<std::size_t>(free[0])] : 1.0;
            for (const stability_sector& sector : sectors_of(map, {.point = point,
                                                                  .period = row.period,
                                                                  .free = free,
                                                                  .scale = scale,
                                                                  .traps = traps,
                                                                  .label = row.label})) {
                orbit.sides.push_back(side_of(sector, unit));
            }
            found.push_back(std::move(orbit));
        }
    }

    static std::vector<int> free_columns(const map_point& map, std::span<const double> point) {
        const std::vector<int> conserved = conserved_columns(map, point);
        std::vector<int> free;
        for (int c = 0; c < static_cast<int>(point.size()); ++c) {
            if (std::find(conserved.begin(), conserved.end(), c) == conserved.end()) {
                free.push_back(c);
            }
        }
        return free;
    }

    const scene& scene_;
    const label_plan& plan_;
    const plan_points& points_;
    std::size_t point_;
    std::vector<std::uint64_t> coordinates_;
};

/// The side of an orbit that a start is on: the direction it is nearest to.
std::size_t side_at(const sided_orbit& orbit, std::span<const double> start) {
    std::size_t nearest = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < orbit.sides.size(); ++k) {
        double along = 0.0;
        for (std::size_t c = 0; c < start.size(); ++c) {
            along += orbit.sides[k].direction[c] * (start[c] - orbit.state[c]) / orbit.scale[c];
        }
        if (along > largest) {
            largest = along;
            nearest = k;
        }
    }
    return nearest;
}

/// Shares of one orbit's sides in its slice.
class slice_shares {
public:
    slice_shares(const scene& scene, const metrics::class_grid& slice) : scene_(scene) {
        slice_ = slice;
        const auto& columns = scene.start_section().columns;
        for (const axis& each : slice.axes) {
            for (std::size_t c = 0; c < columns.size(); ++c) {
                if (columns[c].name == each.name) columns_.push_back(c);
            }
        }
    }

    /// All axes of the slice are columns of the section that returns end on.
    bool is_of_starts() const {
        return columns_.size() == slice_.rank() && &scene_.start_section() == &scene_.end_section();
    }

    void fill(sided_orbit& orbit) const {
        const auto own = std::find_if(
            slice_.classes.begin(), slice_.classes.end(),
            [&](const auto& each) { return !each.is_outcome && each.value == orbit.label; });
        const auto label = static_cast<metrics::class_index>(own - slice_.classes.begin());
        metrics::class_grid sides;
        sides.axes = slice_.axes;
        sides.cells = slice_.cells;
        sides.classes.resize(orbit.sides.size() + 1);  // the last one: all others
        const auto others = static_cast<metrics::class_index>(orbit.sides.size());
        for (std::uint64_t cell = 0; cell < sides.cells.size(); ++cell) {
            metrics::class_index& value = sides.cells[cell];
            if (value == metrics::no_class) continue;
            value = value == label
                        ? static_cast<metrics::class_index>(side_at(orbit, start_at(orbit, cell)))
                        : others;
            ++sides.classes[value].n_cells;
        }
        const metrics::basin_shares shares =
            metrics::shares_in(sides, metrics::value_box::whole(sides));
        for (std::size_t k = 0; k < orbit.sides.size(); ++k) {
            orbit.sides[k].share = shares.classes[k].share;
            orbit.sides[k].share_error = shares.classes[k].error;
        }
    }

private:
    /// Columns without an axis are those of the orbit: they tell no sides apart.
    std::vector<double> start_at(const sided_orbit& orbit, std::uint64_t cell) const {
        std::vector<double> start = orbit.state;
        for (std::size_t k = slice_.rank(); k-- > 0;) {
            const std::uint64_t n = slice_.axes[k].size();
            start[columns_[k]] = slice_.axes[k].values[cell % n];
            cell /= n;
        }
        return start;
    }

    const scene& scene_;
    metrics::class_grid slice_;
    std::vector<std::size_t> columns_;  // of each axis
};

}  // namespace

side_table sides_of(const scene& scene, const label_plan& plan) {
    side_table table{.axes = axes_of_points(scene)};
    const plan_points points(scene, table.axes);
    table.n_points = points.size();
    std::vector<std::vector<sided_orbit>> found(points.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t point = 0; point < points.size(); ++point) {
        found[point] = point_sides(scene, plan, points, point).orbits();
    }
    for (auto& at_point : found) {
        std::move(at_point.begin(), at_point.end(), std::back_inserter(table.orbits));
    }
    return table;
}

void add_shares(side_table& table, const scene& scene, const metrics::class_grid& map) {
    std::vector<std::string> names;
    for (const std::size_t axis : table.axes) names.push_back(scene.axes[axis].name);
    const metrics::class_slices slices(map, names);
    if (slices.kept().empty()) return;
    // axes of one cell are none of the map's: its slices are the table's points
    const std::size_t n_orbits = table.orbits.size();
    std::vector<std::size_t> first(slices.size() + 1, n_orbits);
    for (std::size_t i = n_orbits; i-- > 0;) first[table.orbits[i].point] = i;
    for (std::size_t s = slices.size(); s-- > 0;) first[s] = std::min(first[s], first[s + 1]);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t s = 0; s < slices.size(); ++s) {
        if (first[s] == first[s + 1]) continue;
        const slice_shares shares(scene, slices.cut(s));
        if (!shares.is_of_starts()) continue;
        for (std::size_t i = first[s]; i < first[s + 1]; ++i) shares.fill(table.orbits[i]);
    }
}

}  // namespace hopscotch
