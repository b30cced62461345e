// Classes of a tile's cells, and what cells inherit that were not computed themselves.
#include "host/refine/tile_classes.hpp"

#include "host/map/numbers.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

namespace hopscotch::refine {
namespace {

std::size_t level_index(const tile_job& job) {
    std::size_t index = 0;
    while (job.layers[index].role != layer_role::level) ++index;  // always stored
    return index;
}

/// Layers that tell classes apart and that inherited cells have.
bool is_class(const layer_plan& layer) {
    const number_type type = layer.description.type;
    const bool is_small = type == number_type::int16 || type == number_type::int8;
    return is_small && layer.role != layer_role::level && layer.role != layer_role::uncertain;
}

}  // namespace

std::uint64_t tile_classes::offset_of(const cell_index& position) const {
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < box.extent.size(); ++i) {
        offset = offset * box.extent[i] + position[i];
    }
    return offset;
}

std::uint64_t tile_classes::owner_of(cell_index position, int round) const {
    for (std::uint64_t size = 2;; size *= 2) {
        const std::uint64_t offset = offset_of(position);
        if (levels[offset] >= 0 && levels[offset] <= round) return offset;
        // round 0 has computed the last of these
        for (std::size_t i = 0; i < box.extent.size(); ++i) position[i] &= ~(size - 1);
    }
}

std::uint64_t class_at(const tile_job& job, const tile_data& tile, std::uint64_t cell) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        if (!is_class(job.layers[i])) continue;
        const number_type type = job.layers[i].description.type;
        const unsigned bits = 8 * static_cast<unsigned>(bytes_of(type));
        const auto value = static_cast<std::int64_t>(number_at(type, tile.layers[i].data(), cell));
        result = result << bits | (static_cast<std::uint64_t>(value) & ((1U << bits) - 1));
    }
    return result;
}

tile_classes classes_of(const tile_job& job, const tile_data& tile) {
    tile_classes result{tile.box, std::vector<std::uint64_t>(tile.box.n_cells(), 0), {}, false};
    for (std::uint64_t cell = 0; cell < result.classes.size(); ++cell) {
        result.classes[cell] = class_at(job, tile, cell);
    }
    const auto* levels =
        reinterpret_cast<const std::int8_t*>(tile.layers[level_index(job)].data());
    result.levels.assign(levels, levels + tile.box.n_cells());
    result.is_uniform = std::adjacent_find(result.classes.begin(), result.classes.end(),
                                           std::not_equal_to<>()) == result.classes.end();
    return result;
}

void inherit(const tile_job& job, tile_data& tile) {
    const tile_classes known = classes_of(job, tile);
    std::vector<std::uint64_t> owners(tile.box.n_cells());
    for_each_position(tile.box.extent, [&](const cell_index& position, std::uint64_t cell) {
        const bool is_known = known.levels[cell] != inherited_level;
        owners[cell] = is_known ? cell : known.owner_of(position, job.what.refine);
    });
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        if (job.layers[i].role == layer_role::level) continue;
        const layer& each = job.layers[i].description;
        const std::size_t size = bytes_of(each.type);
        std::byte* const values = tile.layers[i].data();
        for (std::uint64_t cell = 0; cell < owners.size(); ++cell) {
            if (owners[cell] == cell) continue;
            if (is_class(job.layers[i])) {
                std::memcpy(values + cell * size, values + owners[cell] * size, size);
            } else {
                fill_numbers(each.type, values, cell, 1, each.fill);
            }
        }
    }
}

}  // namespace hopscotch::refine
