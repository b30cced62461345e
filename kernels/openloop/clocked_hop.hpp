// The clock-driven hopper's unit of work: from one event (take-off, landing, thrust on, thrust off)
// to the next, in scaled units. Source: models/openloop_hopper.md sections 2, 3 and 4.
#pragma once

#include "kernels/openloop/hopper_lane.hpp"
#include "kernels/openloop/stance.hpp"
#include "kernels/openloop/trace.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::openloop {

/// Which terms a kernel carries.
template <bool ForceGuard, bool AnyDamping>
struct terms {
    static constexpr bool has_force_guard = ForceGuard;  // take-off at zero ground force
    static constexpr bool has_any_damping = AnyDamping;  // else damping ratio < 1
};

/// Relative to the stride period: events closer than this to a clock edge come before it.
inline constexpr double tie_share = 1e-12;

/// Take-offs this slow under thrust > 1 are the end of chatter: the body is held on the ground
/// until the thrust ends, with an error below their speed (page, section 3.2). The faster bound
/// holds where the chatter would take more than about 1e5 flights, which no budget allows.
inline constexpr double hold_speed = 1e-9;
inline constexpr double slow_chatter_speed = 1e-7;
inline constexpr double most_chatter_flights = 1e5;

/// What happens next to a body on the ground.
template <class Real>
struct ground_event {
    mask_of<Real> leaves;
    Real time;
    Real height;  // at that time, or at the clock edge where it does not leave
    Real velocity;
};

/// Take-off or the next clock edge, whichever is first.
///
/// \param horizon  time to the clock edge and a little more, so that ties count as take-offs
template <class Terms, class Real>
HOPSCOTCH_DEVICE inline ground_event<Real> next_on_ground(const hopper_lane<Real>& lane,
                                                          const primal_of<Real>& horizon,
                                                          const mask_of<Real>& grounded) {
    constexpr bool any_damping = Terms::has_any_damping;
    const Real zero(0.0);
    const Real one(1.0);
    const Real force = active_thrust(lane);
    const auto spring = oscillator<any_damping, Real>::with(lane.damping);
    const solution<any_damping, Real> body{spring, lane.height, lane.velocity, force - one};
    // an equilibrium, or pushed up at once by the stance and down by the flight: stays
    const mask_of<Real> holds = (lane.height == zero) & (lane.velocity == zero) & (force >= one);
    const mask_of<Real> searching = grounded & !holds;
    crossing<Real> up = first_rise(body, horizon, searching);
    mask_of<Real> at_stop = up.found;
    if constexpr (Terms::has_force_guard) {
        // 1 - N obeys the same oscillator; N = force - y - 2 zeta y'
        const Real twice = Real(2.0) * lane.damping;
        const solution<any_damping, Real> pull{
            spring, fma(twice, lane.velocity, lane.height) - force,
            fma(twice, body.acceleration(), lane.velocity), -one};
        const mask_of<Real> at_once = searching & (pull.value > zero) & (lane.velocity > zero);
        const crossing<Real> released = first_rise(pull, horizon, searching & !at_once);
        const mask_of<Real> sooner = released.found & (!up.found | (released.time < up.time));
        at_stop = up.found & !sooner & !at_once;
        up.time = select(at_once, zero, select(sooner, released.time, up.time));
        up.found = up.found | released.found | at_once;
    }
    ground_event<Real> next{up.found, select(up.found, up.time, lane.until_edge), zero, zero};
    const value_and_slope<Real> there = body.at(next.time);
    // above the ground at the edge by rounding: rising bodies leave there
    const mask_of<Real> above = searching & !up.found & (there.value > zero);
    next.leaves = up.found | (above & (there.slope > zero));
    next.height = select(holds | at_stop | above, zero, there.value);
    next.velocity = select(holds, zero, there.slope);
    return next;
}

/// What happens next to a body in the air.
template <class Real>
struct air_event {
    mask_of<Real> lands;
    Real time;
    Real height;
    Real velocity;
    Real leg;
};

template <class Terms, class Real>
HOPSCOTCH_DEVICE inline air_event<Real> next_in_air(const hopper_lane<Real>& lane,
                                                    const primal_of<Real>& horizon,
                                                    const mask_of<Real>& airborne) {
    const Real zero(0.0);
    if constexpr (Terms::has_force_guard) {
        const Real relaxation = Real(0.5) / larger(lane.damping, Real(1e-300));
        const leg_flight<Real> flight{lane.height, lane.velocity, lane.leg, active_thrust(lane),
                                      relaxation};
        const touch_down<Real> contact = first_touch(flight, airborne);
        const mask_of<Real> lands = airborne & (primal(contact.time) <= horizon);
        const Real s = select(lands, contact.time, lane.until_edge);
        const Real leg = select(lane.leg < zero, flight.leg_at(s), zero);
        const Real height = fma(s, fma(s, Real(-0.5), lane.velocity), lane.height);
        return {lands, s, select(lands, contact.leg, height), lane.velocity - s,
                select(lands, contact.leg, leg)};
    } else {
        const mask_of<Real> lands = airborne & (primal(lane.flight_left) <= horizon);
        const Real s = select(lands, lane.flight_left, lane.until_edge);
        const Real left = lane.flight_left - s;
        const Real height = left * fma(left, Real(-0.5), lane.landing_speed);
        return {lands, s, select(lands, zero, height),
                select(lands, -lane.landing_speed, left - lane.landing_speed), zero};
    }
}

