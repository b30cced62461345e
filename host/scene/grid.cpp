// Sample values, cell coordinates and the layout of a scene's map.
#include "host/scene/grid.hpp"

#include "host/scene/diagram_grid.hpp"
#include "host/scene/layers.hpp"

#include <cmath>

namespace hopscotch {

double value_of(const scene_axis& axis, std::uint64_t cell) {
    const auto n = static_cast<long double>(axis.cells);
    const auto i = static_cast<long double>(cell);
    if (axis.edges && cell == 0) return axis.lowest;
    if (axis.edges && cell + 1 == axis.cells) return axis.highest;
    const long double numerator = axis.edges ? i : 2.0L * i + 1.0L;
    const long double denominator = axis.edges ? n - 1.0L : 2.0L * n;
    const long double low = axis.lowest;
    const long double high = axis.highest;
    if (axis.scale == axis_scale::linear) {
        // both terms rather than low + width * t: exact in the middle and free of overflow
        return static_cast<double>((low * (denominator - numerator) + high * numerator) /
                                   denominator);
    }
    const long double t = numerator / denominator;
    return static_cast<double>(std::exp(std::log(low) * (1.0L - t) + std::log(high) * t));
}

std::vector<double> values_of(const scene_axis& axis) {
    std::vector<double> values(axis.cells);
    for (std::uint64_t cell = 0; cell < axis.cells; ++cell) values[cell] = value_of(axis, cell);
    return values;
}

namespace {

axis described(const scene& scene, const scene_axis& from) {
    axis result;
    result.name = from.name;
    result.scale = from.scale == axis_scale::log ? "log" : "linear";
    result.values = values_of(from);
    const auto index = static_cast<std::size_t>(from.index);
    if (from.kind == axis_kind::column) {
        const column_info& column = scene.start_section().columns[index];
        result.unit = column.unit;
        result.long_name = column.meaning;
    } else {
        const parameter_info& parameter = scene.info().parameters[index];
        result.unit = parameter.unit;
        result.long_name = parameter.meaning;
    }
    return result;
}

}  // namespace

map_layout layout_of(const scene& scene) {
    map_layout layout;
    for (const scene_axis& axis : scene.axes) layout.axes.push_back(described(scene, axis));
    for (const layer_plan& layer : chosen_layers(scene)) layout.layers.push_back(layer.description);
    layout.tile = scene.output.tile;
    if (is_orbit_diagram(scene)) {
        layout.axes = diagram_axes(scene, std::move(layout.axes[0]));
        layout.tile = diagram_tile(scene);
    }
    return layout;
}

std::vector<std::uint64_t> coordinates_of(const scene& scene, std::uint64_t cell) {
    std::vector<std::uint64_t> coordinates(scene.axes.size());
    for (std::size_t axis = scene.axes.size(); axis-- > 0;) {
        coordinates[axis] = cell % scene.axes[axis].cells;
        cell /= scene.axes[axis].cells;
    }
    return coordinates;
}

cell_start start_of(const scene& scene, std::span<const std::uint64_t> coordinates) {
    cell_start start{scene.start, scene.parameters};
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
        const scene_axis& from = scene.axes[axis];
        auto& target = from.kind == axis_kind::column ? start.columns : start.parameters;
        target[static_cast<std::size_t>(from.index)] = value_of(from, coordinates[axis]);
    }
    return start;
}

parameter_extremes extremes_of(const scene& scene) {
    parameter_extremes extremes{scene.parameters, scene.parameters};
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind != axis_kind::parameter) continue;
        const auto index = static_cast<std::size_t>(axis.index);
        extremes.lowest[index] = value_of(axis, 0);
        extremes.highest[index] = value_of(axis, axis.cells - 1);
    }
    return extremes;
}

}  // namespace hopscotch
