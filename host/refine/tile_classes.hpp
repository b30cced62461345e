// What boundary refinement looks at: one number per cell that tells its classes (label, outcome and
// the like) from others, and the round in which the cell was computed.
#pragma once

#include "host/refine/grid_walk.hpp"
#include "host/run/tiles.hpp"

#include <cstdint>
#include <vector>

namespace hopscotch::refine {

/// Values of the layer `level` of cells that were not computed themselves.
inline constexpr std::int8_t inherited_level = -2;

/// The classes of one tile: a number per cell for all class layers, and the levels. Positions count
/// from the tile's origin, which is a multiple of the coarsest block.
struct tile_classes {
    tile_box box;
    std::vector<std::uint64_t> classes;
    std::vector<std::int8_t> levels;
    bool is_uniform = false;

    std::uint64_t offset_of(const cell_index& position) const;

    /// The cell whose block a cell lies in after a round: itself, or the nearest one computed.
    std::uint64_t owner_of(cell_index position, int round) const;
};

/// One number for all class layers of a cell: at most 64 bits of them.
std::uint64_t class_at(const tile_job& job, const tile_data& tile, std::uint64_t cell);

tile_classes classes_of(const tile_job& job, const tile_data& tile);

/// Gives every inherited cell the classes of the cell whose block it lies in, and no numbers.
void inherit(const tile_job& job, tile_data& tile);

}  // namespace hopscotch::refine
