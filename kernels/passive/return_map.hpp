// One flight of the passive hopper and what its landing leads to: a bounce, sustained contact with
// the next lift-off, or rest. `step` is the unit of work of the ensemble loop. Source:
// models/passive_hopper.md sections 2-5; CPRR sections 3-6.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/passive/contact.hpp"
#include "kernels/passive/hopper_lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// Terms a scene switches off cost nothing: each variant is compiled on its own.
struct plastic_untimed {  // restitution 0, no damping, nobody asks for times
    static constexpr bool is_damped = false, has_rebound = false, is_timed = false;
};
struct plastic {
    static constexpr bool is_damped = false, has_rebound = false, is_timed = true;
};
struct elastic {  // restitution in (0, 1], no damping
    static constexpr bool is_damped = false, has_rebound = true, is_timed = true;
};
struct damped {  // damping > 0, any restitution
    static constexpr bool is_damped = true, has_rebound = true, is_timed = true;
};

/// Rebounds slower than this (gap rate), with the spring pressing the foot down, are the end of
/// chatter: the speed they would still take from the next lift-off is of its third power (page,
/// section 6). 1.5e-9 in double.
template <class Real>
inline constexpr double chatter_speed = 0.1 * lane_traits<Real>::root_rounding;

/// How long the flights after such a rebound would take: 2 u / |G''| (1 + e + e^2 + ...), with G''
/// the pull F - 1 of the ground. A body that lifts off again does not wait for their end.
template <class Real>
HOPSCOTCH_DEVICE inline Real rest_of_chatter(const Real& rebound, const Real& pull,
                                             const Real& restitution) {
    const Real one(1.0);
    const mask_of<Real> chatters = (rebound > Real(0.0)) & (pull < Real(0.0)) & (restitution < one);
    const Real slowing = select(chatters, -pull * (one - restitution), one);
    return select(chatters, (rebound + rebound) / slowing, Real(0.0));
}

/// The last instant of a flight, before the impact.
template <class Real>
struct landing {
    Real duration;
    Real eta;       // y1 - 1 at contact
    Real velocity;  // y1'
    Real gap_rate;  // (1 + M) y2' <= 0
};

/// Flight from a launch on the ground without rebound, by the half flight time.
template <class Real>
HOPSCOTCH_DEVICE inline landing<Real> land_from_contact(const hopper_lane<Real>& lane,
                                                        const launch<Real>& from,
                                                        mask_of<Real> is_bounce,
                                                        mask_of<Real> wanted) {
    const half_flight_terms<Real> at = first_contact(from, lane.cell, is_bounce, wanted);
    const Real slope = Real(2.0) * at.r / at.q;
    return {at.x * Real(2.0), fma(at.x * at.sine, slope, from.eta),
            fma(lane.mu * at.p, slope, (from.centre - at.x) + (from.offset - at.x)),
            -(at.p * slope)};
}

/// Flight from any state in the air, by pieces of one curvature.
template <bool Damped, class Real>
struct flight_result {
    landing<Real> end;
    mask_of<Real> found;
};
template <bool Damped, class Real>
HOPSCOTCH_DEVICE inline flight_result<Damped, Real> land_from(const free_flight<Damped, Real>& flow,
                                                              Real inverse_total,
                                                              mask_of<Real> lift_off,
                                                              mask_of<Real> wanted) {
    using plain = primal_of<Real>;
    const auto& spring = flow.spring;
    const free_flight<Damped, plain> value{{primal(spring.value), primal(spring.rate),
                                            primal(spring.damping), primal(spring.frequency)},
                                           primal(flow.gap0),
                                           primal(flow.rate0)};
    const contact_search<plain> contact = first_contact(value, lift_off, wanted);
    const Real time =
        implicit_root(contact.time, flow.gap(Real(contact.time)), value.gap_rate(contact.time));
    const auto there = spring.at(time);
    const Real gap_rate = smaller(flow.gap_rate(time), Real(0.0));
    // v1 = s' + v2; y1 = s on the ground
    return {{time, there.value - Real(1.0), fma(gap_rate, inverse_total, there.rate), gap_rate},
            contact.found};
}

