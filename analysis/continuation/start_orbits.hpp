// Periodic orbits at one value of the variable, by Newton's method from a grid of starts and from
// where these have settled: where branches begin to be followed.
#pragma once

#include "analysis/continuation/branch_equation.hpp"
#include "analysis/periodic/periodic_orbit.hpp"

#include <vector>

namespace hopscotch {

/// Starts along one column, at cell centres; a single one at the middle.
struct sampled_column {
    double lowest = 0.0;
    double highest = 0.0;
    int n_samples = 1;

    double sample(int i) const { return lowest + (highest - lowest) * (i + 0.5) / n_samples; }
};

/// Every combination of the columns' samples, [start][column].
std::vector<double> grid_of_starts(const std::vector<sampled_column>& columns);

/// Whether two orbits are the same, whatever point each is listed from.
bool is_same_orbit(const map_point& map, const periodic_orbit& a, const periodic_orbit& b,
                   std::span<const double> scale);

/// All orbits of periods 1 ... most_period that are found from the starts, by period.
///
/// \param settling  returns after which the starts' orbits are tried as guesses too
std::vector<periodic_orbit> start_orbits(const branch_family& family, double variable,
                                         const std::vector<sampled_column>& columns,
                                         int most_period, int settling);

}  // namespace hopscotch
