// One queue over the maps and tiles of a sweep that several ranks compute. Each map has an owner,
// which has drawn it, plans, searches, audits and packs it; the tiles of its first pass can be
// drawn by any rank. So ranks that find no further map help those that are still at one.
#pragma once

#include "host/run/shared_counters.hpp"
#include "host/run/tile_queue.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace hopscotch {

/// Which tiles of which map are drawn and done. Every tile is drawn once, those that an earlier run
/// has left included. From any thread of any rank.
class map_draw {
public:
    map_draw(std::unique_ptr<shared_counters> counters, std::uint64_t n_tiles)
        : counters_(std::move(counters)), n_tiles_(n_tiles) {}
    static std::size_t n_counters(std::size_t n_maps) { return 1 + n_places * n_maps; }

    /// Tiles of the map may be drawn from now on.
    void open(std::size_t map) { counters_->add(drawn(map), 1); }
    std::optional<std::uint64_t> next(std::size_t map);
    /// Tiles nobody has drawn; none before the map is opened and after it is closed.
    std::uint64_t n_left(std::size_t map);
    /// True where no tile will be drawn any more.
    bool is_dry(std::size_t map) { return counters_->read(drawn(map)) > n_tiles_; }
    /// A drawn tile is finished, by the owner or by a helper, or was there.
    void count(std::size_t map, bool is_help);
    /// Nobody draws another tile.
    void close(std::size_t map);
    /// Closes the map and waits for tiles in flight.
    void finish(std::size_t map);
    /// Tiles of the map that helpers have computed.
    std::uint64_t n_helped(std::size_t map) { return counters_->read(helped(map)); }

    /// The sweep ends early: nobody waits for anybody.
    void halt() { counters_->add(halted, 1); }
    bool is_halted() { return counters_->read(halted) > 0; }

private:
    static constexpr std::size_t halted = 0;
    static constexpr std::size_t n_places = 4;
    static constexpr std::uint64_t closed = std::uint64_t{1} << 40;  // more than any map's tiles

    static std::size_t drawn(std::size_t map) { return 1 + n_places * map; }  // 1: open, none yet
    static std::size_t last(std::size_t map) { return 2 + n_places * map; }   // when closed: 1 more
    static std::size_t done(std::size_t map) { return 3 + n_places * map; }
    static std::size_t helped(std::size_t map) { return 4 + n_places * map; }

    std::unique_ptr<shared_counters> counters_;
    std::uint64_t n_tiles_;
};

/// The owner's queue.
class owner_queue : public local_queue {
public:
    /// \param tiles  of the map that are missing, rising
    owner_queue(map_draw& draw, std::size_t map, std::vector<std::uint64_t> tiles,
                progress_display show);
    ~owner_queue() override;
    std::optional<std::uint64_t> next() override;
    void count(const run_tally& of_tile) override;
    void halt() override { draw_.close(map_); }
    run_tally close() override;

private:
    map_draw& draw_;
    std::size_t map_;
    std::vector<std::uint64_t> missing_;
};

/// A helper's queue.
class helper_queue : public local_queue {
public:
    helper_queue(map_draw& draw, std::size_t map, progress_display show)
        : local_queue({}, std::move(show)), draw_(draw), map_(map) {}
    ~helper_queue() override;
    std::optional<std::uint64_t> next() override;
    /// The next tile of all; the owner waits for a drawn tile, not for one that is left.
    void put_back(std::uint64_t tile) { put_back_ = tile; }
    void count(const run_tally& of_tile) override;
    void halt() override { draw_.close(map_); }

private:
    map_draw& draw_;
    std::size_t map_;
    std::optional<std::uint64_t> put_back_;
};

}  // namespace hopscotch
