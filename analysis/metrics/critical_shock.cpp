#include "analysis/metrics/critical_shock.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace hopscotch::metrics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One length unit's positions of all cells, the missing axes first with the single position 0.
struct positions {
    std::array<std::vector<double>, 3> along;

    positions(const class_grid& grid, length_unit unit) {
        along.fill({0.0});
        for (std::size_t i = 0; i < grid.rank(); ++i) {
            along[3 - grid.rank() + i] = positions_of(grid.axes[i], unit);
        }
    }
};

/// Index of the cell nearest to x.
std::uint64_t nearest_index(const std::vector<double>& along, double x) {
    const auto above = std::lower_bound(along.begin(), along.end(), x);
    if (above == along.begin()) return 0;
    if (above == along.end()) return along.size() - 1;
    const bool is_above = *above - x < x - *(above - 1);
    return static_cast<std::uint64_t>(above - along.begin()) - (is_above ? 0 : 1);
}

struct found_cell {
    double squared = infinity;
    std::uint64_t index = 0;
    double undecided = infinity;  // squared distance of the nearest cell without a class, if nearer

    /// The nearer one, of equally near ones the first: the same for any number of threads.
    bool is_better_than(const found_cell& other) const {
        return squared < other.squared || (squared == other.squared && index < other.index);
    }
};

/// The nearest cell of another class: row after row, each from its nearest cell outward and only as
/// far as it can still win.
found_cell search(const class_grid& grid, const positions& where, const std::array<double, 3>& x,
                  class_index own) {
    const std::array<std::uint64_t, 3> n = grid.extent();
    const std::uint64_t start = nearest_index(where.along[2], x[2]);
    // rows near the point first: the others are then dismissed at once
    std::vector<std::pair<double, std::uint64_t>> rows;
    for (std::uint64_t r = 0; r < n[0] * n[1]; ++r) {
        const double d0 = where.along[0][r / n[1]] - x[0];
        const double d1 = where.along[1][r % n[1]] - x[1];
        rows.emplace_back(d0 * d0 + d1 * d1, r);
    }
    std::sort(rows.begin(), rows.end());
    found_cell best;
    double undecided = infinity;
    for (const auto& [height, r] : rows) {
        if (height > best.squared) break;
        const class_index* row = grid.row(r / n[1], r % n[1]);
        const auto visit = [&](std::uint64_t i) {  // false where going on is useless
            const double d = where.along[2][i] - x[2];
            const double squared = height + d * d;
            if (squared > best.squared) return false;
            if (row[i] == no_class) undecided = std::min(undecided, squared);
            if (row[i] == own || row[i] == no_class) return true;
            const found_cell here{squared, r * n[2] + i};
            if (here.is_better_than(best)) best = here;
            return false;
        };
        for (std::uint64_t i = start; i < n[2] && visit(i); ++i) {
        }
        for (std::uint64_t i = start; i-- > 0 && visit(i);) {
        }
    }
    best.undecided = undecided;
    return best;
}

nearest_other nearest_to(const class_grid& grid, length_unit unit, const std::vector<double>& point,
                         class_index own) {
    const positions where(grid, unit);
    const positions scale(grid, length_unit::axis_units);
    std::array<double, 3> x{};
    nearest_other result;
    result.distance_to_edge = infinity;
    for (std::size_t i = 0; i < grid.rank(); ++i) {
        const std::size_t at = 3 - grid.rank() + i;
        const std::vector<double>& along = where.along[at];
        x[at] = scaled(grid.axes[i], point[i]);
        if (unit == length_unit::cells) {  // between the two cells around the point
            const std::vector<double>& values = scale.along[at];
            const auto above = std::clamp<std::uint64_t>(
                static_cast<std::uint64_t>(std::upper_bound(values.begin(), values.end(), x[at]) -
                                           values.begin()),
                1, values.size() - 1);
            x[at] = static_cast<double>(above - 1) +
                    (x[at] - values[above - 1]) / (values[above] - values[above - 1]);
        }
        result.distance_to_edge =
            std::min({result.distance_to_edge, std::abs(x[at] - along.front()),
                      std::abs(along.back() - x[at])});
    }
    const found_cell found = search(grid, where, x, own);
    result.distance = std::sqrt(found.squared);
    result.distance_to_undecided = std::sqrt(found.undecided);
    if (found.squared == infinity) return result;
    result.class_there = grid.cells[found.index];
    std::uint64_t rest = found.index;
    for (std::size_t i = grid.rank(); i-- > 0; rest /= grid.axes[i].size()) {
        result.at.insert(result.at.begin(), grid.axes[i].values[rest % grid.axes[i].size()]);
    }
    return result;
}

std::uint64_t cell_of(const class_grid& grid, const std::vector<double>& point) {
    std::uint64_t cell = 0;
    for (std::size_t i = 0; i < grid.rank(); ++i) {
        const std::vector<double> along = positions_of(grid.axes[i], length_unit::axis_units);
        cell = cell * along.size() + nearest_index(along, scaled(grid.axes[i], point[i]));
    }
    return cell;
}

