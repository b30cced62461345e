// Computes the maps of a sweep: one ordinary map file per point in one directory, all maps' tiles
// as one pool of work, and at the end an index over the maps with a table of what each of them
// shows. Used by the command `run` and by tests.
//
//     sweep.h5              the index (host/store/sweep_index.hpp)
//     sweep.h5.maps/        lock, map_000000.h5, map_000001.h5 ...; map_000002.h5.tiles/ while the
//                           map at that point is computed
#pragma once

#include "host/run/estimate.hpp"
#include "host/run/run_map.hpp"
#include "host/store/map_reader.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hopscotch {

/// The share of one basin (or of one way to end) among the decided cells of a map.
struct basin_fact {
    int value = 0;            // label, or another value of the layer; of an ending: outcome's code
    bool is_outcome = false;  // cells without a label, told apart by how they end
    std::string name;
    double share = 0.0;
    double error = 0.0;  // standard error
};

/// What the index' table says of one map; made by the analysis.
struct map_facts {
    std::vector<basin_fact> basins;
    double undecided = 0.0;         // share of all cells
    double entropy = 0.0;           // basin entropy
    double boundary_entropy = 0.0;  // of the boxes with more than one basin
};

/// The analysis' part in a sweep. `facts` may be empty: then the table is short.
struct sweep_hooks {
    std::function<run_hooks(const scene& map, const std::filesystem::path& file)> of_map;
    std::function<map_facts(const map_reader&)> facts;
};

/// One map, as the report and the summary tell of it.
struct swept_map {
    std::uint64_t point = 0;
    std::vector<double> values;  // of the sweep's axes
    bool is_there = false;
    std::string hash;
    double seconds = 0.0;  // that threads have spent on its tiles
    std::vector<attractor_row> attractors;
    std::vector<std::string> point_columns;
    map_facts facts;
};

struct sweep_report {
    std::filesystem::path file;       // the index
    std::filesystem::path directory;  // of the maps
    bool is_finished = false;
    bool is_part_done = false;  // every map of this shard is there
    std::vector<swept_map> maps;
    std::uint64_t n_missing = 0;   // maps that an interrupted run leaves
    std::uint64_t n_computed = 0;  // maps computed now
    std::uint64_t n_cells_per_map = 0;
    run_tally tally;
    double seconds = 0.0;
    double idle_at_end = 0.0;    // share of the ranks' time after they found nothing more to do
    std::uint64_t n_helped = 0;  // tiles computed by other ranks than their map's
    std::string hash;            // over the maps' hashes
    std::vector<std::string> notes;
};

/// The maps of a sweep (or of a shard: every N-th point) by all ranks of a team. Threads and ranks
/// draw maps from one queue; a thread or a rank that finds no further map helps with the tiles of
/// those that are left (a rank with those of the first pass, not with a second search's or a
/// refinement's). Where there are fewer maps than ranks, all ranks compute one map after the other
/// together. \error as run_map; finished maps and tiles always stay
sweep_report run_sweep(const scene& sweep, const run_choices& choices, const sweep_hooks& hooks,
                       team& ranks);
sweep_report run_sweep(const scene& sweep, const run_choices& choices, const sweep_hooks& hooks);

/// What the sweep will need: up to three of its maps are sampled.
run_estimate estimate_sweep(const scene& sweep, const run_choices& choices,
                            const sweep_hooks& hooks);

/// The folder of a sweep's maps.
std::filesystem::path sweep_directory_of(const std::filesystem::path& index);

}  // namespace hopscotch
