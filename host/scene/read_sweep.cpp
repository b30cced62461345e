// [sweep], [[sweep.axis]]: the values at which the map is computed over and over.
#include "host/scene/readers.hpp"

#include "host/scene/grid.hpp"
#include "host/scene/range_text.hpp"
#include "host/scene/suggest.hpp"
#include "host/scene/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr std::int64_t most_points = 1'000'000;  // of one sweep: a file each
constexpr std::size_t most_axes = 4;

/// A name stands for a parameter, else for a state column that is no axis of the grid.
void read_name(const scene& scene, const table_reader& table, sweep_axis& axis) {
    std::vector<std::string_view> known = names_of(scene.info().parameters);
    for (const column_info& column : scene.start_section().columns) known.push_back(column.name);
    const auto name = table.text("name");
    if (!name) {
        table.missing("name", "a sweep's axis names a parameter or a state column",
                      "one of " + listed(known));
    }
    axis.name = *name;
    axis.index = index_of(scene.info().parameters, *name);
    if (axis.index < 0) {
        axis.kind = axis_kind::column;
        axis.index = index_of(scene.start_section().columns, *name);
    }
    if (axis.index < 0) {
        table.refuse("name",
                     fmt::format("no parameter of {} and no state column of section {}",
                                 scene.info().name, scene.start_section().name),
                     suggest(*name, known));
    }
    for (const scene_axis& other : scene.axes) {
        if (other.name == axis.name) {
            table.refuse("name", "an axis of the grid as well", "remove one of them");
        }
    }
    for (const sweep_axis& other : scene.sweep.axes) {
        if (other.name == axis.name) table.refuse("name", "an axis of that name is there already");
    }
    const bool is_parameter = axis.kind == axis_kind::parameter;
    if (is_parameter && scene.is_given[static_cast<std::size_t>(axis.index)]) {
        table.refuse("name", "set in model.parameters as well",
                     "remove it there or remove the axis");
    }
}

void read_scale(const table_reader& table, sweep_axis& axis) {
    constexpr std::array<std::string_view, 2> scales{"linear", "log"};
    const std::string scale = table.text("scale").value_or("linear");
    if (std::find(scales.begin(), scales.end(), scale) == scales.end()) {
        table.refuse("scale", "no such scale", suggest(scale, scales));
    }
    if (scale == "log") axis.scale = axis_scale::log;
}

/// From `min` to `max`, both included.
void read_range(const table_reader& table, sweep_axis& axis) {
    scene_axis range{axis.name, axis.kind, axis.index, 0.0, 1.0, 0, axis.scale, true};
    const auto end = [&](std::string_view key) {
        const auto value = table.number(key);
        if (!value) table.missing(key, "a sweep's axis has `values`, or `min`, `max` and `points`");
        if (!std::isfinite(*value)) table.refuse(key, "the ends of an axis are finite");
        return *value;
    };
    range.lowest = end("min");
    range.highest = end("max");
    if (!(range.lowest < range.highest)) {
        table.refuse("max", fmt::format("not above min = {}", range.lowest), "values = [...]");
    }
    if (axis.scale == axis_scale::log && range.lowest <= 0.0) {
        table.refuse("min", "a logarithmic axis begins above zero", "scale = \"linear\"");
    }
    const auto points = table.whole("points", 2, most_points);
    if (!points) table.missing("points", "how many points the axis has", "points = 10");
    range.cells = static_cast<std::uint64_t>(*points);
    axis.values = values_of(range);
}

void read_values(const table_reader& table, sweep_axis& axis) {
    for (const char* key : {"min", "max", "points"}) {
        if (table.has(key)) table.refuse(key, "`values` are given as well", "remove one of them");
    }
    axis.values = *table.numbers("values");
    if (axis.values.empty()) table.refuse("values", "an axis needs at least one value");
    if (axis.scale == axis_scale::log &&
        *std::min_element(axis.values.begin(), axis.values.end()) <= 0.0) {
        table.refuse("values", "a logarithmic axis lies above zero", "scale = \"linear\"");
    }
}

const range& valid_range(const scene& scene, const sweep_axis& axis) {
    const auto index = static_cast<std::size_t>(axis.index);
    return axis.kind == axis_kind::parameter ? scene.info().parameters[index].valid
                                             : scene.start_section().columns[index].valid;
}

