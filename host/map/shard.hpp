// A part of a map's tiles, for jobs that know nothing of each other.
#pragma once

#include <cstdint>

namespace hopscotch {

/// Part `index` of `count`: tile t belongs to part t mod count, so that neighbours, which cost
/// alike, are dealt to all. Users count parts from 1.
struct shard {
    std::uint64_t index = 0;
    std::uint64_t count = 1;

    bool is_whole() const { return count == 1; }
    bool owns(std::uint64_t tile) const { return tile % count == index; }

    /// How many of a map's tiles are its own.
    std::uint64_t n_tiles(std::uint64_t n_all) const {
        return n_all / count + (index < n_all % count ? 1 : 0);
    }
};

}  // namespace hopscotch
