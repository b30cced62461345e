// Where a gap opens in the domain of a one-dimensional return map: the value at its minimum reaches
// the end of the states that have a next return (a runner's touchdown angle 0, below which it
// stumbles). Near that point the map is a rounded V, P ~ edge + sqrt(D), with D smooth.
#pragma once

#include "analysis/continuation/find_branches.hpp"

#include <optional>
#include <vector>

namespace hopscotch {

struct gap_opening {
    double variable = 0.0;
    double state = 0.0;  // where the gap opens, in the free column
};

/// Newton's method on D(variable) = (P - edge)^2 at the minimum of P, from the side without gap.
///
/// \param family  of one free column
/// \param from    a value of the variable at which no start between lowest and highest fails
/// \return        none where P has no inner minimum there or D does not fall towards the range's
/// end
std::optional<gap_opening> find_gap_opening(const branch_family& family, double from, double lowest,
                                            double highest, double edge = 0.0);

/// All gaps that open within the range of a study's variable, found between two of its stations (or
/// ends), of which one has more starts with a return than the other. The edge is 0, as of angles and
/// speeds of touchdown; every gap is checked to open there. None where more than one column is
/// free.
std::vector<gap_opening> find_gap_openings(const branch_study& study);

}  // namespace hopscotch
