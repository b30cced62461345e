// The queue over the maps and tiles of a sweep: every tile is drawn once, an owner waits for the
// tiles of its helpers and for nothing else.
#include "host/run/map_draw.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <thread>

using namespace hopscotch;

namespace {

constexpr std::uint64_t n_tiles = 40;

map_draw two_maps() { return {std::make_unique<local_counters>(map_draw::n_counters(2)), n_tiles}; }

std::vector<std::uint64_t> tiles_from(std::uint64_t first) {
    std::vector<std::uint64_t> tiles(n_tiles - first);
    std::iota(tiles.begin(), tiles.end(), first);
    return tiles;
}

run_tally tile_of(std::uint64_t cells) {
    run_tally tally;
    tally.tiles = 1;
    tally.cells = cells;
    return tally;
}

void ignore(const run_tally&) {}

}  // namespace

TEST(map_draw, a_map_is_open_from_its_owners_queue_to_its_last_tile) {
    map_draw draw = two_maps();
    EXPECT_EQ(draw.n_left(1), 0u);
    EXPECT_FALSE(draw.is_dry(1));  // it will be opened
    owner_queue owner(draw, 1, tiles_from(0), ignore);
    EXPECT_EQ(draw.n_left(1), n_tiles);
    EXPECT_EQ(draw.n_left(0), 0u);
    for (std::uint64_t tile = 0; tile < n_tiles; ++tile) EXPECT_EQ(owner.next(), tile);
    EXPECT_FALSE(owner.next());
    EXPECT_TRUE(draw.is_dry(1));
    EXPECT_FALSE(draw.is_dry(0));
}

TEST(map_draw, owner_and_helper_draw_every_tile_once_and_the_owner_counts_both) {
    map_draw draw = two_maps();
    owner_queue owner(draw, 0, tiles_from(10), ignore);  // ten are there already
    std::vector<int> n_drawn(n_tiles, 0);
    const auto take_all = [&](tile_queue& queue, std::vector<std::uint64_t>& mine) {
        while (const auto tile = queue.next()) {
            mine.push_back(*tile);
            queue.count(tile_of(*tile >= 10 ? 5 : 0));
        }
    };
    std::vector<std::uint64_t> of_owner;
    std::vector<std::uint64_t> of_helper;
    {
        helper_queue helper(draw, 0, ignore);
        const std::jthread other([&] { take_all(helper, of_helper); });
        take_all(owner, of_owner);
    }
    for (const std::uint64_t tile : of_owner) ++n_drawn[tile];
    for (const std::uint64_t tile : of_helper) ++n_drawn[tile];
    for (std::uint64_t tile = 10; tile < n_tiles; ++tile) EXPECT_EQ(n_drawn[tile], 1) << tile;
    EXPECT_EQ(owner.close().tiles, n_tiles - 10);
}

TEST(map_draw, an_owner_waits_for_a_helpers_tile_in_flight) {
    map_draw draw = two_maps();
    owner_queue owner(draw, 0, tiles_from(0), ignore);
    helper_queue helper(draw, 0, ignore);
    EXPECT_EQ(helper.next(), 0u);
    owner.halt();
    EXPECT_FALSE(owner.next());
    std::atomic<bool> is_counted = false;
    const std::jthread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        is_counted = true;
        helper.count(tile_of(5));
    });
    EXPECT_EQ(owner.close().tiles, 1u);
    EXPECT_TRUE(is_counted);
}

TEST(map_draw, draws_after_the_end_hold_nobody_up) {
    map_draw draw = two_maps();
    owner_queue owner(draw, 0, tiles_from(0), ignore);
    EXPECT_EQ(owner.next(), 0u);
    owner.count(tile_of(5));
    owner.halt();  // a signal, in the middle of the map
    helper_queue helper(draw, 0, ignore);
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(helper.next());
    EXPECT_EQ(owner.close().tiles, 1u);
}

TEST(map_draw, a_tile_that_a_helper_gives_up_is_missing_and_not_waited_for) {
    map_draw draw = two_maps();
    owner_queue owner(draw, 0, tiles_from(0), ignore);
    {
        helper_queue helper(draw, 0, ignore);
        helper.put_back(*helper.next());
    }
    while (owner.next()) owner.count(tile_of(5));
    EXPECT_EQ(owner.close().tiles, n_tiles - 1);
}

TEST(map_draw, nobody_waits_in_a_sweep_that_has_failed) {
    map_draw draw = two_maps();
    owner_queue owner(draw, 0, tiles_from(0), ignore);
    helper_queue helper(draw, 0, ignore);
    EXPECT_TRUE(helper.next());  // and the helper dies of an error
    draw.halt();
    EXPECT_EQ(owner.close().tiles, 0u);
}