/// Take-offs that end chatter (page, section 3.2): held on the ground instead.
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> is_chatter(const hopper_lane<Real>& lane, const Real& height,
                                                 const Real& speed, const Real& until_edge) {
    const Real force = active_thrust(lane);
    const Real flights = until_edge * (force - Real(1.0));
    const mask_of<Real> too_many = (speed < Real(slow_chatter_speed)) &
                                   (flights > Real(2.0 * most_chatter_flights) * force * speed);
    return (force > Real(1.0)) & (height == Real(0.0)) & ((speed < Real(hold_speed)) | too_many);
}

/// A hopper that stays on the ground for a whole period and comes back to the same state is on its
/// cycle without hops: the flow contracts, so nothing will change.
///
/// \param edge  lanes at thrust activation
template <class Terms, class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> has_settled(hopper_lane<Real>& lane,
                                                  const mask_of<Real>& edge) {
    const Real zero(0.0);
    const Real one(1.0);
    const auto spring = oscillator<Terms::has_any_damping, Real>::with(lane.damping);
    const Real contraction = -expm1(-(spring.decay * (lane.on_time + lane.off_time)));
    const Real moved =
        abs(lane.height - lane.settled_height) + abs(lane.velocity - lane.settled_velocity);
    const Real size = one + abs(lane.height) + abs(lane.velocity);
    const mask_of<Real> rests =
        edge & (lane.settled > zero) & (lane.damping > zero) &
        (moved <= size * contraction * Real(64.0 * lane_traits<Real>::rounding));
    lane.settled_height = select(edge, lane.height, lane.settled_height);
    lane.settled_velocity = select(edge, lane.velocity, lane.settled_velocity);
    const mask_of<Real> on_ground = !(lane.airborne > zero);
    lane.settled = select(edge, select(on_ground, one, zero), lane.settled);
    return rests;
}

/// From the present state to the next event.
template <class Terms, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> advance(hopper_lane<Real>& lane, const mask_of<Real>& active,
                                               Watch& watch) {
    using plain = primal_of<Real>;
    const Real zero(0.0);
    const Real one(1.0);
    const hopper_lane<Real> was = lane;
    const Real force = active_thrust(lane);
    const plain tie = primal(lane.on_time + lane.off_time) * plain(tie_share);
    const plain horizon = primal(lane.until_edge) + tie;
    const mask_of<Real> airborne = active & (lane.airborne > zero);
    const mask_of<Real> grounded = active & !airborne;

    const air_event<Real> air = next_in_air<Terms>(lane, horizon, airborne);
    const ground_event<Real> ground = next_on_ground<Terms>(lane, horizon, grounded);
    const Real duration = select(airborne, air.time, ground.time);
    const Real until_edge = lane.until_edge - duration;
    const mask_of<Real> chatters =
        ground.leaves & is_chatter(lane, ground.height, ground.velocity, until_edge);
    const mask_of<Real> leaves = ground.leaves & !chatters;
    const mask_of<Real> edge = active & !air.lands & !ground.leaves;
    const mask_of<Real> thrust_ends = edge & (lane.thrust_on > zero);
    const mask_of<Real> thrust_begins = edge & !thrust_ends;

    const Real height = select(airborne, air.height, ground.height);
    const Real velocity = select(airborne, air.velocity, select(chatters, zero, ground.velocity));
    const Real w = lane.angular_frequency;
    const Real lifted = select(grounded, force * (height - lane.height), zero);
    lane.work = select(active, lane.work + lifted / (w * w), lane.work);
    lane.height = select(active, height, lane.height);
    lane.velocity = select(active, velocity, lane.velocity);
    lane.until_edge = select(active, until_edge, lane.until_edge);
    if constexpr (Terms::has_force_guard) {
        lane.leg = select(airborne, air.leg, select(leaves, height, lane.leg));
        lane.airborne = select(leaves, one, select(air.lands, zero, lane.airborne));
    } else {
        lane.flight_left = select(airborne, lane.flight_left - duration, lane.flight_left);
        lane.airborne = select(air.lands, zero, lane.airborne);
        launch(lane, leaves);
    }
    lane.hops = select(leaves, lane.hops + one, lane.hops);
    lane.settled = select(leaves, zero, lane.settled);
    lane.events = select(edge | leaves | air.lands, lane.events + one, lane.events);

    const mask_of<Real> returned = (thrust_begins & (lane.section == Real(strobe))) |
                                   (air.lands & (lane.section == Real(landing))) |
                                   (leaves & (lane.section == Real(takeoff)));
    lane.time = select(active, elapsed_time(lane), lane.time);
    lane.cycle_start = select(thrust_begins, lane.time, lane.cycle_start);
    const Real next_half = select(thrust_begins, lane.on_time, lane.off_time);
    if constexpr (Watch::is_active) {
        const char* name = air.lands       ? "landing"
                           : leaves        ? "take-off"
                           : thrust_begins ? "thrust on"
                           : thrust_ends   ? "thrust off"
                                           : "";
        hopper_lane<Real> after = lane;
        after.until_edge = edge ? next_half : lane.until_edge;
        after.thrust_on = edge ? (thrust_begins ? one : zero) : lane.thrust_on;
        if (active) report(was, after, duration, name, watch);
    }
    lane.until_edge = select(edge, next_half, lane.until_edge);
    lane.thrust_on = select(edge, select(thrust_begins, one, zero), lane.thrust_on);
    if (any(returned)) record_state(lane, returned);

    Real ended = zero;
    const mask_of<Real> waits = thrust_begins & !(lane.section == Real(strobe));
    if (any(waits)) {
        ended = select(has_settled<Terms>(lane, waits), code_of<Real>(outcome::no_hop), ended);
    }
    const Real sum = duration + lane.height + lane.velocity + lane.first_column;
    const mask_of<Real> finite = sum - sum == zero;
    ended = select(active & !finite, code_of<Real>(outcome::not_finite), ended);
    const mask_of<Real> completed = returned & finite;
    return {completed, ended};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::openloop
