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

/// The present state moved to its next event: take-off, landing, or an edge of the clock.
template <class Real>
struct next_event {
    Real duration;
    Real height;
    Real velocity;
    Real leg;
    mask_of<Real> lands;
    mask_of<Real> leaves;
    mask_of<Real> held;  // on the ground, at the end of chatter
};

/// Takes the lanes that move to their event and books it.
template <class Terms, bool InAir, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> take_event(hopper_lane<Real>& lane,
                                                  const next_event<Real>& next,
                                                  const mask_of<Real>& moves, Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const hopper_lane<Real> was = lane;
    const mask_of<Real> edge = moves & !next.lands & !next.leaves & !next.held;
    const mask_of<Real> thrust_ends = edge & (lane.thrust_on > zero);
    const mask_of<Real> thrust_begins = edge & !thrust_ends;

    if constexpr (!InAir) {
        const Real w = lane.angular_frequency;
        const Real lifted = active_thrust(lane) * (next.height - lane.height);
        lane.work = select(moves, lane.work + lifted / (w * w), lane.work);
    }
    lane.height = select(moves, next.height, lane.height);
    lane.velocity = select(moves, next.velocity, lane.velocity);
    lane.until_edge = select(moves, lane.until_edge - next.duration, lane.until_edge);
    if constexpr (InAir) {
        lane.airborne = select(next.lands, zero, lane.airborne);
        if constexpr (Terms::has_force_guard) {
            lane.leg = select(moves, next.leg, lane.leg);
        } else {
            lane.flight_left = select(moves, lane.flight_left - next.duration, lane.flight_left);
        }
    } else {
        if constexpr (Terms::has_force_guard) {
            lane.leg = select(next.leaves, next.height, lane.leg);
            lane.airborne = select(next.leaves, one, lane.airborne);
        } else {
            launch(lane, next.leaves);
        }
        lane.hops = select(next.leaves, lane.hops + one, lane.hops);
        lane.settled = select(next.leaves, zero, lane.settled);
    }
    lane.events = select(edge | next.leaves | next.lands, lane.events + one, lane.events);

    const mask_of<Real> returned = (thrust_begins & (lane.section == Real(strobe))) |
                                   (next.lands & (lane.section == Real(landing))) |
                                   (next.leaves & (lane.section == Real(takeoff)));
    lane.time = select(moves, elapsed_time(lane), lane.time);
    lane.cycle_start = select(thrust_begins, lane.time, lane.cycle_start);
    const Real next_half = select(thrust_begins, lane.on_time, lane.off_time);
    if constexpr (Watch::is_active) {
        const char* name = next.lands      ? "landing"
                           : next.leaves   ? "take-off"
                           : thrust_begins ? "thrust on"
                           : thrust_ends   ? "thrust off"
                                           : "";
        hopper_lane<Real> after = lane;
        after.until_edge = edge ? next_half : lane.until_edge;
        after.thrust_on = edge ? (thrust_begins ? one : zero) : lane.thrust_on;
        if (moves) report(was, after, next.duration, name, watch);
    }
    lane.until_edge = select(edge, next_half, lane.until_edge);
    lane.thrust_on = select(edge, select(thrust_begins, one, zero), lane.thrust_on);
    if (any(returned)) record_state(lane, returned);

    Real ended = zero;
    const mask_of<Real> waits = thrust_begins & !(lane.section == Real(strobe));
    if (any(waits)) {
        ended = select(has_settled<Terms>(lane, waits), code_of<Real>(outcome::no_hop), ended);
    }
    const Real sum = next.duration + lane.height + lane.velocity + lane.first_column;
    const mask_of<Real> finite = sum - sum == zero;
    ended = select(moves & !finite, code_of<Real>(outcome::not_finite), ended);
    const mask_of<Real> completed = returned & finite;
    return {completed, ended};
}

/// Time to the clock's edge and a little more: events closer to it come before it.
template <class Real>
HOPSCOTCH_DEVICE inline primal_of<Real> time_to_edge(const hopper_lane<Real>& lane) {
    const primal_of<Real> tie = primal(lane.on_time + lane.off_time) * primal_of<Real>(tie_share);
    return primal(lane.until_edge) + tie;
}

/// The next event of lanes in the air.
template <class Terms, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> fly(hopper_lane<Real>& lane, const mask_of<Real>& airborne,
                                           Watch& watch) {
    const air_event<Real> air = next_in_air<Terms>(lane, time_to_edge(lane), airborne);
    const mask_of<Real> none = airborne & !airborne;
    return take_event<Terms, true>(
        lane, {air.time, air.height, air.velocity, air.leg, air.lands, none, none}, airborne,
        watch);
}

/// The next event of lanes on the ground.
template <class Terms, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> stand(hopper_lane<Real>& lane, const mask_of<Real>& grounded,
                                             Watch& watch) {
    const ground_event<Real> ground = next_on_ground<Terms>(lane, time_to_edge(lane), grounded);
    const mask_of<Real> chatters = ground.leaves & is_chatter(lane, ground.height, ground.velocity,
                                                              lane.until_edge - ground.time);
    const mask_of<Real> none = grounded & !grounded;
    const mask_of<Real> leaves = ground.leaves & !chatters;
    const Real velocity = select(chatters, Real(0.0), ground.velocity);
    return take_event<Terms, false>(
        lane, {ground.time, ground.height, velocity, Real(0.0), none, leaves, chatters}, grounded,
        watch);
}

/// The next events up to one on the ground: a stance costs ten times what a flight does, so no lane
/// is to sit one out.
template <class Terms, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> advance(hopper_lane<Real>& lane, const mask_of<Real>& active,
                                               Watch& watch) {
    const Real zero(0.0);
    constexpr int most_flights = Terms::has_force_guard ? 1 : 2;  // an edge, and the landing
    const mask_of<Real> none = active & !active;
    progress<Real> done{none, zero};
    mask_of<Real> goes_on = active;
    for (int i = 0; i < most_flights; ++i) {
        const mask_of<Real> airborne = goes_on & (lane.airborne > zero);
        if (!any(airborne)) break;
        const progress<Real> flown = fly<Terms>(lane, airborne, watch);
        done.returned = done.returned | flown.returned;
        done.ended = select(airborne, flown.ended, done.ended);
        goes_on = goes_on & !flown.returned & (done.ended == zero);
    }
    const mask_of<Real> grounded = goes_on & !(lane.airborne > zero);
    if (!any(grounded)) return done;
    const progress<Real> stood = stand<Terms>(lane, grounded, watch);
    done.returned = done.returned | stood.returned;
    done.ended = select(grounded, stood.ended, done.ended);
    return done;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::openloop
