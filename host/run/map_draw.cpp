// The queue over the maps and tiles of a sweep.
#include "host/run/map_draw.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace hopscotch {

std::optional<std::uint64_t> map_draw::next(std::size_t map) {
    const std::uint64_t before = counters_->add(drawn(map), 1);
    if (before == 0 || before > n_tiles_) return std::nullopt;
    return before - 1;
}

std::uint64_t map_draw::n_left(std::size_t map) {
    const std::uint64_t now = counters_->read(drawn(map));
    return now == 0 || now > n_tiles_ ? 0 : n_tiles_ + 1 - now;
}

void map_draw::count(std::size_t map, bool is_help) {
    if (is_help) counters_->add(helped(map), 1);
    counters_->add(done(map), 1);
}

void map_draw::close(std::size_t map) {
    const std::uint64_t before = counters_->add(drawn(map), closed);
    if (before >= closed) return;  // whoever came first has counted
    counters_->add(last(map), before == 0 ? 1 : std::min(before, n_tiles_ + 1));
}

void map_draw::finish(std::size_t map) {
    close(map);
    const auto are_all_done = [&] {
        const std::uint64_t n_drawn = counters_->read(last(map));  // and 1
        return n_drawn > 0 && counters_->read(done(map)) + 1 >= n_drawn;
    };
    while (!are_all_done() && !is_halted()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

owner_queue::owner_queue(map_draw& draw, std::size_t map, std::vector<std::uint64_t> tiles,
                         progress_display show)
    : local_queue({}, std::move(show)), draw_(draw), map_(map), missing_(std::move(tiles)) {
    draw_.open(map_);
}

owner_queue::~owner_queue() { draw_.close(map_); }

std::optional<std::uint64_t> owner_queue::next() {
    while (const std::optional<std::uint64_t> tile = draw_.next(map_)) {
        if (std::binary_search(missing_.begin(), missing_.end(), *tile)) return tile;
        draw_.count(map_, false);
    }
    return std::nullopt;
}

void owner_queue::count(const run_tally& of_tile) {
    local_queue::count(of_tile);
    draw_.count(map_, false);
}

run_tally owner_queue::close() {
    draw_.finish(map_);
    run_tally all = local_queue::close();
    all.tiles += draw_.n_helped(map_);
    return all;
}

helper_queue::~helper_queue() {
    if (put_back_)
        draw_.count(map_, false);  // out of time: the owner finds that the tile is missing
}

std::optional<std::uint64_t> helper_queue::next() {
    if (put_back_) return std::exchange(put_back_, std::nullopt);
    return draw_.next(map_);
}

void helper_queue::count(const run_tally& of_tile) {
    local_queue::count(of_tile);
    draw_.count(map_, of_tile.cells > 0);
}

}  // namespace hopscotch
