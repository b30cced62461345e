// How the cells of one map get their labels: made by the analysis of attractors before a map is
// computed, handed to the kernels by the scheduler. Plain data.
#pragma once

#include "host/map/layout.hpp"
#include "kernels/ensemble/request.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hopscotch {

struct label_plan {
    decision decided_by = decision::returns;
    std::int16_t died_label = 0;  // of orbits that end by `stuck` or `rest`

    /// The axes of the scene (by position, rising) on whose cells the traps depend: its parameter
    /// axes, or fewer. Empty: one set of traps serves the whole map.
    std::vector<std::size_t> point_axes;
    int n_traps = 0;  // per parameter point
    std::vector<trap_interval>
        traps;  // [parameter point][n_traps], points in C order over point_axes

    /// For the question one_sided: [parameter point][n_immediate], the immediate one-sided basins.
    int n_immediate = 0;
    std::vector<trap_interval> immediate;

    std::vector<attractor_row> attractors;   // shares are filled in after the run
    std::vector<std::string> point_columns;  // names of the columns of attractor_row::points
};

}  // namespace hopscotch
