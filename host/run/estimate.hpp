// What a run will need, before it is begun: cells, bytes, memory, and the time as a small random
// sample of its cells suggests. The answer of `run --dry-run`.
#pragma once

#include "host/run/run_map.hpp"

namespace hopscotch {

struct run_estimate {
    std::string backend;
    int n_threads = 1;
    std::uint64_t n_maps = 1;  // of a sweep; the numbers are for all of them
    std::uint64_t n_cells = 0;
    std::uint64_t n_tiles = 0;
    std::vector<std::uint64_t> tile;
    std::uint64_t bytes = 0;   // of all layers, before compression
    std::uint64_t memory = 0;  // of tiles in flight, upper bound
    std::uint64_t n_sampled = 0;
    double seconds = 0.0;    // for the whole map
    double undecided = 0.0;  // share of the sample
};

/// Computes up to a few thousand cells, at most about a second.
run_estimate estimate(const scene& scene, const run_choices& choices, const run_hooks& hooks);

/// `n` different random cells of a map (all of them where there are no more), rising; the same for
/// the same seed on every machine.
std::vector<std::uint64_t> sample_cells(std::uint64_t n_cells, std::uint64_t n, std::uint64_t seed);

}  // namespace hopscotch
