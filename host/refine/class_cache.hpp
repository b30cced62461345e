// The classes of tiles around the one in work, read from the run and kept for a while: memory is
// that of a fixed number of tiles.
#pragma once

#include "host/refine/tile_classes.hpp"
#include "host/store/map_run.hpp"

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace hopscotch::refine {

/// A tile and its neighbours, by 0, 1, 2 along each axis; null beyond the map.
using tiles_around = std::vector<std::shared_ptr<const tile_classes>>;

inline const tile_classes& own_tile(const tiles_around& around) {
    return *around[around.size() / 2];
}

/// Thread safe.
class class_cache {
public:
    /// \param job, run  borrowed
    class_cache(const tile_job& job, const map_run& run) : job_(job), run_(run) {}

    /// \error store_error where a tile cannot be read
    tiles_around around(const tile_box& box);

    /// A tile was computed: what was read of it meanwhile does not replace this.
    void put(const tile_data& tile);

    /// These tiles were written: what was read of them meanwhile may be out of date.
    void forget(const std::vector<std::uint64_t>& tiles);
    void forget_all();

private:
    using shared_classes = std::shared_ptr<const tile_classes>;

    shared_classes classes(std::uint64_t tile);
    shared_classes find(std::uint64_t tile);
    /// Returns what is kept.
    shared_classes keep(std::uint64_t tile, const shared_classes& classes, bool is_computed);

    const tile_job& job_;
    const map_run& run_;
    std::mutex mutex_;
    std::map<std::uint64_t, shared_classes> kept_;
    std::list<std::uint64_t> order_;  // the tile read first is the first to go
    bool has_lost_some_ = false;      // so that tiles were read from their files again
};

}  // namespace hopscotch::refine
