// Boundary refinement: a coarse grid first, then only cells at whose place neighbours differ, level
// by level down to the map's own cells, and on from there along every boundary that was met.
//
// Round 0 computes every 2^L-th cell along each axis; it stands for the block of 2^L cells from it
// on. Round r, 1 to L, looks at the map as rounds 0 to r - 1 have left it, in blocks of
// 2^(L - r + 1) cells: a block whose classes differ from those of any neighbour, diagonal ones
// included, has its 2^d parts computed. The last round, L + 1, follows boundaries cell by cell: a
// cell is computed where a neighbour's class, or the class that it had itself after round L,
// differs from what the cell would inherit, until there is none. So at the end every cell that
// differs from a neighbour was computed itself. A feature that lies within a block and meets none
// of the corners that were computed is not seen. What is computed depends on nothing but the map:
// not on tiles, threads, ranks or interruptions (the last round is a least fixed point, which does
// not depend on the order of its steps).
//
// The layer `level` says in which round a cell was computed, or `inherited`. Inherited cells have
// the classes (int16 and uint8 layers) of the nearest cell of rounds 0 to L whose block they lie
// in; their numbers (other layers) are "not computed".
#pragma once

#include "host/refine/class_cache.hpp"
#include "host/run/tiles.hpp"
#include "host/store/map_run.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hopscotch::refine {

/// Cells that round 0 computes in a box that begins at a multiple of 2^levels.
std::uint64_t coarse_cells_in(const tile_box& box, int levels);

/// Round 0 of one tile. Thread safe.
tile_result compute_coarse(const tile_job& job, const tile_box& box);

/// The rounds after the first one, on the tiles of a run. Memory: the classes of a fixed number of
/// tiles.
class refinement {
public:
    /// \param job, run  borrowed
    refinement(const tile_job& job, const map_run& run) : job_(job), run_(run), known_(job, run) {}

    /// Cells of a tile that round 1 to L + 1 lacks; nothing where none is missing. The last round
    /// goes over the tiles again until nothing is. Thread safe.
    /// \error store_error where a tile cannot be read
    std::optional<tile_result> compute(const tile_box& box, int round);

    /// A pass has written these tiles: what was read of them meanwhile may be out of date. To be
    /// called before the last round goes over the tiles again.
    void forget(const std::vector<std::uint64_t>& tiles) { known_.forget(tiles); }

    /// Other ranks have written tiles.
    void forget_all() { known_.forget_all(); }

private:
    const tile_job& job_;
    const map_run& run_;
    class_cache known_;
};

/// These tiles and their neighbours, diagonal ones included; rising.
std::vector<std::uint64_t> with_neighbours(const map_layout& layout,
                                           const std::vector<std::uint64_t>& tiles);

}  // namespace hopscotch::refine
