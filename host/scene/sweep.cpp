// Points of a sweep.
#include "host/scene/sweep.hpp"

#include "host/scene/readers.hpp"

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// An axis of a sweep as a map's axis is described.
axis described(const scene& scene, const sweep_axis& from) {
    axis result{from.name, "", "", from.scale == axis_scale::log ? "log" : "linear", from.values};
    const auto index = static_cast<std::size_t>(from.index);
    if (from.kind == axis_kind::column) {
        result.unit = scene.start_section().columns[index].unit;
        result.long_name = scene.start_section().columns[index].meaning;
    } else {
        result.unit = scene.info().parameters[index].unit;
        result.long_name = scene.info().parameters[index].meaning;
    }
    return result;
}

}  // namespace

std::uint64_t scene_sweep::n_points() const {
    if (axes.empty()) return 1;
    if (is_zip) return axes[0].values.size();
    std::uint64_t points = 1;
    for (const sweep_axis& axis : axes) points *= axis.values.size();
    return points;
}

bool is_sweep(const scene& scene) { return !scene.sweep.axes.empty() && scene.sweep.point.empty(); }

std::vector<std::uint64_t> sweep_shape(const scene_sweep& sweep) {
    if (sweep.is_zip) return {sweep.n_points()};
    std::vector<std::uint64_t> shape;
    for (const sweep_axis& axis : sweep.axes) shape.push_back(axis.values.size());
    return shape;
}

std::vector<std::uint64_t> sweep_coordinates(const scene_sweep& sweep, std::uint64_t point) {
    const std::vector<std::uint64_t> shape = sweep_shape(sweep);
    std::vector<std::uint64_t> coordinates(shape.size());
    for (std::size_t i = shape.size(); i-- > 0; point /= shape[i])
        coordinates[i] = point % shape[i];
    return coordinates;
}

std::vector<double> sweep_values(const scene_sweep& sweep,
                                 std::span<const std::uint64_t> coordinates) {
    std::vector<double> values;
    for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
        values.push_back(sweep.axes[i].values[coordinates[sweep.is_zip ? 0 : i]]);
    }
    return values;
}

scene map_scene(const scene& sweep, std::uint64_t point) {
    scene map = sweep;
    map.sweep.point = sweep_coordinates(sweep.sweep, point);
    set_sweep_values(map, sweep_values(map.sweep, map.sweep.point));
    map.overrides.push_back(fmt::format("sweep.point=[{}]", fmt::join(map.sweep.point, ", ")));
    map.fingerprint = fingerprint_of(map);
    return map;
}

std::vector<axis> sweep_dimensions(const scene& scene) {
    if (scene.sweep.is_zip) {
        axis points{"point", "1", "points of the sweep", "linear", {}};
        for (std::uint64_t i = 0; i < scene.sweep.n_points(); ++i) {
            points.values.push_back(static_cast<double>(i));
        }
        return {points};
    }
    std::vector<axis> axes;
    for (const sweep_axis& axis : scene.sweep.axes) axes.push_back(described(scene, axis));
    return axes;
}

std::vector<axis> sweep_followers(const scene& scene) {
    std::vector<axis> axes;
    if (!scene.sweep.is_zip) return axes;
    for (const sweep_axis& axis : scene.sweep.axes) axes.push_back(described(scene, axis));
    return axes;
}

}  // namespace hopscotch
