#include "analysis/metrics/analysis.hpp"

#include "host/store/store_error.hpp"

#include <algorithm>

namespace hopscotch::metrics {
namespace {

value_box box_of(const class_grid& grid, const analysis_wish& wish) {
    value_box box = value_box::whole(grid);
    for (const auto& [name, range] : wish.reference_box) {
        const auto found = std::find_if(grid.axes.begin(), grid.axes.end(),
                                        [&](const axis& each) { return each.name == name; });
        if (found == grid.axes.end()) {
            std::string known;
            for (const axis& each : grid.axes) known += (known.empty() ? "" : ", ") + each.name;
            throw store_error("reference box: " + name, "the map has no such axis",
                              "one of " + known);
        }
        const auto at = static_cast<std::size_t>(found - grid.axes.begin());
        box.lowest[at] = range.first;
        box.highest[at] = range.second;
    }
    return box;
}

/// Axes of one cell fix a state column as much as the scene's start does.
attractor_points points_of(const map_reader& map, const analysis_wish& wish) {
    attractor_points points{map.attractors(), map.point_columns(), wish.plane};
    for (const axis& each : map.layout().axes) {
        if (each.size() == 1) points.plane[each.name] = each.values.front();
    }
    return points;
}

/// The table's points are those of one slice.
std::vector<critical_shock> shocks_in_slices_only(const map_reader& map) {
    std::vector<critical_shock> shocks;
    for (const attractor_row& row : map.attractors()) {
        critical_shock& shock = shocks.emplace_back();
        shock.label = row.label;
        shock.name = row.name;
        shock.why = "attractors change along an axis: told slice by slice";
    }
    return shocks;
}

}  // namespace

map_analysis analyse_map(const map_reader& map, const analysis_wish& wish) {
    map_analysis result;
    result.layer = layer_of(map, wish.classes);
    result.grid = read_classes(map, wish.classes);
    result.problems = map.problems();
    const class_grid& grid = result.grid;
    const value_box box = box_of(grid, wish);
    result.shares = shares_in(grid, value_box::whole(grid));
    result.stability = wish.reference_box.empty() ? result.shares : shares_in(grid, box);
    result.boundary = count_boundary_cells(grid);
    result.components = components_of(grid);
    result.entropy = entropy_of(grid, wish.box == 0 ? default_box(grid) : wish.box);
    result.uncertainty = uncertainty_of(grid);
    result.box_counts = box_counts_of(grid);
    result.wada = wada_of(grid);
    result.falls_in_axis_units = distances_to_falls(grid, length_unit::axis_units);
    result.falls_in_cells = distances_to_falls(grid, length_unit::cells);
    if (result.layer != "label") return result;
    result.shocks_of_slices = critical_shocks_of_slices(grid, wish.slices);
    result.shocks = result.shocks_of_slices.slices.empty()
                        ? critical_shocks(grid, points_of(map, wish))
                        : shocks_in_slices_only(map);
    return result;
}

}  // namespace hopscotch::metrics
