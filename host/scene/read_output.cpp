// [output]: which layers are stored, where, and in tiles of which shape.
#include "host/scene/readers.hpp"

#include "host/scene/layers.hpp"
#include "host/scene/questions.hpp"
#include "host/scene/suggest.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr double standard_tile_cells = 65536.0;  // 256 x 256
constexpr std::uint64_t least_tile_cells = 1024;
constexpr std::uint64_t enough_tiles = 64;  // so that threads share a small map's work evenly
// so that one folder and one virtual dataset hold a map's tiles: a virtual dataset of 16384 parts
// takes HDF5 0.2 s and 250 MiB to open
constexpr std::uint64_t most_tiles = 16384;
constexpr std::int64_t most_tile_cells = std::int64_t{1} << 26;

/// Of one map.
std::uint64_t n_tiles(const scene& scene, const std::vector<std::uint64_t>& tile) {
    std::uint64_t tiles = 1;
    for (std::size_t axis = 0; axis < tile.size(); ++axis) {
        tiles *= (scene.axes[axis].cells + tile[axis] - 1) / tile[axis];
    }
    return tiles;
}

std::uint64_t cells_of(const std::vector<std::uint64_t>& tile) {
    std::uint64_t cells = 1;
    for (const std::uint64_t extent : tile) cells *= extent;
    return cells;
}

/// Tiles of a refined map hold whole blocks of the coarse grid.
std::uint64_t in_blocks(const scene& scene, std::uint64_t extent) {
    const std::uint64_t block = std::uint64_t{1} << scene.refine;
    return (extent + block - 1) / block * block;
}

/// 256 x 256 or as many cells in other dimensions; smaller on small maps, larger on very large
/// ones.
std::vector<std::uint64_t> standard_tile(const scene& scene) {
    const double side = std::pow(standard_tile_cells, 1.0 / static_cast<double>(scene.axes.size()));
    std::vector<std::uint64_t> tile;
    for (const scene_axis& axis : scene.axes) {
        tile.push_back(std::min(axis.cells, static_cast<std::uint64_t>(side + 0.5)));
    }
    const std::uint64_t n_maps = scene.sweep.n_points();  // all maps' tiles are one pool
    while (n_maps * n_tiles(scene, tile) < enough_tiles && cells_of(tile) > least_tile_cells) {
        std::uint64_t& longest = *std::max_element(tile.begin(), tile.end());
        longest = (longest + 1) / 2;
    }
    while (n_tiles(scene, tile) > most_tiles &&
           2 * cells_of(tile) <= static_cast<std::uint64_t>(most_tile_cells)) {
        *std::min_element(tile.begin(), tile.end()) *= 2;
    }
    for (std::size_t axis = 0; axis < tile.size(); ++axis) {
        tile[axis] = std::min(in_blocks(scene, tile[axis]), scene.axes[axis].cells);
    }
    return tile;
}

void read_tile(scene& scene, const table_reader& table) {
    scene.output.tile = standard_tile(scene);
    const auto tile = table.wholes("tile", 1);
    if (!tile) return;
    scene.output.has_own_tile = true;
    if (tile->size() != scene.axes.size()) {
        table.refuse("tile", fmt::format("the grid has {} axes", scene.axes.size()),
                     fmt::format("one number per axis, as {}", fmt::join(scene.output.tile, ", ")));
    }
    for (std::size_t axis = 0; axis < tile->size(); ++axis) {
        const auto extent = static_cast<std::uint64_t>((*tile)[axis]);
        scene.output.tile[axis] = std::min(scene.axes[axis].cells, extent);
        if (extent < scene.axes[axis].cells && extent != in_blocks(scene, extent)) {
            table.refuse("tile",
                         fmt::format("grid.refine = {} needs multiples of {}", scene.refine,
                                     std::uint64_t{1} << scene.refine),
                         fmt::format("{}", in_blocks(scene, extent)));
        }
    }
    if (cells_of(scene.output.tile) > static_cast<std::uint64_t>(most_tile_cells)) {
        table.refuse("tile", "more than 2^26 cells in a tile", "[256, 256]");
    }
}

const layer_plan* find_layer(const std::vector<layer_plan>& layers, std::string_view name) {
    for (const layer_plan& layer : layers) {
        if (layer.description.name == name || layer.alias == name) return &layer;
    }
    return nullptr;
}

/// Those of the question that the model has.
std::vector<std::string> standard_layers(const scene& scene) {
    const std::vector<layer_plan> available = available_layers(scene);
    std::vector<std::string> names;
    for (const std::string_view name : find_question(scene.question.kind)->standard_layers) {
        if (find_layer(available, std::string(name)) != nullptr) names.emplace_back(name);
        if (name != "state") continue;
        for (const layer_plan& layer : available) {
            if (layer.role == layer_role::state) names.push_back(layer.description.name);
        }
    }
    return names;
}

void add_layer(std::vector<std::string>& layers, const std::string& name) {
    if (std::find(layers.begin(), layers.end(), name) == layers.end()) layers.push_back(name);
}

/// The label or motion (where there is one) and the outcome are always stored: shares are counted
/// from them.
void read_layers(scene& scene, const table_reader& table) {
    const std::vector<layer_plan> available = available_layers(scene);
    std::vector<std::string_view> known;
    for (const layer_plan& layer : available) known.push_back(layer.description.name);
    std::vector<std::string>& layers = scene.output.layers;
    for (const std::string& name : table.texts("layers").value_or(standard_layers(scene))) {
        const layer_plan* found = find_layer(available, name);
        if (found == nullptr) {
            const std::string near = closest(name, known);
            const std::string all = "one of " + listed(known);
            table.refuse("layers",
                         fmt::format("no layer \"{}\" for the question {} on {}", name,
                                     scene.question.kind, scene.info().name),
                         near.empty() ? all : fmt::format("\"{}\", {}", near, all));
        }
        add_layer(layers, found->description.name);
    }
    if (scene.question.has_labels) add_layer(layers, "label");
    if (scene.question.kind == "lyapunov") add_layer(layers, "motion");
    if (scene.refine > 0) add_layer(layers, "level");
    add_layer(layers, "outcome");
}

}  // namespace

void read_output(scene& scene, const table_reader& root) {
    const table_reader table = root.table("output");
    table.expect_keys({"file", "tile", "compression", "layers"});
    const std::string stem = std::filesystem::path(scene.file).stem().string();
    const std::string file = table.text("file").value_or((stem.empty() ? "map" : stem) + ".h5");
    if (file.empty()) table.refuse("file", "an empty file name", stem + ".h5");
    scene.output.file = file;
    scene.output.compression =
        static_cast<int>(table.whole("compression", 0, 9).value_or(scene.output.compression));
    read_tile(scene, table);
    read_layers(scene, table);
}

}  // namespace hopscotch
