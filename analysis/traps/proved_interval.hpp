// Trap intervals of one-dimensional return maps, proved: enclosures of the map over parts of the
// interval show that it is sent into itself. The search (analysis/labels/interval_trap.hpp) only
// samples and bisects.
#pragma once

#include "analysis/orbit/contraction.hpp"
#include "analysis/periodic/map_point.hpp"

#include <optional>

namespace hopscotch {

/// An interval that the map sends into itself: an orbit that enters it stays, where uncovered = 0;
/// else where the map is continuous on those parts. What else the enclosures show over all of it
/// says what the orbit tends to.
struct proved_interval {
    double lowest = 0.0;
    double highest = 0.0;
    bool is_monotone = false;  // the map rises on it: orbits tend to fixed points
    bool contracts = false;    // |slope| < 1: to the only one
    bool only_falls = false;   // f(x) <= x
    double uncovered = 0.0;    // total length of parts, each below 2^-42 of the point, that stayed
                               // undecided: a change of the order of events (a lossless point)
    int pieces = 0;            // enclosures it took
};

/// Proves as much of [lowest, highest] as it can: the ends move inward by what rounding asks for,
/// which at an unstable fixed point is some ulp over |slope| - 1.
///
/// \param map          a section of one column
/// \param most_pieces  enclosures to spend
/// \param why          set where nothing is returned
/// \return             nothing where the ends cannot be moved far enough (a thousandth of the
/// length),
///                     where an image certainly leaves, or where the pieces run out
std::optional<proved_interval> prove_interval_trap(const map_point& map, double lowest,
                                                   double highest,
                                                   contraction_verdict* why = nullptr,
                                                   int most_pieces = 4000);

}  // namespace hopscotch
