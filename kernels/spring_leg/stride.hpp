// What both stance models of the spring-mass runner share: the lane, and the flight from lift-off
// to the next touchdown with its failures. Units: leg length and touchdown speed, which every
// stride conserves. Source: models/slip.md sections 2-5.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/elementary/elementary.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// One runner. At a section: the touchdown with velocity angle `angle` below the horizontal.
template <class Real>
struct runner {
    Real speed, time_unit;    // v and eta0 / v
    Real leg, height_unit;    // eta0 and v^2 / g
    Real gravity, stiffness;  // gt = g eta0 / v^2; kt or ct
    Real beta, beta_sin, beta_cos;
    Real angle;
    Real at_apex;  // 1 where returns are counted at the apex
    Real sweep;    // of the last stance
    Real time, events;

    // stance under gravity, in Cartesian coordinates about the foothold
    Real x, y, x_rate, y_rate, length;
    Real in_stance;  // 1 while under way
    Real elapsed;    // since touchdown
    Real untouched;  // 1 in the first step of a stance: the lift-off guard starts at zero
    Real tolerance;  // of a step of the integrator
};

/// The body at lift-off.
template <class Real>
struct lift_off {
    Real forward, upward;  // velocity over touchdown speed
    Real rise;             // height above that of touchdown, over the leg length
};

/// A completed stride and why it failed, if it did.
template <class Real>
struct stride_end {
    Real angle;
    Real flight;  // duration
    Real ended;
};

/// Flight from lift-off to the next touchdown.
///
/// \return angle and duration; ended = stumble where the height of touchdown is not met from above,
///         else reverse where the body arrives with no forward velocity, else 0
/// D = (vertical speed at touchdown)^2 is taken from the lift-off data; atan2 keeps all digits next
/// to angle 0 and holds the speed at 1 (page, section 4).
template <class Real>
HOPSCOTCH_DEVICE inline stride_end<Real> fly(const lift_off<Real>& from, const Real& gravity) {
    const Real zero(0.0);
    const Real two(2.0);
    const Real fall = fma(two * gravity, from.rise, from.upward * from.upward);
    const mask_of<Real> stumbles = (fall < zero) | ((from.rise < zero) & (from.upward <= zero));
    const Real downward = sqrt(select(stumbles, zero, fall));
    const mask_of<Real> descends = from.upward < zero;
    const Real flight = select(descends, two * from.rise / (downward - from.upward),
                               (downward + from.upward) / gravity);
    const mask_of<Real> reverses = from.forward <= zero;
    return {atan2(downward, from.forward), flight,
            select(stumbles, code_of<Real>(outcome::stumble),
                   select(reverses, code_of<Real>(outcome::reverse), zero))};
}

/// Books a stride that reached lift-off: the new touchdown, or why there is none. Where a stride
/// fails the state stays what it was, except that of a reversal.
template <class Real>
HOPSCOTCH_DEVICE inline Real book_flight(runner<Real>& lane, const lift_off<Real>& from,
                                         const mask_of<Real>& leaves) {
    const Real zero(0.0);
    const stride_end<Real> next = fly(from, lane.gravity);
    const mask_of<Real> lands = leaves & !(next.ended == code_of<Real>(outcome::stumble));
    lane.angle = select(lands, next.angle, lane.angle);
    lane.time = select(lands, fma(next.flight, lane.time_unit, lane.time), lane.time);
    lane.events = select(lands, lane.events + Real(2.0),
                         select(leaves, lane.events + Real(1.0), lane.events));
    return select(leaves, next.ended, zero);
}

/// Time from the apex to the touchdown that the lane stands at.
template <class Real>
HOPSCOTCH_DEVICE inline Real descent(const runner<Real>& lane) {
    const Real fall = (sin(lane.angle) / lane.gravity) * lane.time_unit;
    return select(lane.at_apex > Real(0.0), fall, Real(0.0));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
