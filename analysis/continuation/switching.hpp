// From a special point of one branch to the branch that crosses or begins there.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/follow.hpp"

#include <optional>
#include <vector>

namespace hopscotch {

/// The branch of twice the period that begins at a flip, followed away from it.
std::optional<branch> doubled_branch(const branch_family& family, int period,
                                     const special_point& flip, const follow_limits& limits);

/// Both ways along the branch that crosses at a branch point (none, one or two pieces).
std::vector<branch> crossing_branches(const branch_family& family, int period,
                                      const special_point& crossing, const follow_limits& limits);

}  // namespace hopscotch
