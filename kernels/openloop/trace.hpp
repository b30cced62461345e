// What `trace` shows of a clock-driven hopper: its phases in the air and on the ground and its four
// events, in the user's units. Compiled only for a Watch that is active.
#pragma once

#include "kernels/contract/watch.hpp"
#include "kernels/openloop/hopper_lane.hpp"
#include "kernels/openloop/stance.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::openloop {

/// Height, velocity, clock phase and ground force of a lane.
template <class Real>
void write_trace(const hopper_lane<Real>& lane, Real* columns) {
    const Real w = lane.angular_frequency;
    columns[0] = lane.height / (w * w);
    columns[1] = lane.velocity / w;
    columns[2] = clock_phase(lane);
    columns[3] = ground_force(lane, lane.height, lane.velocity);
}

template <class Real>
const char* mode_name(const hopper_lane<Real>& lane) {
    if (lane.airborne > Real(0.0)) return "air";
    return lane.thrust_on > Real(0.0) ? "ground, thrust on" : "ground, thrust off";
}

/// Tells a Watch about the phase between two states of a lane, and about the event that ends it; an
/// empty name is no event.
template <class Real, class Watch>
void report(const hopper_lane<Real>& before, const hopper_lane<Real>& after, const Real& duration,
            const char* name, Watch& watch) {
    const Real w = before.angular_frequency;
    const auto sample = [&](const Real& seconds, Real* columns) {
        const Real s = seconds * w;
        hopper_lane<Real> there = before;
        there.until_edge = before.until_edge - s;
        if (before.airborne > Real(0.0)) {
            there.height = fma(s, fma(s, Real(-0.5), before.velocity), before.height);
            there.velocity = before.velocity - s;
        } else {
            const Real resting = active_thrust(before) - Real(1.0);
            const bool holds =
                before.height == Real(0.0) && before.velocity == Real(0.0) && resting >= Real(0.0);
            const auto spring = oscillator<true, Real>::with(before.damping);
            const auto body =
                solution<true, Real>{spring, before.height, before.velocity, resting}.at(s);
            there.height = holds ? before.height : body.value;
            there.velocity = holds ? before.velocity : body.slope;
        }
        write_trace(there, columns);
    };
    watch.phase(mode_name(before), before.time, duration / w, sample);
    if (*name == '\0') return;
    hopper_lane<Real> last = before;
    last.height = after.height;
    last.velocity = after.velocity;
    last.until_edge = before.until_edge - duration;
    Real at_end[4];
    Real entered[4];
    write_trace(last, at_end);
    write_trace(after, entered);
    watch.event(name, after.time, mode_name(before), mode_name(after), at_end, entered, Real(0.0));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::openloop