sweep_axis read_axis(const scene& scene, const table_reader& table) {
    table.expect_keys({"name", "values", "min", "max", "points", "scale"});
    sweep_axis axis;
    read_name(scene, table, axis);
    read_scale(table, axis);
    const bool is_list = table.has("values");
    if (is_list) {
        read_values(table, axis);
    } else {
        read_range(table, axis);
    }
    const range& valid = valid_range(scene, axis);
    for (const double value : axis.values) {
        if (valid.holds(value)) continue;
        table.refuse(is_list                        ? "values"
                     : value == axis.values.front() ? "min"
                                                    : "max",
                     fmt::format("{} = {} outside {}", axis.name, value, written(valid)));
    }
    return axis;
}

/// Product: every value once per axis. Zip: as many on every axis.
void check_together(const scene& scene, const std::vector<table_reader>& tables) {
    const std::vector<sweep_axis>& axes = scene.sweep.axes;
    double points = 1.0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::string_view key = tables[i].has("values") ? "values" : "points";
        const std::size_t n = axes[i].values.size();
        if (scene.sweep.is_zip && n != axes[0].values.size()) {
            tables[i].refuse(
                key,
                fmt::format("{} values, but {} has {}", n, axes[0].name, axes[0].values.size()),
                "combine = \"product\"");
        }
        const std::set<double> distinct(axes[i].values.begin(), axes[i].values.end());
        if (!scene.sweep.is_zip && distinct.size() < n) {
            tables[i].refuse(key, "a value stands there twice");
        }
        points *= scene.sweep.is_zip && i > 0 ? 1.0 : static_cast<double>(n);
        if (points > static_cast<double>(most_points)) {
            tables[i].refuse(key, "more than 1e6 maps in all", "fewer points");
        }
    }
}

/// Asks the model whether it accepts the parameters of every map.
void check_points(const scene& scene, const std::vector<table_reader>& tables) {
    struct scene map = scene;
    for (std::uint64_t point = 0; point < scene.sweep.n_points(); ++point) {
        const std::vector<double> values =
            sweep_values(scene.sweep, sweep_coordinates(scene.sweep, point));
        set_sweep_values(map, values);
        const std::string_view why = refusal_of(map);
        if (why.empty()) continue;
        tables[0].refuse(
            "name",
            fmt::format("{} at {} = {}", why, scene.sweep.axes[0].name, fmt::join(values, ", ")),
            "other values");
    }
}

/// One map of the sweep, if the scene is to be that one.
void read_point(scene& scene, const table_reader& table) {
    const auto point = table.wholes("point", 0);
    if (!point) return;
    const std::vector<std::uint64_t> shape = sweep_shape(scene.sweep);
    bool is_inside = point->size() == shape.size();
    for (std::size_t i = 0; is_inside && i < shape.size(); ++i) {
        is_inside = static_cast<std::uint64_t>((*point)[i]) < shape[i];
    }
    if (!is_inside) {
        table.refuse("point", fmt::format("the sweep has {} points", fmt::join(shape, " x ")),
                     "indices that count from 0");
    }
    scene.sweep.point.assign(point->begin(), point->end());
    set_sweep_values(scene, sweep_values(scene.sweep, scene.sweep.point));
}

}  // namespace

void set_sweep_values(scene& scene, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const sweep_axis& axis = scene.sweep.axes[i];
        const auto index = static_cast<std::size_t>(axis.index);
        if (axis.kind == axis_kind::parameter) {
            scene.parameters[index] = values[i];
            scene.is_given[index] = true;
        } else if (index < scene.start.size()) {
            scene.start[index] = values[i];
        }
    }
}

void read_sweep(scene& scene, const table_reader& root) {
    const table_reader table = root.table("sweep");
    table.expect_keys({"combine", "axis", "point"});
    const std::vector<table_reader> axes = table.tables("axis");
    if (axes.empty()) {
        for (const char* key : {"combine", "point"}) {
            if (table.has(key)) table.refuse(key, "the sweep has no axis", "[[sweep.axis]]");
        }
        return;
    }
    constexpr std::array<std::string_view, 2> ways{"product", "zip"};
    const std::string combine = table.text("combine").value_or("product");
    if (std::find(ways.begin(), ways.end(), combine) == ways.end()) {
        table.refuse("combine", "no such way to combine axes", suggest(combine, ways));
    }
    scene.sweep.is_zip = combine == "zip";
    for (const table_reader& axis : axes) {
        if (scene.sweep.axes.size() == most_axes) axis.refuse("name", "at most four axes");
        scene.sweep.axes.push_back(read_axis(scene, axis));
    }
    check_together(scene, axes);
    check_points(scene, axes);
    set_sweep_values(scene, sweep_values(scene.sweep, sweep_coordinates(scene.sweep, 0)));
    read_point(scene, table);
}

}  // namespace hopscotch
