// hopscotch info FILE.h5: what a map shows, how it was made, and its attractors.
#include "host/cli/commands.hpp"
#include "host/cli/tables.hpp"
#include "host/run/summary.hpp"
#include "host/store/map_reader.hpp"

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
std::string attribute_text(const map_reader& map) {
    rows table;
    for (const auto& [name, value] : map.attributes()) {
        const bool is_short = value.size() < 200 && value.find('\n') == value.npos;
        table.push_back({name, is_short ? value : fmt::format("({} bytes of text)", value.size())});
    }
    return aligned(table, 0);
}

int info(const std::string& file) {
    const map_reader map(file);
    const map_layout& layout = map.layout();
    fmt::print("{}: {} cells in {} tiles of {}\n\n{}\n{}\n", file, layout.n_cells(),
               layout.n_tiles(), fmt::join(layout.tile, " x "), axis_text(layout),
               layer_text(layout));
    if (!map.attractors().empty()) fmt::print("{}\n", attractor_text(map));
    fmt::print("{}", attribute_text(map));
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
