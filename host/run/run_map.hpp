// Computes a scene's map from beginning to end: plan the labels, compute the missing tiles in
// parallel, write them one by one, audit, pack. Reads like the data flow; used by the command `run`
// and by tests.
#pragma once

#include "host/run/kernel_in_use.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/run_choices.hpp"
#include "host/run/run_report.hpp"
#include "host/run/team.hpp"
#include "host/scene/scene.hpp"
#include "host/store/map_run.hpp"

#include <functional>

namespace hopscotch {

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

/// Outcomes that leave a cell without an answer.
bool is_undecided(const scene& scene, int outcome_code);

/// \error scene_error where `run` cannot answer the scene's question or precision
void check_is_map(const scene& scene);

}  // namespace hopscotch
