// A solution of a branch's equation as an orbit: its points, multipliers and events.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/corrector.hpp"

#include <vector>

namespace hopscotch {

orbit_on_branch describe(const branch_equation& equation, const curve_point& point);

/// All points of an orbit on a branch, [point][column].
std::vector<std::vector<double>> points_of(const branch_family& family, int period,
                                           const orbit_on_branch& orbit);

}  // namespace hopscotch