/// The flow of a flight that starts on the ground with the foot rebounding at `rebound`.
template <bool Damped, class Real>
HOPSCOTCH_DEVICE inline free_flight<Damped, Real> rebound_flow(const hopper_lane<Real>& lane) {
    const launch<Real> from = launch_of(lane);
    const Real speed = from.centre + from.offset;
    const Real frequency = Damped ? sqrt(fma(-lane.damping, lane.damping, Real(1.0))) : Real(1.0);
    return {{Real(1.0) + from.eta, fma(-lane.rebound, lane.inverse_total, speed), lane.damping,
             frequency},
            Real(0.0),
            lane.rebound};
}

template <class Real>
HOPSCOTCH_DEVICE inline landing<Real> select_landing(mask_of<Real> condition,
                                                     const landing<Real>& yes,
                                                     const landing<Real>& no) {
    return {select(condition, yes.duration, no.duration), select(condition, yes.eta, no.eta),
            select(condition, yes.velocity, no.velocity),
            select(condition, yes.gap_rate, no.gap_rate)};
}

/// A safe lower bound of D_k, the least kappa that lets an orbit leave the branch of alpha*_k
/// downward (page, section 4): 0.5438 / (alpha*_k + a) with a falling from 1.907. Tested for k = 1
/// ... 200.
template <class Real>
HOPSCOTCH_DEVICE inline Real least_escaping_kappa(Real centre) {
    return Real(0.5437) / (centre + Real(1.907));
}

/// D(x) = (alpha^2 - alpha*_k^2) / W falls at least up to this distance from alpha*_k, for every k:
/// an orbit there that is mapped above alpha*_k proves the same for everything between. Its minimum
/// lies at 0.721 (k = 1) down to 0.5278 (k -> inf). Tested for k = 1 ... 200.
inline constexpr double falling_part = 0.52;

/// Starts the next flight of the lanes wanted from the ground.
template <class Real>
HOPSCOTCH_DEVICE inline void launch_bounce(hopper_lane<Real>& lane, Real eta, Real velocity,
                                           Real rebound, mask_of<Real> wanted) {
    lane.is_bounce = select(wanted, Real(1.0), lane.is_bounce);
    lane.velocity = select(wanted, velocity, lane.velocity);
    lane.eta = select(wanted, eta, lane.eta);
    lane.rebound = select(wanted, rebound, lane.rebound);
}

/// Completes the lift-off of the lanes wanted: launch increment, section state, next flight.
///
/// \param speed     f(alpha) before the increment
/// \param distance  the same as distance from the lane's lossless point (exact next to it)
/// \return          lanes whose lift-off speed is not above zero: no further hop
template <class Variant, class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> lift_off(hopper_lane<Real>& lane, Real speed, Real distance,
                                               mask_of<Real> wanted) {
    const mask_of<Real> dies = wanted & (speed + lane.increment <= Real(0.0));
    const mask_of<Real> lifts = wanted & !dies;
    const mask_of<Real> is_new = lifts & (lane.from_flight > Real(0.0));
    set_distance(lane, distance + lane.increment, lifts & !is_new);
    if (any(is_new)) set_lift_off_speed(lane, speed + lane.increment, is_new);
    launch_from_section<Variant::is_damped>(lane, lifts);
    return dies;
}

/// Duration of contact and lift-off speed from energy (undamped) or from the force (damped).
template <class Real>
struct contact_end {
    mask_of<Real> lifts;
    Real duration;
    Real speed;
    Real distance;
};

