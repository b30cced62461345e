// Hops on a pneumatic leg without friction: one scalar root and closed forms. Source:
// models/raibert_hopper.md sections 3 and 5.
#pragma once

#include "kernels/pneumatic/frictionless_arc.hpp"
#include "kernels/pneumatic/hop.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

/// A compression, or a thrust with its decompression and flight; both where the section allows.
template <bool IsTimed, class Real>
HOPSCOTCH_DEVICE inline progress<Real> step_without_friction(hopper_lane<Real>& lane,
                                                             const mask_of<Real>& active) {
    const Real zero(0.0);
    unwatched watch;
    pay(lane, active);
    const mask_of<Real> compresses = active & !(lane.extending > zero);
    mask_of<Real> returned = hop_tiny(lane, compresses, watch);
    const mask_of<Real> falls = compresses & !returned;
    if (any(falls)) {
        const Real x =
            bottom_depth(lane.stiffness, lane.gravity * lane.lift_height, lane.speed, falls);
        lane.length = select(falls, lane.lift_height * exp(-x), lane.length);
        lane.depth = select(falls, -(lane.lift_height * expm1(-x)), lane.depth);
        if constexpr (IsTimed) {
            const Real duration =
                arc_duration(x, zero, lane.stiffness, lane.gravity, lane.lift_height);
            lane.time = select(falls, lane.time + duration, lane.time);
        }
        reach_bottom(lane, falls);
    }
    const mask_of<Real> at_bottom = falls & (lane.section == Real(2.0));
    const mask_of<Real> pushes = active & !returned & !at_bottom;
    const auto end = push_off(lane, pushes, watch);
    const Real log_depth = logarithmic_depth(lane);
    const Real square = liftoff_square(lane, log_depth);
    const mask_of<Real> lifts =
        pushes & !end.crashes & (end.cut | ((square > zero) & (lane.thrust > lane.gravity)));
    if constexpr (IsTimed) {
        const Real duration = arc_duration(log_depth, lane.velocity * lane.velocity, lane.spring,
                                           lane.gravity, lane.lift_height);
        lane.time = select(lifts & !end.cut, lane.time + duration, lane.time);
    }
    const Real speed = select(end.cut, lane.velocity, sqrt(select(lifts, square, Real(1.0))));
    Real ended = select(pushes & !lifts, code_of<Real>(outcome::no_liftoff), zero);
    ended = select(pushes & end.crashes, code_of<Real>(outcome::crash), ended);
    const mask_of<Real> lost = pushes & !end.crashes & !(square == square);
    ended = select(lost, code_of<Real>(outcome::not_finite), ended);
    returned = returned | at_bottom | fly(lane, speed, lifts & !lost, watch);
    return {returned, ended};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
