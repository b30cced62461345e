// What a run tells at its end.
#pragma once

#include "host/run/progress.hpp"
#include "host/run/trap_gain.hpp"
#include "host/store/map_run.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

/// What a run has done, also where it was interrupted.
struct run_report {
    std::filesystem::path file;
    std::string backend;
    std::string device_failure;  // of a GPU that was lost on the way; empty: none
    bool is_finished = false;
    bool is_part_done = false;  // all tiles of the shard are there
    std::uint64_t n_cells = 0;
    std::uint64_t n_tiles = 0;    // of the shard, if the run is one
    std::uint64_t n_missing = 0;  // tiles that an interrupted run leaves
    run_tally tally;              // of the cells computed now
    double seconds = 0.0;         // spent on tiles
    int n_ranks = 1;
    int n_threads = 1;         // of all ranks
    double idle_at_end = 0.0;  // share of the ranks' time after their queue was dry
    std::vector<attractor_row> attractors;
    std::uint64_t n_inherited = 0;  // cells that refinement has not computed
    value_counts labels;
    value_counts motions;
    value_counts outcomes;
    trap_gain gain;  // of the whole map
    std::string hash;
    attribute_list audit;
    std::vector<std::string> notes;
};

}  // namespace hopscotch