template <class Variant, class Real>
HOPSCOTCH_DEVICE inline contact_end<Real> end_of_contact(const hopper_lane<Real>& lane,
                                                         const contact_start<Real>& start,
                                                         mask_of<Real> wanted) {
    if constexpr (Variant::is_damped) {
        const damped_lift_off<Real> end =
            lift_off_damped(start, lane.damping, lane.mu, lane.inverse_mass, wanted);
        return {end.found, end.duration, end.speed, (end.speed - lane.centre) - lane.centre_low};
    } else {
        const Real alpha = lift_off_speed(lane);
        const mask_of<Real> is_new = lane.from_flight > Real(0.0);
        const Real remaining = select(is_new, lane.energy, alpha * alpha) - lane.loss;
        const mask_of<Real> lifts = wanted & (remaining > Real(0.0));
        const Real rough = sqrt(select(lifts, remaining, Real(1.0)));
        const Real drop = lane.loss / (alpha + rough);  // alpha - f without cancellation (H2)
        const Real speed = select(is_new, rough, alpha - drop);
        const Real duration = Variant::is_timed
                                  ? contact_duration(start, speed, lane.mu, lane.inverse_mass)
                                  : Real(0.0);
        return {lifts, duration, speed, lane.beta - drop};
    }
}

/// What the landing leads to. Updates the lane and says what was completed.
///
/// \param end        the state just before impact
/// \param decided    lanes whose kind of landing follows from the interval rule of section 3
/// \param sustained  for those: sustained contact (otherwise a bounce)
/// \param charged    lanes whose energy was taken before this impact, so that its loss counts
template <class Variant, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> land(hopper_lane<Real>& lane, const landing<Real>& end,
                                            mask_of<Real> decided, mask_of<Real> sustained,
                                            mask_of<Real> charged, mask_of<Real> active,
                                            Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    Real eta = end.eta;
    Real velocity = end.velocity;
    Real rebound = zero;
    Real kept(0.0);  // share of the impact's energy that the rebound keeps
    Real settling(0.0);
    mask_of<Real> rests = eta <= zero;
    if constexpr (Variant::has_rebound) {
        rebound = -(lane.restitution * end.gap_rate);
        kept = lane.restitution * lane.restitution;
        // v2+ = -e v2-, y1' unchanged
        const Real spring_rate = fma(-rebound, lane.inverse_total, velocity);
        const Real pull =
            Variant::is_damped ? fma(Real(2.0) * lane.damping, spring_rate, eta) : eta;
        const mask_of<Real> silent =
            rebound <= smaller(-(pull * Real(chatter_speed<Real>)), Real(chatter_speed<Real>));
        rests = ((rebound == zero) | silent) & (pull <= zero);
        settling = rest_of_chatter(rebound, pull, lane.restitution);
    }
    const mask_of<Real> contact = active & ((decided & sustained) | (!decided & rests));
    const mask_of<Real> bounces = active & !contact;
    if constexpr (Variant::has_rebound) {
        kept = select(contact, zero, kept);
        rebound = select(contact, zero, rebound);
    }
    const Real lost = lane.kappa * (one - kept) * end.gap_rate * end.gap_rate;

    lane.loss = select(active & charged, lane.loss + lost, lane.loss);
    lane.total_loss = select(active, lane.total_loss + lost, lane.total_loss);
    lane.events = select(active, lane.events + one, lane.events);
    if constexpr (Variant::is_timed) {
        lane.time = select(active, lane.time + end.duration, lane.time);
    }
    // with restitution only impacts of |v2-| > 1e-8 count (page, section 6); M = infinity: |gap
    // rate|
    const Real foot_share = select(lane.inverse_total == zero, one, lane.inverse_total);
    const mask_of<Real> counts =
        bounces & (!(lane.restitution > zero) | (-end.gap_rate * foot_share > Real(1e-8)));
    lane.bounces = select(counts, lane.bounces + one, lane.bounces);

    Real ended = zero;
    // decided means contact from the start in a flight start, which proves nothing about its
    // lift-off
    const mask_of<Real> was_lift_off = decided & !(lane.from_flight > zero);
    const Real cell = lane.cell;
    const Real old_centre = lane.centre;  // of the lift-off, where was_lift_off
    const Real old_beta = lane.beta;
    if constexpr (Watch::is_active) {
        if (active) watch.impact(lane, eta, velocity, end.gap_rate, rebound, lost, contact);
    }
    if (any(bounces)) launch_bounce(lane, eta, velocity, rebound, bounces);
    mask_of<Real> returned = contact;
    if (any(contact)) {
        const contact_end<Real> after =
            end_of_contact<Variant>(lane, contact_start<Real>{eta, velocity}, contact);
        if constexpr (Watch::is_active) {
            watch.contact(lane, contact_start<Real>{eta, velocity}, after.lifts, after.duration,
                          after.speed);
        }
        if constexpr (Variant::is_timed) {
            const Real more = select(after.lifts, after.duration, settling);
            lane.time = select(contact, lane.time + more, lane.time);
        }
        lane.events = select(after.lifts, lane.events + one, lane.events);
        const mask_of<Real> stays = contact & was_lift_off & (after.distance >= zero) &
                                    (old_beta >= zero) & (lane.increment == zero);
        const mask_of<Real> dies =
            lift_off<Variant>(lane, after.speed, after.distance, after.lifts);
        returned = after.lifts & !dies;
        ended = select(contact & !returned, code_of<Real>(outcome::stuck), zero);
        if constexpr (!Variant::has_rebound) {
            // at M = infinity nothing is lost and nothing is attracted
            const mask_of<Real> in_trap = stays & (lane.kappa > zero) &
                                          ((lane.kappa <= least_escaping_kappa(old_centre)) |
                                           (old_beta <= Real(falling_part)));
            lane.trapped = select(returned, select(in_trap, cell + one, zero), lane.trapped);
        }
    }
    const Real finite = end.duration + end.velocity + end.gap_rate + end.eta;
    ended = select(active & !(finite - finite == zero), code_of<Real>(outcome::not_finite), ended);
    returned = returned & (ended == zero);
    return {returned, ended};
}

