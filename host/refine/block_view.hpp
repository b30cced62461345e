// A tile's classes in blocks, with a rim of those around it: what one round of refinement looks at.
#pragma once

#include "host/refine/class_cache.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopscotch::refine {

/// The blocks of a tile as a round has left them, and one more on every side. Beyond the map lies
/// what lies at its edge.
struct block_view {
    std::uint64_t size = 1;  // cells along a side of a block
    coordinates blocks;      // of the tile, along each axis
    coordinates extent;      // with those around
    std::vector<std::uint64_t> classes;
    std::vector<std::ptrdiff_t> neighbours;  // distances in `classes`

    /// Where a block of the tile lies in `classes`.
    std::uint64_t at(const cell_index& block) const;

    /// A neighbour, diagonal ones included, is of another class.
    bool differs_at(std::uint64_t block) const;
};

block_view empty_view(const tile_box& box, std::uint64_t size);

/// Nothing to refine: one class in the tile and all around it.
bool is_uniform(const tiles_around& around);

/// Where the blocks of a view lie along one axis: tile before, this one or after (0, 1, 2), and the
/// place of the block's first cell in it.
struct place_along {
    std::uint64_t tile;
    std::uint64_t position;
};

std::vector<place_along> places_along(const map_layout& layout, const tile_box& box,
                                      const block_view& view, std::size_t axis);

/// Calls visit(k, tile, position) for every block of a view: where its first cell lies.
template <class Visit>
void for_each_block(const map_layout& layout, const tile_box& box, const block_view& view,
                    const tiles_around& around, Visit&& visit) {
    std::vector<std::vector<place_along>> places;
    for (std::size_t i = 0; i < view.extent.size(); ++i) {
        places.push_back(places_along(layout, box, view, i));
    }
    for_each_position(view.extent, [&](const cell_index& block, std::uint64_t k) {
        std::uint64_t tile = 0;
        cell_index position{};
        for (std::size_t i = 0; i < view.extent.size(); ++i) {
            const place_along& place = places[i][block[i]];
            tile = tile * 3 + place.tile;
            position[i] = place.position;
        }
        visit(k, *around[tile], position);
    });
}

}  // namespace hopscotch::refine
