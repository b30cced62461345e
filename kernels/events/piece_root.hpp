// The guaranteed first root of a gap function on a piece where its curvature keeps one sign.
// Splitting a flight at its inflections and asking piece by piece misses no contact: two crossings
// in one piece, grazing and launches from the ground are all decided by signs at known points.
#pragma once

#include "kernels/events/bracketed_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class Real>
struct found_root {
    mask_of<Real> found;
    Real time;
};

/// First time in (from, to] at which the gap falls through zero.
///
/// \param flow    offers gap(t), gap_rate(t), gap_curvature(t)
/// \param convex  lanes whose gap is convex on the piece (the others: concave)
/// \param guess   where Newton's method starts on concave pieces
/// \param wanted  lanes that are still searching; gap(from) >= 0 there
/// \return        found and the time, lane-wise
/// \error         none; touching counts as contact
/// On a concave piece gap >= 0 on the left leaves exactly one root, if gap(to) <= 0. On a convex
/// piece the minimum decides; its place is the only root of the gap rate.
template <class Real, class Flow>
HOPSCOTCH_DEVICE inline found_root<Real> first_root_on_piece(const Flow& flow, Real from, Real to,
                                                             mask_of<Real> convex, Real guess,
                                                             mask_of<Real> wanted) {
    const Real zero(0.0);
    const mask_of<Real> bowl = wanted & convex & (flow.gap_rate(from) < zero);
    Real lowest = to;  // on a concave piece the right end, on a convex one the minimum
    const mask_of<Real> has_minimum = bowl & (flow.gap_rate(to) > zero);
    if (any(has_minimum)) {
        const auto rate = [&](const Real& t) {
            return value_and_slope<Real>{flow.gap_rate(t), flow.gap_curvature(t)};
        };
        const Real minimum =
            bracketed_root<Real>(rate, {from, to}, (from + to) * Real(0.5), has_minimum);
        lowest = select(has_minimum, minimum, to);
    }
    const mask_of<Real> found = (bowl | (wanted & !convex)) & (flow.gap(lowest) <= zero);
    Real time = lowest;
    if (any(found)) {
        const auto fallen = [&](const Real& t) {
            return value_and_slope<Real>{-flow.gap(t), -flow.gap_rate(t)};
        };
        const Real start = select(convex, (from + lowest) * Real(0.5), guess);
        time = bracketed_root<Real>(fallen, {from, lowest}, start, found);
    }
    return {found, time};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
