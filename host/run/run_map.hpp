// Computes a scene's map from beginning to end: plan the labels, compute the missing tiles in
// parallel, write them one by one, audit, pack. Reads like the data flow; used by the command `run`
// and by tests.
#pragma once

#include "host/run/kernel_in_use.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/progress.hpp"
#include "host/run/trap_gain.hpp"
#include "host/run/team.hpp"
#include "host/scene/scene.hpp"
#include "host/store/map_run.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace hopscotch {

struct run_choices {
    std::filesystem::path file;  // empty: the scene's
    std::string backend = "auto";
    int n_threads = 0;  // 0: as many as the machine has
    if_exists existing = if_exists::refuse;
    std::optional<double> walltime;  // seconds
    bool keeps_tiles = false;        // the map file refers to tile files
    bool is_quiet = false;
    shard part{};                                  // compute these tiles only, and pack nothing
    bool is_merge = false;                         // compute no missing tiles: all must be there
    std::vector<std::filesystem::path> adopted{};  // run directories whose tiles are taken over
};

/// The analysis' part in a run. Any may be empty: then cells have no labels, no audit is made, and
/// layers of the whole map are left "not computed".
struct run_hooks {
    /// The plan of a scene's labels; cells that a first pass has left open are searched once more.
    std::function<label_plan(const scene&, std::span<const std::uint64_t> searched)> plan;
    std::function<attribute_list(const scene&, const label_plan&, const map_run&)> audit;
    /// The kernel that computes the cells, instead of the one that `run_choices::backend` names.
    std::function<kernel_in_use(const scene&)> kernel;
    /// Fills layers that follow from the whole map, once all its tiles are there.
    std::function<void(const scene&, map_run&)> finish_layers;
};

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

/// \error scene_error (a question that is no map), store_error, device_error; finished tiles always
/// stay
run_report run_map(const scene& scene, const run_choices& choices, const run_hooks& hooks);

/// The same by all ranks of a team, to be called on each of them. Rank 0 owns the run directory,
/// audits and packs; all ranks search for attractors, which is deterministic, rather than wait for
/// one that does. Ranks other than 0 report nothing but how the run ended.
/// \error  also rank_failure, where another rank met one of the above
run_report run_map(const scene& scene, const run_choices& choices, const run_hooks& hooks,
                   team& ranks);

/// Computes tiles of a map that another process owns, as the queue gives them; the owner has opened
/// its run and kept its plan. Tiles that were there already are left as they are.
/// \param choices  the owner's but for `n_threads` (> 0) and `walltime`
/// \error  as run_map; device_error where this machine finds other attractors than the owner's
void help_with_map(const scene& scene, const run_choices& choices, const run_hooks& hooks,
                   tile_queue& queue);

/// Number of threads for a choice of 0 or more, of a process alone.
int threads_for(int wanted);

/// Outcomes that leave a cell without an answer.
bool is_undecided(const scene& scene, int outcome_code);

/// \error scene_error where `run` cannot answer the scene's question or precision
void check_is_map(const scene& scene);

}  // namespace hopscotch
