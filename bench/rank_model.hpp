// A cluster on paper: ranks that draw tiles of measured cost from one counter. Says what a job of a
// thousand ranks would do, which no bench here can run.
#pragma once

#include <cstdint>
#include <vector>

namespace hopscotch::bench {

struct rank_model {
    double seconds = 0.0;     // from the first tile drawn to the last one finished
    double idle_share = 0.0;  // of all ranks' time, after the counter has run dry
    double tiles_per_second = 0.0;
};

/// Every rank draws the next tile as soon as it is free; drawing costs nothing.
///
/// \param tile_seconds  cost of consecutive tiles, repeated as often as needed: neighbours that are
///                      costly together stay together
rank_model model_ranks(const std::vector<double>& tile_seconds, std::uint64_t n_tiles,
                       std::uint64_t n_ranks);

}  // namespace hopscotch::bench
