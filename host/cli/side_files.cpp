#include "host/cli/side_files.hpp"

#include "analysis/metrics/read_classes.hpp"
#include "host/cli/map_plan.hpp"
#include "host/cli/text_output.hpp"
#include "host/map/numbers.hpp"
#include "host/run/attributes.hpp"
#include "host/scene/grid.hpp"
#include "host/store/map_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The columns in which a side's direction is not 0; of all sides of an orbit.
std::set<std::size_t> columns_of(const sided_orbit& orbit) {
    std::set<std::size_t> columns;
    for (const orbit_side& side : orbit.sides) {
        for (std::size_t c = 0; c < side.direction.size(); ++c) {
            if (side.direction[c] != 0.0) columns.insert(c);
        }
    }
    return columns;
}

/// What tells the sides of an orbit apart: -1 and 1, the angle of a direction, or its number.
axis side_axis(const sided_orbit& orbit, const scene& scene) {
    const std::set<std::size_t> columns = columns_of(orbit);
    const auto name_of = [&](std::size_t c) {
        return std::string(scene.end_section().columns[c].name);
    };
    axis result{"direction", "1", "", "linear", {}};
    if (columns.size() == 1) {
        result.name = "side";
        result.long_name =
            fmt::format("-1: {} below the orbit's, 1: above", name_of(*columns.begin()));
        result.values = {-1.0, 1.0};
        return result;
    }
    if (columns.size() == 2) {
        result.unit = "degree";
        result.long_name = fmt::format("direction from {} towards {}, in the columns' scales",
                                       name_of(*columns.begin()), name_of(*columns.rbegin()));
    } else {
        result.long_name = "below and above the orbit's";
        for (const std::size_t c : columns) result.long_name += " " + name_of(c) + ",";
        result.long_name.back() = '.';
    }
    const double step = columns.size() == 2 ? 360.0 / static_cast<double>(orbit.sides.size()) : 1.0;
    for (std::size_t k = 0; k < orbit.sides.size(); ++k) {
        result.values.push_back(step * static_cast<double>(k));
    }
    return result;
}

/// State columns that are no axis of the table.
std::vector<std::size_t> told_columns(const side_table& table, const scene& scene) {
    std::vector<std::size_t> columns;
    for (std::size_t c = 0; c < scene.end_section().columns.size(); ++c) {
        const bool is_axis = std::any_of(table.axes.begin(), table.axes.end(), [&](std::size_t i) {
            return scene.axes[i].name == scene.end_section().columns[c].name;
        });
        if (!is_axis) columns.push_back(c);
    }
    return columns;
}

/// A layer with the number it has for one side of one orbit.
struct side_layer {
    layer description;
    std::function<double(const sided_orbit&, const orbit_side&)> value;
};

std::vector<side_layer> layers_of(const side_table& table, const scene& scene) {
    const std::set<std::size_t> columns = columns_of(table.orbits.front());
    const bool line = columns.size() == 1;
    const std::string unit =
        line ? std::string(scene.end_section().columns[*columns.begin()].unit) : "1";
    const auto number = number_type::float64;
    std::vector<side_layer> layers;
    layers.push_back(
        {{"kind", number_type::int8, "1", "what the orbit does to starts there", -1.0, {}},
         [](const auto&, const orbit_side& side) {
             return static_cast<double>(static_cast<int>(side.kind));
         }});
    for (std::size_t k = 0; k < side_kind_names.size(); ++k) {
        layers.back().description.flags.emplace_back(static_cast<int>(k),
                                                     std::string(side_kind_names[k]));
    }
    const auto add = [&](std::string name, std::string in, std::string meaning, auto value) {
        layers.push_back(
            {{std::move(name), number, std::move(in), std::move(meaning), nan, {}},
             [value](const sided_orbit&, const orbit_side& side) { return side.*value; }});
    };
    add("extent", unit,
        line ? "length of the immediate one-sided basin"
             : "length of the immediate basin in the columns' scales",
        &orbit_side::extent);
    add("law_exponent", "1", "e in |P^p(x) - x| ~ c d^e at distance d", &orbit_side::exponent);
    add("law_coefficient", "1", "c in |P^p(x) - x| ~ c d^e at distance d",
        &orbit_side::coefficient);
    add("basin_share", "1", "share of the starts that lie on this side and tend to the orbit",
        &orbit_side::share);
    add("basin_share_error", "1", "standard error of basin_share", &orbit_side::share_error);
    layers.push_back(
        {{"is_bounded",
          number_type::int8,
          "1",
          "1: the immediate basin ends there; 0: no end was found",
          -1.0,
          {}},
         [](const auto&, const orbit_side& side) { return side.is_bounded ? 1.0 : 0.0; }});
    for (const std::size_t c : told_columns(table, scene)) {
        const column_info& column = scene.end_section().columns[c];
        layers.push_back({{std::string(column.name),
                           number,
                           std::string(column.unit),
                           fmt::format("{} of the orbit's point", column.name),
                           nan,
                           {}},
                          [c](const sided_orbit& orbit, const auto&) { return orbit.state[c]; }});
        if (line) continue;
        layers.push_back({{fmt::format("scale_{}", column.name),
                           number,
                           std::string(column.unit),
                           fmt::format("unit of distances in {}", column.name),
                           nan,
                           {}},
                          [c](const sided_orbit& orbit, const auto&) { return orbit.scale[c]; }});
    }
    return layers;
}

