// What traps save: returns that labelled orbits took until they were decided, against the budget
// that they would have run for without traps. And the shares of basins, from a sample of a scene's
// cells.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"
#include "host/store/map_run.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace hopscotch {

struct trap_gain {
    std::uint64_t n_labelled = 0;  // cells with a label of their own
    double returns = 0.0;          // completed by their orbits, in all
    double budget = 0.0;           // returns that one orbit may take

    double mean() const { return n_labelled == 0 ? 0.0 : returns / double(n_labelled); }
    /// How many times fewer returns; an orbit that starts in a trap counts as one return.
    double factor() const { return mean() > 1.0 ? budget / mean() : budget; }
};

/// Of a map whose tiles are all there; n_labelled = 0 where it has no labels or no layer `returns`.
/// \error store_error
trap_gain gain_of(const scene& scene, const map_run& run);

/// Cells of a scene that were labelled without computing its map.
struct basin_sample {
    std::uint64_t n_cells = 0;
    std::map<int, std::uint64_t> labels;  // cells per label; 0: none
    trap_gain gain;
};

/// Up to `n` random cells, the same for the same scene on every machine.
/// \error device_error
basin_sample sample_basins(const scene& scene, const label_plan& plan, std::uint64_t n = 4096);

/// "16.4 returns per labelled orbit of a budget of 2000: 122 times fewer".
std::string text_of(const trap_gain& gain);

}  // namespace hopscotch
