// Traps of one-dimensional return maps whose branches have a hump above a (possibly shifted)
// semi-stable point: the immediate basin between the unstable fixed point and the hump's right
// preimage of it, found numerically, and what attracts inside. Source: models/passive_hopper.md
// section 5, CPRR Fig. 8.
#pragma once

#include "analysis/attractors/attractor_kind.hpp"
#include "analysis/labels/return_map_samples.hpp"
#include "analysis/periodic/map_point.hpp"
#include "kernels/contract/info.hpp"

#include <optional>
#include <string>

namespace hopscotch {

/// An interval that the map sends into itself, with the attractor that it holds.
struct interval_trap {
    double lowest = 0.0;
    double highest = 0.0;
    attractor_kind kind = attractor_kind::fixed_point;
    int period = 1;                // 0 = aperiodic
    std::vector<double> points;    // of the cycle, rising; for chaos: hull of the attractor
    double multiplier = 0.0;       // of the cycle; for chaos the exponent per return
    bool is_proved = false;        // enclosures show that the map sends it into itself
    double unproved_length = 0.0;  // of parts about changes of the order of events

    /// How it is known, for the table of attractors.
    std::string evidence() const;
};

/// The trap on one branch, if there is one.
///
/// \param map     the return map
/// \param branch  its continuous piece, from the model
/// \param floor   the previous branch's end: how far left of `base` to look
/// \return        nothing where no orbit stays on the branch (or after a boundary crisis)
std::optional<interval_trap> find_interval_trap(const return_map_samples& map,
                                                const map_branch& branch, double floor);

/// Lets enclosures prove that the map sends the trap into itself. What is proved replaces it: the
/// ends move inward by some roundings. Without a proof (neutral ends, chatter, integrated flows)
/// it stays as it is.
void prove(const map_point& map, interval_trap& trap);

/// What a critical orbit settles on inside an invariant interval.
///
/// \param start   a point of the interval (the hump's top: its orbit finds every attractor with a
///                negative Schwarzian derivative)
void identify_attractor(const return_map_samples& map, double start, interval_trap& trap);

}  // namespace hopscotch
