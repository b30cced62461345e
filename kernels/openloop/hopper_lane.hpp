// One trajectory of the clock-driven hopper, in scaled units (Y = y w^2, V = v w, T = t w), and
// what is read from it. Source: models/openloop_hopper.md sections 1-4.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/openloop/leg.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::openloop {

enum section_index { strobe, landing, takeoff };

template <class Real>
struct hopper_lane {
    // parameters
    Real angular_frequency;  // w
    Real damping;
    Real thrust;   // over weight
    Real on_time;  // scaled durations of the clock's two halves
    Real off_time;
    Real thrust_seconds;
    Real period_seconds;
    Real section;  // where returns are counted

    // state
    Real height;
    Real velocity;
    Real leg;            // end of the leg; force guard only
    Real airborne;       // 1 in the air
    Real flight_left;    // time to landing in the air; length guard only
    Real landing_speed;  // with flight_left: V = flight_left - landing_speed
    Real thrust_on;      // 1 in the clock's first half
    Real until_edge;     // time to the next clock edge

    // the last section state, in the section's own units
    Real first_column;
    Real second_column;
    // the last stroboscopic state, to see that a hopper on the ground has come to its cycle
    Real settled_height;
    Real settled_velocity;
    Real settled;  // 1 while on the ground ever since

    Real cycle_start;  // seconds; of the present clock period
    Real time;         // seconds
    Real events;
    Real hops;
    Real work;  // s^2
};

template <class Real>
HOPSCOTCH_DEVICE inline Real active_thrust(const hopper_lane<Real>& lane) {
    return select(lane.thrust_on > Real(0.0), lane.thrust, Real(0.0));
}

/// Time since the last thrust activation, in seconds, in [0, period).
template <class Real>
HOPSCOTCH_DEVICE inline Real clock_phase(const hopper_lane<Real>& lane) {
    const Real end = select(lane.thrust_on > Real(0.0), lane.thrust_seconds, lane.period_seconds);
    const Real sum = end - lane.until_edge / lane.angular_frequency;
    const Real below_zero = select(sum < Real(0.0), Real(primal(sum)), Real(0.0));  // by rounding
    const Real phase = sum - below_zero;
    return select(phase < lane.period_seconds, phase, phase - lane.period_seconds);
}

/// Seconds since the orbit's start: whole periods and the present clock phase, so that nothing adds
/// up.
template <class Real>
HOPSCOTCH_DEVICE inline Real elapsed_time(const hopper_lane<Real>& lane) {
    const Real end = select(lane.thrust_on > Real(0.0), lane.thrust_seconds, lane.period_seconds);
    return lane.cycle_start + (end - lane.until_edge / lane.angular_frequency);
}

/// The ground force over the weight; 0 in the air.
template <class Real>
HOPSCOTCH_DEVICE inline Real ground_force(const hopper_lane<Real>& lane, const Real& height,
                                          const Real& velocity) {
    const Real force = active_thrust(lane) - fma(Real(2.0) * lane.damping, velocity, height);
    return select(lane.airborne > Real(0.0), Real(0.0), force);
}

/// Puts the lane's present state on its section's columns.
template <class Real>
HOPSCOTCH_DEVICE inline void record_state(hopper_lane<Real>& lane, const mask_of<Real>& where) {
    const Real w = lane.angular_frequency;
    const mask_of<Real> is_strobe = lane.section == Real(strobe);
    const Real velocity = lane.velocity / w;
    const Real first = select(is_strobe, lane.height / (w * w), clock_phase(lane));
    lane.first_column = select(where, first, lane.first_column);
    lane.second_column = select(where, velocity, lane.second_column);
}

/// Sends the body into the air from where it is.
template <class Real>
HOPSCOTCH_DEVICE inline void launch(hopper_lane<Real>& lane, const mask_of<Real>& where) {
    const mask_of<Real> from_ground = lane.height == Real(0.0);
    const Real speed = select(from_ground, lane.velocity,
                              sqrt(fma(lane.velocity, lane.velocity, Real(2.0) * lane.height)));
    const Real left =
        select(from_ground, lane.velocity + lane.velocity, fall_time(lane.height, lane.velocity));
    lane.landing_speed = select(where, speed, lane.landing_speed);
    lane.flight_left = select(where, left, lane.flight_left);
    lane.airborne = select(where, Real(1.0), lane.airborne);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::openloop
