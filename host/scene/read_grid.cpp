// [grid], [[grid.axis]], [start]: which starts and parameters the cells stand for.
#include "host/scene/readers.hpp"

#include "host/scene/grid.hpp"
#include "host/scene/range_text.hpp"
#include "host/scene/suggest.hpp"
#include "host/scene/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr std::int64_t most_cells_along = std::int64_t{1} << 28;
constexpr double most_cells = 1e15;
constexpr std::size_t most_axes = 8;
constexpr std::int64_t most_refine = 8;  // blocks of 256 cells along a side

void read_section(scene& scene, const table_reader& table) {
    const auto name = table.text("section");
    if (!name) return;  // the model's first section
    scene.section = index_of(scene.info().sections, *name);
    if (scene.section < 0) {
        table.refuse("section", fmt::format("no section of {}", scene.info().name),
                     suggest(*name, names_of(scene.info().sections)));
    }
}

/// A name stands for a state column of the section, else for a parameter.
void read_axis_name(const scene& scene, const table_reader& table, scene_axis& axis) {
    std::vector<std::string_view> known = names_of(scene.start_section().columns);
    for (const parameter_info& parameter : scene.info().parameters) known.push_back(parameter.name);
    const auto name = table.text("name");
    if (!name) {
        table.missing("name", "an axis names a state column or a parameter",
                      "one of " + listed(known));
    }
    axis.name = *name;
    axis.index = index_of(scene.start_section().columns, *name);
    if (axis.index >= 0) return;
    axis.kind = axis_kind::parameter;
    axis.index = index_of(scene.info().parameters, *name);
    if (axis.index < 0) {
        table.refuse("name",
                     fmt::format("no state column of section {} and no parameter of {}",
                                 scene.start_section().name, scene.info().name),
                     suggest(*name, known));
    }
    if (scene.is_given[static_cast<std::size_t>(axis.index)]) {
        table.refuse("name", "set in model.parameters as well",
                     "remove it there or remove the axis");
    }
}

double read_end(const table_reader& table, std::string_view key) {
    const auto value = table.number(key);
    if (!value) table.missing(key, "an axis needs both ends");
    if (!std::isfinite(*value)) table.refuse(key, "the ends of an axis are finite");
    return *value;
}

void read_extent(const table_reader& table, scene_axis& axis, bool edges) {
    if (!table.has("cells")) table.missing("cells", "how many cells the axis has", "cells = 512");
    if (table.number("cells") == 0.0) {
        table.refuse("cells", "an axis needs at least one cell",
                     "remove the axis to fix its value");
    }
    axis.cells = static_cast<std::uint64_t>(*table.whole("cells", 1, most_cells_along));
    axis.lowest = read_end(table, "min");
    axis.highest = read_end(table, "max");
    if (!(axis.lowest < axis.highest)) {
        table.refuse("max", fmt::format("not above min = {}", axis.lowest),
                     axis.lowest > axis.highest ? "exchange min and max"
                                                : "remove the axis to fix its value");
    }
    axis.edges = table.flag("edges").value_or(edges);
    if (axis.edges && axis.cells < 2) {
        table.refuse("cells", "an axis sampled at its edges needs two cells", "edges = false");
    }
}

void read_scale(const table_reader& table, scene_axis& axis) {
    constexpr std::array<std::string_view, 2> scales{"linear", "log"};
    const std::string scale = table.text("scale").value_or("linear");
    if (scale == "log")
        axis.scale = axis_scale::log;
    else if (scale != "linear")
        table.refuse("scale", "no such scale", suggest(scale, scales));
    if (axis.scale == axis_scale::log && axis.lowest <= 0.0) {
        table.refuse("min", "a logarithmic axis begins above zero", "scale = \"linear\"");
    }
}