/// From the point along one axis, cell by cell, until another class or none is met.
axis_extent extent_along(const class_grid& grid, const std::vector<double>& point,
                         std::size_t which, class_index own) {
    std::uint64_t stride = 1;
    for (std::size_t i = which + 1; i < grid.rank(); ++i) stride *= grid.axes[i].size();
    const std::vector<double> along = positions_of(grid.axes[which], length_unit::axis_units);
    const double x = scaled(grid.axes[which], point[which]);
    const std::uint64_t cell = cell_of(grid, point);
    const std::uint64_t start = cell / stride % along.size();
    const auto class_at = [&](std::uint64_t i) {
        return grid.cells[cell + i * stride - start * stride];
    };
    const auto end_at = [&](std::uint64_t i) {
        return class_at(i) == no_class ? basin_end::undecided : basin_end::other_basin;
    };
    axis_extent result{x - along.front(), along.back() - x, basin_end::edge, basin_end::edge};
    for (std::uint64_t i = along[start] >= x ? start : start + 1; i < along.size(); ++i) {
        if (class_at(i) == own) continue;
        result.right = along[i] - x;
        result.right_end = end_at(i);
        break;
    }
    for (std::uint64_t i = along[start] <= x ? start + 1 : start; i-- > 0;) {
        if (class_at(i) == own) continue;
        result.left = x - along[i];
        result.left_end = end_at(i);
        break;
    }
    return result;
}

/// Which of the attractor's columns each axis is; none where an axis is no such column.
std::optional<std::vector<std::size_t>> columns_of_axes(const class_grid& grid,
                                                        const attractor_points& points) {
    std::vector<std::size_t> columns;
    for (const axis& each : grid.axes) {
        const auto found = std::find(points.columns.begin(), points.columns.end(), each.name);
        if (found == points.columns.end()) return std::nullopt;
        columns.push_back(static_cast<std::size_t>(found - points.columns.begin()));
    }
    return columns;
}

bool lies_in_plane(const class_grid& grid, const attractor_points& points, const double* state) {
    for (std::size_t i = 0; i < points.columns.size(); ++i) {
        const bool is_axis = std::any_of(grid.axes.begin(), grid.axes.end(), [&](const axis& each) {
            return each.name == points.columns[i];
        });
        if (is_axis) continue;
        const auto plane = points.plane.find(points.columns[i]);
        if (plane == points.plane.end()) return false;
        if (!(std::abs(state[i] - plane->second) <= 1e-6 * std::abs(plane->second))) return false;
    }
    return true;
}

bool lies_in_range(const class_grid& grid, const std::vector<double>& point) {
    for (std::size_t i = 0; i < grid.rank(); ++i) {
        const std::vector<double>& values = grid.axes[i].values;
        if (!(point[i] >= values.front() && point[i] <= values.back())) return false;
    }
    return true;
}

critical_shock shock_of(const class_grid& grid, const attractor_points& points,
                        const std::vector<std::size_t>& columns, const attractor_row& row) {
    critical_shock shock;
    shock.label = row.label;
    shock.name = row.name;
    const std::size_t n_columns = points.columns.size();
    shock.n_points = n_columns == 0 ? 0 : row.points.size() / n_columns;
    if (shock.n_points == 0) {
        shock.why = "the attractor table gives no point";
        return shock;
    }
    const auto found =
        std::find_if(grid.classes.begin(), grid.classes.end(),
                     [&](const auto& each) { return !each.is_outcome && each.value == row.label; });
    if (found == grid.classes.end()) {
        shock.why = "no cell has this label";
        return shock;
    }
    const auto own = static_cast<class_index>(found - grid.classes.begin());
    for (std::size_t i = 0; i < shock.n_points; ++i) {
        const double* state = &row.points[i * n_columns];
        std::vector<double> point;
        for (const std::size_t column : columns) point.push_back(state[column]);
        if (!lies_in_plane(grid, points, state) || !lies_in_range(grid, point)) continue;
        ++shock.n_in_map;
        const nearest_other near = nearest_to(grid, length_unit::axis_units, point, own);
        if (shock.n_in_map > 1 && !(near.distance < shock.in_axis_units.distance)) continue;
        shock.point = point;
        shock.in_axis_units = near;
    }
    if (shock.n_in_map == 0) {
        shock.why = "no point of the attractor lies in the map";
        return shock;
    }
    shock.is_defined = true;
    shock.is_in_own_basin = grid.cells[cell_of(grid, shock.point)] == own;
    shock.in_cells = nearest_to(grid, length_unit::cells, shock.point, own);
    for (std::size_t i = 0; i < grid.rank(); ++i) {
        shock.extents.push_back(extent_along(grid, shock.point, i, own));
    }
    return shock;
}

}  // namespace

std::vector<critical_shock> critical_shocks(const class_grid& grid,
                                            const attractor_points& points) {
    const auto columns = columns_of_axes(grid, points);
    std::vector<critical_shock> shocks(points.attractors.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < shocks.size(); ++i) {
        const attractor_row& row = points.attractors[i];
        if (columns) {
            shocks[i] = shock_of(grid, points, *columns, row);
        } else {
            shocks[i].label = row.label;
            shocks[i].name = row.name;
            shocks[i].why = "an axis is no state column of the attractors' points";
        }
    }
    return shocks;
}

}  // namespace hopscotch::metrics
