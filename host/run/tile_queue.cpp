// The queue of one process.
#include "host/run/tile_queue.hpp"

#include <utility>

namespace hopscotch {

local_queue::local_queue(std::vector<std::uint64_t> tiles, progress_display show)
    : tiles_(std::move(tiles)), show_(std::move(show)) {}

std::optional<std::uint64_t> local_queue::next() {
    if (next_ == tiles_.size()) return std::nullopt;
    return tiles_[next_++];
}

void local_queue::count(const run_tally& of_tile) {
    total_ += of_tile;
    show_(total_);
}

void local_queue::halt() { next_ = tiles_.size(); }

run_tally local_queue::close() { return total_; }

}  // namespace hopscotch
