// Follows a branch of periodic orbits in one direction by pseudo-arclength continuation, over folds
// and over borders where the order of events changes.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/corrector.hpp"

namespace hopscotch {

struct follow_limits {
    double step = 0.01;         // longest step, in scaled unknowns
    double least_step = 1e-12;  // shorter ones mean a wall: a border, an end
    int most_orbits = 4000;
    double farthest = 1e3;  // scaled unknowns beyond it end the branch
};

/// \param from  a solution with the tangent to start along
/// \return      orbits from `from` onward; `first` is left open
branch follow(const branch_equation& equation, const curve_point& from,
              const follow_limits& limits = {});

/// The branch through a solution, both ways.
branch follow_both_ways(const branch_equation& equation, const curve_point& from,
                        const follow_limits& limits = {});

}  // namespace hopscotch
