// Rounds of boundary refinement.
#include "host/refine/refinement.hpp"

#include "host/map/rows.hpp"
#include "host/refine/boundary_walk.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <set>

namespace hopscotch::refine {
namespace {

/// Cells along a side of the blocks in which a round has left the map.
std::uint64_t block_after(int round, int levels) {
    return round >= levels ? 1 : std::uint64_t{1} << (levels - round);
}

/// Computes cells of a tile (by place in it) for a round; what others inherit is not yet set.
void compute_places(const tile_job& job, tile_data& tile, const std::vector<std::uint64_t>& places,
                    int round, lane_statistics& lanes) {
    coordinates shape;
    for (const axis& along : job.layout.axes) shape.push_back(along.size());
    std::vector<std::uint64_t> cells;
    for (const std::uint64_t place : places) {
        cells.push_back(offset_in(shape, coordinates_in(tile.box, place)));
    }
    const std::vector<std::vector<std::byte>> found = compute_cells(job, cells, lanes);
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        const std::size_t size = bytes_of(job.layers[i].description.type);
        const bool is_level = job.layers[i].role == layer_role::level;
        for (std::size_t k = 0; k < places.size(); ++k) {
            std::byte* const value = tile.layers[i].data() + places[k] * size;
            if (is_level) {
                *value = static_cast<std::byte>(round);
            } else {
                std::memcpy(value, found[i].data() + k * size, size);
            }
        }
    }
}

using clock_type = std::chrono::steady_clock;

tile_result finished(const tile_job& job, tile_data tile, std::uint64_t n_computed,
                     const lane_statistics& lanes, clock_type::time_point begin) {
    inherit(job, tile);
    tile_result result;
    result.data = std::move(tile);
    result.lanes = lanes;
    result.n_computed = n_computed;
    result.seconds = std::chrono::duration<double>(clock_type::now() - begin).count();
    return result;
}

/// Rounds 1 to L: the places in the tile of the parts that blocks on a boundary lack.
std::vector<std::uint64_t> missing_parts(const tile_job& job, const tile_box& box,
                                         const tiles_around& around, int round) {
    const tile_classes& own = own_tile(around);
    block_view view = empty_view(box, block_after(round - 1, job.what.refine));
    for_each_block(job.layout, box, view, around,
                   [&](std::uint64_t k, const tile_classes& tile, const cell_index& position) {
                       view.classes[k] = tile.classes[tile.owner_of(position, round - 1)];
                   });
    const std::uint64_t part = view.size / 2;
    const coordinates parts(box.extent.size(), 2);
    std::vector<std::uint64_t> missing;
    for_each_position(view.blocks, [&](const cell_index& block, std::uint64_t) {
        if (!view.differs_at(view.at(block))) return;
        for_each_position(parts, [&](const cell_index& step, std::uint64_t) {
            cell_index position{};
            for (std::size_t i = 0; i < parts.size(); ++i) {
                position[i] = block[i] * view.size + step[i] * part;
                if (position[i] >= box.extent[i]) return;  // beyond the map
            }
            const std::uint64_t place = own.offset_of(position);
            if (own.levels[place] == inherited_level) missing.push_back(place);
        });
    });
    std::sort(missing.begin(), missing.end());
    return missing;
}

}  // namespace

std::uint64_t coarse_cells_in(const tile_box& box, int levels) {
    std::uint64_t cells = 1;
    for (const std::uint64_t extent : box.extent) cells *= ceiling(extent, block_after(0, levels));
    return cells;
}

tile_result compute_coarse(const tile_job& job, const tile_box& box) {
    const auto begin = clock_type::now();
    lane_statistics lanes;
    const std::uint64_t size = block_after(0, job.what.refine);
    tile_data tile{box, {}};
    for (const layer_plan& layer : job.layers) {
        auto& values = tile.layers.emplace_back(box.n_cells() * bytes_of(layer.description.type));
        if (layer.role == layer_role::level) {
            std::fill(values.begin(), values.end(), std::bit_cast<std::byte>(inherited_level));
        }
    }
    std::vector<std::uint64_t> places;
    for_each_position(box.extent, [&](const cell_index& position, std::uint64_t place) {
        if (std::all_of(position.begin(), position.end(), [&](auto x) { return x % size == 0; })) {
            places.push_back(place);
        }
    });
    compute_places(job, tile, places, 0, lanes);
    return finished(job, std::move(tile), places.size(), lanes, begin);
}

std::optional<tile_result> refinement::compute(const tile_box& box, int round) {
    const auto begin = clock_type::now();
    const tiles_around around = known_.around(box);
    if (is_uniform(around)) return std::nullopt;
    const bool is_last = round > job_.what.refine;
    std::optional<boundary_walk> walk;
    if (is_last) walk.emplace(job_, box, around);
    std::vector<std::uint64_t> places =
        is_last ? walk->first_steps() : missing_parts(job_, box, around, round);
    if (places.empty()) return std::nullopt;
    tile_data tile = run_.read(box.index);
    lane_statistics lanes;
    std::uint64_t n_computed = 0;
    while (!places.empty()) {
        compute_places(job_, tile, places, round, lanes);
        n_computed += places.size();
        places = is_last ? walk->next_steps(tile, places) : std::vector<std::uint64_t>();
    }
    tile_result result = finished(job_, std::move(tile), n_computed, lanes, begin);
    known_.put(result.data);
    return result;
}

std::vector<std::uint64_t> with_neighbours(const map_layout& layout,
                                           const std::vector<std::uint64_t>& tiles) {
    const coordinates along = layout.tiles_along();
    const tile_box all{0, coordinates(along.size(), 0), along};
    std::set<std::uint64_t> result;
    for (const std::uint64_t tile : tiles) {
        const coordinates at = coordinates_in(all, tile);
        for_each_offset(at.size(), -1, [&](const std::vector<int>& offset) {
            coordinates other = at;
            for (std::size_t i = 0; i < other.size(); ++i) {
                if (offset[i] < 0 && other[i] == 0) return;
                other[i] += static_cast<std::uint64_t>(offset[i]);
                if (other[i] >= along[i]) return;
            }
            result.insert(offset_in(along, other));
        });
    }
    return {result.begin(), result.end()};
}

}  // namespace hopscotch::refine