/// Every sampled parameter must be legal. Starts may lie outside the section's domain (the map says
/// `invalid_start` there), unless all of them do.
void check_range(const scene& scene, const table_reader& table, const scene_axis& axis) {
    const auto index = static_cast<std::size_t>(axis.index);
    const double first = value_of(axis, 0);
    const double last = value_of(axis, axis.cells - 1);
    if (axis.kind == axis_kind::parameter) {
        const range& valid = scene.info().parameters[index].valid;
        if (!valid.holds(first)) {
            table.refuse("min", fmt::format("{} outside {}", axis.name, written(valid)));
        }
        if (!valid.holds(last)) {
            table.refuse("max", fmt::format("{} outside {}", axis.name, written(valid)));
        }
        return;
    }
    const range& valid = scene.start_section().columns[index].valid;
    if (last < valid.lowest || first > valid.highest) {
        table.refuse("max", fmt::format("every {} lies outside {}", axis.name, written(valid)));
    }
}

void check_resolution(const table_reader& table, const scene_axis& axis) {
    // neighbours are closest at the end of largest magnitude of a linear axis, at the low end of a
    // log one
    for (const std::uint64_t cell : {std::uint64_t{1}, axis.cells - 1}) {
        if (axis.cells < 2 || value_of(axis, cell - 1) < value_of(axis, cell)) continue;
        table.refuse("cells", "more cells than distinct numbers between min and max",
                     "fewer cells");
    }
}

scene_axis read_axis(const scene& scene, const table_reader& table, bool edges) {
    table.expect_keys({"name", "min", "max", "cells", "scale", "edges"});
    scene_axis axis;
    read_axis_name(scene, table, axis);
    for (const scene_axis& other : scene.axes) {
        if (other.name == axis.name) table.refuse("name", "an axis of that name is there already");
    }
    read_extent(table, axis, edges);
    read_scale(table, axis);
    check_range(scene, table, axis);
    check_resolution(table, axis);
    return axis;
}

}  // namespace

void read_grid(scene& scene, const table_reader& root) {
    const table_reader table = root.table("grid");
    table.expect_keys({"section", "axis", "edges", "refine"});
    read_section(scene, table);
    const bool edges = table.flag("edges").value_or(false);
    const std::vector<table_reader> axes = table.tables("axis");
    if (axes.empty()) table.missing("axis", "a grid needs at least one axis", "[[grid.axis]]");
    double cells = 1.0;
    for (const table_reader& axis : axes) {
        if (scene.axes.size() == most_axes) axis.refuse("name", "at most eight axes");
        scene.axes.push_back(read_axis(scene, axis, edges));
        cells *= static_cast<double>(scene.axes.back().cells);
        if (cells > most_cells) axis.refuse("cells", "more than 1e15 cells in all", "fewer cells");
    }
    scene.refine = static_cast<int>(table.whole("refine", 0, most_refine).value_or(0));
}

void read_start(scene& scene, const table_reader& root) {
    const table_reader table = root.table("start");
    const auto columns = scene.start_section().columns;
    scene.start.assign(columns.size(), std::numeric_limits<double>::quiet_NaN());
    std::vector<bool> is_axis(columns.size(), false);
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind == axis_kind::column) is_axis[static_cast<std::size_t>(axis.index)] = true;
    }
    std::vector<double> swept(columns.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<std::uint64_t> first(scene.sweep.axes.size(), 0);
    const std::vector<double> values =
        sweep_values(scene.sweep, scene.sweep.point.empty() ? first : scene.sweep.point);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const sweep_axis& axis = scene.sweep.axes[i];
        if (axis.kind == axis_kind::column) swept[static_cast<std::size_t>(axis.index)] = values[i];
    }
    table.expect_keys(names_of(columns),
                      fmt::format("state column of section {}", scene.start_section().name));
    for (std::size_t index = 0; index < columns.size(); ++index) {
        const std::string_view name = columns[index].name;
        const auto value = table.number(name);
        if (value && is_axis[index]) table.refuse(name, "an axis as well", "remove one of them");
        if (is_axis[index]) continue;
        if (!std::isnan(swept[index])) {
            if (value) table.refuse(name, "an axis of the sweep as well", "remove one of them");
            scene.start[index] = swept[index];
            continue;
        }
        if (!value) {
            table.missing(name,
                          fmt::format("state column of section {}, neither axis nor start",
                                      scene.start_section().name),
                          fmt::format("[start] {} = 0.0", name));
        }
        if (!columns[index].valid.holds(*value)) {
            table.refuse(name, "outside " + written(columns[index].valid));
        }
        scene.start[index] = *value;
    }
}

}  // namespace hopscotch