/// One flight and its landing, for every active lane.
template <class Variant, class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> fly_and_land(hopper_lane<Real>& lane, mask_of<Real> active,
                                                    Watch& watch) {
    const Real zero(0.0);
    const mask_of<Real> is_bounce = lane.is_bounce > zero;
    const launch<Real> from = launch_of(lane);
    // alpha = 0 is the resting state: no flight, no further hop
    const mask_of<Real> at_rest = active & !is_bounce & (from.centre + from.offset == zero);
    const mask_of<Real> flies = active & !at_rest;
    progress<Real> result;
    if constexpr (Variant::is_damped) {
        const auto flight =
            land_from(rebound_flow<true>(lane), lane.inverse_total, !is_bounce, flies);
        if constexpr (Watch::is_active)
            watch.flight(lane, rebound_flow<true>(lane), flight.end.duration);
        result =
            land<Variant>(lane, flight.end, flies & !flies, flies & !flies, flies, flies, watch);
        result.ended =
            select(flies & !flight.found, code_of<Real>(outcome::unresolved_event), result.ended);
        result.returned = result.returned & flight.found;
    } else {
        const mask_of<Real> by_rebound = flies & (lane.rebound > zero);
        const mask_of<Real> from_contact = flies & !by_rebound;
        landing<Real> end = land_from_contact(lane, from, is_bounce, from_contact);
        mask_of<Real> found = flies;
        if constexpr (Variant::has_rebound) {
            if (any(by_rebound)) {
                const auto flight = land_from(rebound_flow<false>(lane), lane.inverse_total,
                                              flies & !flies, by_rebound);
                end = select_landing(by_rebound, flight.end, end);
                found = from_contact | flight.found;
            }
        }
        if constexpr (Watch::is_active) watch.flight(lane, rebound_flow<false>(lane), end.duration);
        const mask_of<Real> is_lift_off = from_contact & !is_bounce;
        mask_of<Real> decided = is_lift_off;
        if constexpr (Variant::has_rebound) decided = is_lift_off & (end.gap_rate == zero);
        result = land<Variant>(lane, end, decided, from.offset >= zero, flies, flies, watch);
        result.ended =
            select(flies & !found, code_of<Real>(outcome::unresolved_event), result.ended);
        result.returned = result.returned & found;
    }
    result.ended = select(at_rest, code_of<Real>(outcome::rest), result.ended);
    return result;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
