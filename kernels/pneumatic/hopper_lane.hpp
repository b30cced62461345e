// One trajectory of the hopper with a pneumatic leg, and the beginnings of its arcs. Source:
// models/raibert_hopper.md section 3; Koditschek, Buehler 1991, (7), (8).
#pragma once

#include "kernels/contract/model.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

template <class Real>
struct hopper_lane {
    Real lift_height, stiffness, thrust, thrust_time, friction, gravity, flight_gravity, leg_factor;
    Real section;                  // index
    Real speed;                    // of the last touchdown
    Real bottom;                   // height of the last bottom
    Real length, depth, velocity;  // stance: chi, chi_l - chi, chi'
    Real spring;                   // eta2 while the leg extends
    Real extending;                // 1 in decompression
    Real fresh;                    // 1 at the beginning of an arc
    Real arc_time, arc_steps;
    Real was_cut;
    Real tolerance;  // of a step of the integrator
    Real owed;  // time from the section state to where `time` must begin: the fall from the apex
    Real time, events;
};

template <class Real>
HOPSCOTCH_DEVICE inline void begin_arc(hopper_lane<Real>& lane, const Real& extending,
                                       const mask_of<Real>& wanted) {
    const Real zero(0.0);
    lane.extending = select(wanted, extending, lane.extending);
    lane.fresh = select(wanted, Real(1.0), lane.fresh);
    lane.arc_time = select(wanted, zero, lane.arc_time);
    lane.arc_steps = select(wanted, zero, lane.arc_steps);
}
template <class Real>
HOPSCOTCH_DEVICE inline void touch_down(hopper_lane<Real>& lane, const mask_of<Real>& wanted) {
    const Real zero(0.0);
    lane.length = select(wanted, lane.lift_height, lane.length);
    lane.depth = select(wanted, zero, lane.depth);
    lane.velocity = select(wanted, -lane.speed, lane.velocity);
    begin_arc(lane, zero, wanted);
}
/// At the bottom, thrust about to begin; length and depth are set.
template <class Real>
HOPSCOTCH_DEVICE inline void reach_bottom(hopper_lane<Real>& lane, const mask_of<Real>& wanted) {
    lane.bottom = select(wanted, lane.length, lane.bottom);
    lane.velocity = select(wanted, Real(0.0), lane.velocity);
    lane.events = select(wanted, lane.events + Real(1.0), lane.events);
    begin_arc(lane, Real(1.0), wanted);
}

/// Reports an event that leaves height and, but for the leg's inertia, velocity as they are.
template <class Real, class Watch>
inline void report(Watch& watch, const char* name, const hopper_lane<Real>& lane, const char* left,
                   const char* entered, const Real& velocity, const Real& after_velocity) {
    const Real before[] = {lane.length, velocity};
    const Real after[] = {lane.length, after_velocity};
    watch.event(name, lane.time, left, entered, before, after,
                Real(0.5) * (velocity * velocity - after_velocity * after_velocity));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