/// Indices of a parameter point along the table's axes.
std::vector<std::uint64_t> indices_of(const side_table& table, const scene& scene,
                                      std::size_t point) {
    std::vector<std::uint64_t> indices(table.axes.size());
    for (std::size_t i = table.axes.size(); i-- > 0;) {
        const std::uint64_t n = scene.axes[table.axes[i]].cells;
        indices[i] = point % n;
        point /= n;
    }
    return indices;
}

std::vector<int> labels_of(const side_table& table) {
    std::set<int> labels;
    for (const sided_orbit& orbit : table.orbits) labels.insert(orbit.label);
    return {labels.begin(), labels.end()};
}

/// The whole map: one row of numbers per parameter point, orbit by orbit, side by side.
tile_data numbers_of(const side_table& table, const scene& scene, const map_layout& layout) {
    const std::vector<side_layer> layers = layers_of(table, scene);
    const std::vector<int> labels = labels_of(table);
    const std::size_t n_sides = table.orbits.front().sides.size();
    tile_data tile{box_of(layout, 0), {}};
    const std::uint64_t n = tile.box.n_cells();
    for (const side_layer& each : layers) {
        auto& buffer = tile.layers.emplace_back(n * bytes_of(each.description.type));
        fill_numbers(each.description.type, buffer.data(), 0, n, each.description.fill);
    }
    for (const sided_orbit& orbit : table.orbits) {
        const auto place = static_cast<std::size_t>(
            std::lower_bound(labels.begin(), labels.end(), orbit.label) - labels.begin());
        const std::size_t first = (orbit.point * labels.size() + place) * n_sides;
        for (std::size_t k = 0; k < orbit.sides.size() && k < n_sides; ++k) {
            for (std::size_t i = 0; i < layers.size(); ++i) {
                fill_numbers(layers[i].description.type, tile.layers[i].data(), first + k, 1,
                             layers[i].value(orbit, orbit.sides[k]));
            }
        }
    }
    return tile;
}

std::filesystem::path beside(const std::filesystem::path& map, const std::string& ending) {
    return map.parent_path() / (map.stem().string() + ending);
}

/// Those of the map, but not the scene as one that this file could be computed from.
attribute_list attributes_for(const map_reader& map) {
    attribute_list kept;
    for (const auto& [name, value] : map.attributes()) {
        for (const char* wanted : {"title", "references", "source", "name", "model", "section",
                                   "question", "version", "revision"}) {
            if (name == wanted) kept.emplace_back(name, value);
        }
    }
    kept.emplace_back("of_map", map.attribute("hash"));
    return kept;
}

void write_map(const side_table& table, const scene& scene, const map_reader& map,
               const std::filesystem::path& file) {
    const map_layout layout = side_layout(table, scene);
    map_run run(layout, {.map = file,
                         .fingerprint = scene.fingerprint,
                         .attributes = attributes_for(map),
                         .existing = if_exists::replace});
    run.put(compress(layout, numbers_of(table, scene, layout), scene.output.compression));
    run.finish({});
}

}  // namespace

map_layout side_layout(const side_table& table, const scene& scene) {
    const map_layout whole = layout_of(scene);
    map_layout layout;
    for (const std::size_t i : table.axes) layout.axes.push_back(whole.axes[i]);
    axis orbits{"orbit", "1", "label of the attractor", "linear", {}};
    for (const int label : labels_of(table)) orbits.values.push_back(label);
    layout.axes.push_back(std::move(orbits));
    layout.axes.push_back(side_axis(table.orbits.front(), scene));
    for (side_layer& each : layers_of(table, scene)) {
        layout.layers.push_back(std::move(each.description));
    }
    for (const axis& each : layout.axes) layout.tile.push_back(each.size());
    return layout;
}

std::string side_csv(const side_table& table, const scene& scene) {
    if (table.orbits.empty()) return "";
    const std::vector<side_layer> layers = layers_of(table, scene);
    const axis sides = side_axis(table.orbits.front(), scene);
    std::string text;
    for (const std::size_t i : table.axes) text += scene.axes[i].name + ",";
    text += "label,name,period," + sides.name;
    for (const side_layer& each : layers) text += "," + each.description.name;
    text += "\n";
    for (const sided_orbit& orbit : table.orbits) {
        std::string start;
        const std::vector<std::uint64_t> at = indices_of(table, scene, orbit.point);
        for (std::size_t i = 0; i < at.size(); ++i) {
            start += fmt::format("{:.17g},", value_of(scene.axes[table.axes[i]], at[i]));
        }
        start += fmt::format("{},{},{},", orbit.label, orbit.name, orbit.period);
        for (std::size_t k = 0; k < orbit.sides.size(); ++k) {
            text += start + fmt::format("{:.17g}", sides.values[k]);
            for (const side_layer& each : layers) {
                const double value = each.value(orbit, orbit.sides[k]);
                const auto& flags = each.description.flags;
                if (!flags.empty()) {
                    text += "," + flags[static_cast<std::size_t>(value)].second;
                } else {
                    text += std::isnan(value) ? "," : fmt::format(",{:.17g}", value);
                }
            }
            text += "\n";
        }
    }
    return text;
}

std::string write_sides(const std::filesystem::path& file) {
    const map_reader map(file);
    const scene scene = scene_of(map);
    const label_plan plan = told_plan(scene, map);
    side_table table = sides_of(scene, plan);
    if (table.orbits.empty()) return "";
    add_shares(table, scene, metrics::read_classes(map));
    const std::filesystem::path csv = beside(file, "_sides.csv");
    const std::filesystem::path sides = beside(file, "_sides.h5");
    put_text(csv.string(), side_csv(table, scene));
    write_map(table, scene, map, sides);
    return fmt::format("one-sided        {}\n                 {}\n", csv.string(), sides.string());
}

}  // namespace hopscotch
