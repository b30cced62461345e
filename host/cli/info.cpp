// hopscotch info FILE.h5: what a map shows, how it was made, and its attractors.
#include "host/cli/commands.hpp"
#include "host/cli/tables.hpp"
#include "host/run/attributes.hpp"
#include "host/run/summary.hpp"
#include "host/store/map_reader.hpp"
#include "host/store/sweep_index.hpp"

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

using rows = std::vector<std::vector<std::string>>;

std::string axis_text(const map_layout& layout) {
    rows table{{"axis", "unit", "cells", "first", "last", "scale", "meaning"}};
    for (const axis& axis : layout.axes) {
        table.push_back({axis.name, axis.unit, fmt::format("{}", axis.size()),
                         fmt::format("{:.17g}", axis.values.front()),
                         fmt::format("{:.17g}", axis.values.back()), axis.scale, axis.long_name});
    }
    return aligned(table, 0);
}

std::string layer_text(const map_layout& layout) {
    rows table{{"layer", "unit", "bytes", "meaning"}};
    for (const layer& layer : layout.layers) {
        table.push_back({layer.name, layer.unit,
                         bytes_text(layout.n_cells() * bytes_of(layer.type)), layer.long_name});
    }
    return aligned(table, 0);
}

std::string attractor_text(const map_reader& map) {
    if (map.attractors().empty()) return "";
    rows table{{"label", "name", "period", "share", "trap"}};
    for (const attractor_row& row : map.attractors()) {
        table.push_back({fmt::format("{}", row.label), row.name, fmt::format("{}", row.period),
                         fmt::format("{:.17g}", row.share), row.trap});
    }
    return aligned(table, 0);
}

/// Short attributes in full; of longer ones, such as the scene, only the size.
std::string attribute_text(const attribute_list& attributes) {
    rows table;
    for (const auto& [name, value] : attributes) {
        const bool is_short = value.size() < 200 && value.find('\n') == value.npos;
        table.push_back({name, is_short ? value : fmt::format("({} bytes of text)", value.size())});
    }
    return aligned(table, 0);
}

/// An index: its sweep and how many of its maps are there.
int info_of_sweep(const std::string& file) {
    const sweep_contents contents = read_sweep_contents(file);
    const scene scene = scene_of(contents.attributes);
    const auto n_there = std::count_if(contents.hashes.begin(), contents.hashes.end(),
                                       [](const std::string& hash) { return !hash.empty(); });
    fmt::print("{}: an index over {} maps, {} of them there\n\n", file, contents.hashes.size(),
               n_there);
    rows table{{"sweep axis", "values", "first", "last"}};
    for (const sweep_axis& axis : scene.sweep.axes) {
        table.push_back({axis.name, fmt::format("{}", axis.values.size()),
                         fmt::format("{:.17g}", axis.values.front()),
                         fmt::format("{:.17g}", axis.values.back())});
    }
    fmt::print("{}\n{}", aligned(table, 0), attribute_text(contents.attributes));
    return exit_done;
}

int info(const std::string& file) {
    if (!sweep_directory(file).empty()) return info_of_sweep(file);
    const map_reader map(file);
    const map_layout& layout = map.layout();
    fmt::print("{}: {} cells in {} tiles of {}\n\n{}\n{}\n", file, layout.n_cells(),
               layout.n_tiles(), fmt::join(layout.tile, " x "), axis_text(layout),
               layer_text(layout));
    if (!map.attractors().empty()) fmt::print("{}\n", attractor_text(map));
    fmt::print("{}", attribute_text(map.attributes()));
    if (!map.is_finished_map())
        fmt::print("unfinished: {} tiles are missing\n", map.missing_tiles().size());
    return exit_done;
}

}  // namespace

void add_info(CLI::App& program, int& exit_code) {
    auto file = std::make_shared<std::string>();
    CLI::App* command = program.add_subcommand("info", "What a map shows and how it was made");
    command->add_option("file", *file, "Map file (HDF5)")->required();
    command->callback([file, &exit_code] { exit_code = info(*file); });
}

}  // namespace hopscotch
