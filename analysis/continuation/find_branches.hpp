// All branches of periodic orbits of a map over one variable: from sampled starts at some values of
// the variable, and by switching at flips and branch points. What `hopscotch branch` computes.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/follow.hpp"
#include "analysis/continuation/start_orbits.hpp"

#include <vector>

namespace hopscotch {

struct branch_study {
    branch_family family;
    std::vector<sampled_column> samples;  // of every column
    int most_period = 1;
    int doublings = 1;  // generations of doubled branches followed from flips
    int stations = 9;   // values of the variable at which orbits are searched
    int settling = 200;
    follow_limits limits;
};

/// \return  branches by the order they were found: small periods first, doubled ones after all
///          that were found from starts
/// \error   std::invalid_argument where the variable is a column that the map does not conserve
std::vector<branch> find_branches(const branch_study& study);

/// Columns that the map conserves, found at the first start whose return can be computed.
std::vector<int> conserved_columns_of(const map_point& map,
                                      const std::vector<sampled_column>& samples);

/// The family of a map over a variable: the columns that the map conserves are left out.
///
/// \param samples  of every column; their extent is the columns' scale
/// \error          std::invalid_argument as above
branch_family family_of(const map_point& map, const branch_variable& variable,
                        const std::vector<sampled_column>& samples);

}  // namespace hopscotch
