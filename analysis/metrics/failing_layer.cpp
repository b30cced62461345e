// Reads outcomes tile by tile, transforms, and puts the tiles back row by row.
#include "analysis/metrics/failing_layer.hpp"

#include "analysis/metrics/distance.hpp"
#include "analysis/metrics/read_classes.hpp"
#include "host/map/numbers.hpp"
#include "host/map/rows.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/layers.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch::metrics {
namespace {

constexpr class_index is_falling = 1;

std::vector<std::uint64_t> shape_of(const map_layout& layout) {
    std::vector<std::uint64_t> shape;
    for (const axis& along : layout.axes) shape.push_back(along.size());
    return shape;
}

/// Position in the map's C order of the k-th cell of a box.
std::uint64_t place_of(const std::vector<std::uint64_t>& shape, const tile_box& box,
                       std::uint64_t k) {
    return offset_in(shape, coordinates_in(box, k));
}

class_grid read_falls(const map_layout& layout, const map_run& run) {
    class_grid grid;
    for (const axis& along : layout.axes) {
        if (along.size() > 1) grid.axes.push_back(along);
    }
    if (grid.axes.empty()) grid.axes.push_back(layout.axes.front());
    grid.cells.assign(layout.n_cells(), 0);
    const std::vector<std::uint64_t> shape = shape_of(layout);
    const std::size_t outcomes = layer_index(layout, "outcome");
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        const tile_data data = run.read(tile);
        for (std::uint64_t k = 0; k < data.box.n_cells(); ++k) {
            const double code = number_at(number_type::int8, data.layers[outcomes].data(), k);
            const auto end = static_cast<outcome>(static_cast<int>(code));
            if (is_failure(end)) grid.cells[place_of(shape, data.box, k)] = is_falling;
        }
    }
    return grid;
}

/// Tiles that share their cells along the first axis longer than one cell, in the map's order.
std::vector<std::vector<std::uint64_t>> rows_of_tiles(const map_layout& layout) {
    std::size_t first = 0;
    while (first + 1 < layout.axes.size() && layout.axes[first].size() == 1) ++first;
    std::vector<std::vector<std::uint64_t>> rows(layout.tiles_along()[first]);
    const std::uint64_t height = full_tile(layout)[first];
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        rows[box_of(layout, tile).origin[first] / height].push_back(tile);
    }
    return rows;
}

}  // namespace

bool wants_failing_distance(const scene& scene) {
    const std::vector<layer_plan> layers = chosen_layers(scene);
    return std::any_of(layers.begin(), layers.end(), [](const layer_plan& layer) {
        return layer.role == layer_role::failing_distance;
    });
}

void fill_failing_distances(const scene& scene, map_run& run) {
    const map_layout layout = layout_of(scene);
    const class_grid grid = read_falls(layout, run);
    const std::vector<std::uint64_t> shape = shape_of(layout);
    const std::uint64_t slab = grid.cells.size() / grid.axes.front().size();
    const distance_transform distances(grid, length_unit::cells,
                                       [&](std::uint64_t i, std::span<std::uint8_t> marks) {
                                           std::copy_n(&grid.cells[i * slab], slab, marks.begin());
                                       });
    const std::size_t target = layer_index(layout, "failing_distance");
    std::uint64_t begin = 0;  // slabs that lie before the row
    for (const std::vector<std::uint64_t>& row : rows_of_tiles(layout)) {
        std::uint64_t n_cells = 0;
        for (const std::uint64_t tile : row) n_cells += box_of(layout, tile).n_cells();
        std::vector<double> squared(n_cells);
#pragma omp parallel for schedule(dynamic)
        for (std::uint64_t i = 0; i < n_cells / slab; ++i) {
            distances.squared(begin + i, std::span(squared).subspan(i * slab, slab));
        }
        for (const std::uint64_t tile : row) {
            tile_data data = run.read(tile);
            auto* to = reinterpret_cast<double*>(data.layers[target].data());
            for (std::uint64_t k = 0; k < data.box.n_cells(); ++k) {
                to[k] = std::sqrt(squared[place_of(shape, data.box, k) - begin * slab]);
            }
            run.put(compress(layout, data, scene.output.compression, run.seconds_of(tile)));
        }
        begin += n_cells / slab;
    }
}

}  // namespace hopscotch::metrics
