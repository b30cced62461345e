// Where a branch ends on which a multiplier grows without bound: at the edge of a gap, where the
// map has a square root, or where a leg collapses. Steps towards such an end lose digits (the
// distance is the square of what a step can resolve); its place follows from orbits further away.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace hopscotch {

/// One orbit on the way: its numbers (variable, states), and its largest multiplier.
struct approach {
    std::vector<double> numbers;
    double multiplier = 0.0;
};

struct singular_end {
    std::vector<double> numbers;  // at the end
    std::vector<double> errors;   // of each: how far extrapolations from fewer orbits differ
};

/// Polynomial extrapolation in u = |multiplier|^-q to u = 0. Next to a root sqrt(D) in the map, the
/// orbit is smooth in s = sqrt(D), and the multiplier goes as 1/s: q = 1. Where a leg collapses, a
/// runner's speed has q = 2/3. For each number the exponent and the orbits are taken whose
/// extrapolation has the smallest error.
///
/// \param way  orbits in their order, the last one next to the end
/// \return     none where the multiplier stays below 1000, or no extrapolation holds to 1e-8 of the
///             first number's size
std::optional<singular_end> find_singular_end(std::span<const approach> way);

}  // namespace hopscotch
