// How the cells of one map get their labels: made by the analysis of attractors before a map is
// computed, handed to the kernels by the scheduler. Plain data.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/state_cover.hpp"
#include "kernels/ensemble/request.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// A chaotic set at one parameter point: orbits that no trap has caught when their returns are
/// spent belong to it where their last state lies on it.
struct chaotic_set {
    std::size_t point = 0;  // parameter point
    std::int16_t label = 0;
    state_cover cover;
};

/// Where an attractor lies at one parameter point, if its trap there does not tell.
struct placed_attractor {
    std::size_t point = 0;  // parameter point
    std::int16_t label = 0;
    std::vector<double> points;  // [period][column]
};

struct label_plan {
    decision decided_by = decision::returns;
    std::int16_t died_label = 0;  // of orbits that end by `stuck` or `rest`

    /// The axes of the scene (by position, rising) on whose cells the traps depend: its parameter
    /// axes and the columns that the flow conserves, or fewer. Empty: one set of traps serves the
    /// whole map.
    std::vector<std::size_t> point_axes;
    int n_traps = 0;  // per parameter point
    std::vector<trap_interval>
        traps;  // [parameter point][n_traps], points in C order over point_axes
    std::vector<placed_attractor> placed;    // of the intervals, by rising parameter point
    int n_ellipsoids = 0;                    // per parameter point
    std::vector<trap_ellipsoid> ellipsoids;  // [parameter point][n_ellipsoids]
    std::vector<chaotic_set> chaotic;        // by rising parameter point

    /// The cells (rising) that were left without a label by a first pass and searched once more for
    /// attractors; part of what the plan depends on.
    std::vector<std::uint64_t> searched;

    /// For the question one_sided: [parameter point][n_immediate], the immediate one-sided basins.
    int n_immediate = 0;
    std::vector<trap_interval> immediate;

    /// For Lyapunov exponents: columns (rising) of the section that returns end on which every
    /// return conserves.
    std::vector<int> conserved;

    std::vector<attractor_row> unstable;     // periodic orbits met by the search, label 0
    std::vector<attractor_row> attractors;   // shares are filled in after the run
    std::vector<std::string> point_columns;  // names of the columns of attractor_row::points

    /// Set where almost every cell is a parameter point of its own: the plan of one cell's point,
    /// made when it is needed (its point_axes are empty). Labels then mean the same at every point.
    std::function<label_plan(std::span<const std::uint64_t> coordinates)> of_cell;

    /// Label of an orbit that has spent its returns uncaught; 0 where its state is on no chaotic
    /// set.
    std::int16_t chaotic_label(std::size_t point, std::span<const double> state) const;
};

}  // namespace hopscotch
