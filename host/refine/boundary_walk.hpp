// The last round of refinement: along every boundary, cell by cell.
#pragma once

#include "host/refine/block_view.hpp"

#include <cstdint>
#include <vector>

namespace hopscotch::refine {

/// The last round within one tile: follows boundaries until they are known or leave it.
class boundary_walk {
public:
    boundary_walk(const tile_job& job, const tile_box& box, const tiles_around& around);

    /// Cells of the tile that have to be computed, given what is known.
    std::vector<std::uint64_t> first_steps() const;

    /// Takes the classes of cells that were computed; returns those that have to be now.
    std::vector<std::uint64_t> next_steps(const tile_data& tile,
                                          const std::vector<std::uint64_t>& places);

private:
    static constexpr std::uint64_t nowhere = ~std::uint64_t{0};

    bool is_wanted(std::uint64_t at) const;

    const tile_job& job_;
    block_view inherited_;                // classes after round L
    std::vector<std::uint64_t> classes_;  // classes as they are known now
    std::vector<bool> is_known_;          // computed
    std::vector<std::uint64_t> place_of_;
    std::vector<std::uint64_t> cells_;  // by place
};

}  // namespace hopscotch::refine
