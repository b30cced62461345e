// Greedy list scheduling over a heap of ranks.
#include "bench/rank_model.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>

namespace hopscotch::bench {

rank_model model_ranks(const std::vector<double>& tile_seconds, std::uint64_t n_tiles,
                       std::uint64_t n_ranks) {
    std::priority_queue<double, std::vector<double>, std::greater<>> free_at(
        std::greater<>{}, std::vector<double>(n_ranks, 0.0));
    double busy = 0.0;
    double end = 0.0;
    for (std::uint64_t tile = 0; tile < n_tiles; ++tile) {
        const double cost = tile_seconds[tile % tile_seconds.size()];
        const double done = free_at.top() + cost;
        free_at.pop();
        free_at.push(done);
        busy += cost;
        end = std::max(end, done);
    }
    return {end, 1.0 - busy / (end * static_cast<double>(n_ranks)),
            static_cast<double>(n_tiles) / end};
}

}  // namespace hopscotch::bench
