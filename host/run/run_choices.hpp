// What the user chooses about a run beside the scene: where, by what, for how long.
#pragma once

#include "host/store/map_run.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hopscotch {

struct run_choices {
    std::filesystem::path file;  // empty: the scene's
    std::string backend = "auto";
    int n_threads = 0;  // 0: as many as the machine has
    int n_at_once = 1;  // maps of a sweep that share these threads, side by side
    if_exists existing = if_exists::refuse;
    std::optional<double> walltime;  // seconds
    bool keeps_tiles = false;        // the map file refers to tile files
    bool is_quiet = false;
    shard part{};                                  // compute these tiles only, and pack nothing
    bool is_merge = false;                         // compute no missing tiles: all must be there
    std::vector<std::filesystem::path> adopted{};  // run directories whose tiles are taken over
};

/// Number of threads for a choice of 0 or more, of a process alone.
int threads_for(int wanted);

}  // namespace hopscotch
