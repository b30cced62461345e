// The passive hopper's modes when spring or gravity is not linear: one integrator step per call,
// and what an impact, a lift-off or a turning point on the ground leads to. The rules are those of
// the exact return map (return_map.hpp); the lift-off speed without a damper comes from the energy
// that impacts left, so that it never rises. Source: models/passive_hopper.md sections 2, 6.
#pragma once

#include "kernels/passive/nonlinear_flow.hpp"
#include "kernels/passive/return_map.hpp"
#include "kernels/passive/trace.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// The foot meets the ground with gap rate lane.gap_rate <= 0: a bounce, or sustained contact.
///
/// \return  lanes in contact that have not enough energy for another lift-off
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline mask_of<Real> meet_ground(nonlinear_lane<Real>& lane,
                                                  const mask_of<Real>& wanted, Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const Real damper = Real(2.0) * lane.damping;
    const Real body_rate = fma(lane.gap_rate, lane.inverse_total, lane.rate);
    const Real rebound = -(lane.restitution * lane.gap_rate);
    const Real spring_rate = fma(-rebound, lane.inverse_total, body_rate);
    const Real pull = fma(damper, spring_rate - lane.rate, lane.pull);
    const mask_of<Real> silent =
        rebound <= smaller(-(pull * Real(chatter_speed<Real>)), Real(chatter_speed<Real>));
    const mask_of<Real> stays = wanted & ((rebound == zero) | silent) & (pull <= zero);
    const mask_of<Real> bounces = wanted & !stays;
    const Real kept = select(stays, zero, lane.restitution * lane.restitution);
    const Real lost = lane.kappa * (one - kept) * lane.gap_rate * lane.gap_rate;
    const Real leaving = select(stays, zero, rebound);

    lane.loss = select(wanted, lane.loss + lost, lane.loss);
    lane.total_loss = select(wanted, lane.total_loss + lost, lane.total_loss);
    lane.events = select(wanted, lane.events + one, lane.events);
    // with restitution only impacts of |v2-| > 1e-8 count (page, section 6); M = infinity: |G'|
    const Real foot_share = select(lane.inverse_total == zero, one, lane.inverse_total);
    const mask_of<Real> counts =
        bounces & (!(lane.restitution > zero) | (-lane.gap_rate * foot_share > Real(1e-8)));
    lane.bounces = select(counts, lane.bounces + one, lane.bounces);
    if constexpr (Watch::is_active) {
        if (wanted) watch.impact(lane, body_rate, leaving, lost, stays);
    }
    const Real rate = select(stays, body_rate, spring_rate);
    const Real landed_pull = fma(damper, rate - lane.rate, lane.pull);
    lane.pull = select(wanted, landed_pull, lane.pull);
    lane.rate = select(wanted, rate, lane.rate);
    lane.gap = select(wanted, zero, lane.gap);
    lane.gap_rate = select(wanted, leaving, lane.gap_rate);
    lane.gap_zeros = select(wanted, select(leaving > zero, one, Real(2.0)), lane.gap_zeros);
    lane.in_contact = select(wanted, select(stays, one, zero), lane.in_contact);
    lane.fresh = select(stays, one, lane.fresh);
    lane.contact_time = select(wanted, zero, lane.contact_time);
    lane.settling = select(wanted, rest_of_chatter(rebound, pull, lane.restitution), lane.settling);
    return stays & !(lane.damping > zero) & !(lane.energy - lane.loss > zero);
}

/// Lift-off from sustained contact: its speed, the increment, the next flight.
///
/// \param measured  y1' from the integrated motion; taken where a damper works
/// \return          lanes whose lift-off speed is not above zero: no further hop
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline mask_of<Real> lift_off(nonlinear_lane<Real>& lane, const Real& measured,
                                               const mask_of<Real>& wanted, Watch& watch) {
    const Real zero(0.0);
    const mask_of<Real> is_damped = lane.damping > zero;
    const Real remaining = lane.energy - lane.loss;
    const mask_of<Real> has_energy = is_damped | (remaining > zero);
    const Real rough = sqrt(select(remaining > zero, remaining, Real(1.0)));
    const Real drop = lane.loss / (lane.alpha + rough);  // alpha - f without cancellation
    const mask_of<Real> is_new = lane.from_flight > zero;
    const Real speed = select(is_damped, measured, select(is_new, rough, lane.alpha - drop));
    const Real launched = speed + lane.increment;
    const mask_of<Real> lifts = wanted & has_energy & (launched > zero);
    lane.time = select(wanted & has_energy, lane.time + lane.contact_time, lane.time);
    if constexpr (Watch::is_active) {
        if (wanted) watch.lift_off(lane, launched);
    }
    lane.events = select(wanted & has_energy, lane.events + Real(1.0), lane.events);
    lane.alpha = select(lifts, launched, lane.alpha);
    launch_from_section(lane, lifts);
    return wanted & !lifts;
}

/// How far below 1 the force may end at the top of a contact that has the energy to lift off: F
/// rises with the body there, so a true top that low has an energy below zero by as much.
inline constexpr double grazing_pull = 1e-3;

/// True where a motion in the air or on the ground has left for good: a spring beyond its outer
/// zero, or a hopper above the height where gravity points upward, with too little energy in its
/// spring to reach down.
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> has_escaped(const nonlinear_lane<Real>& lane) {
    const Real zero(0.0);
    const Real one(1.0);
    const Real half(0.5);
    const mask_of<Real> grounded = lane.in_contact > zero;
    const Real share = select(grounded, lane.mu, one);
    const Real stiffening = lane.gradient * lane.inverse_total;
    const spring_law<Real> pulling{share * lane.spring.quadratic, share * lane.spring.cubic};
    const mask_of<Real> spring_gone = runs_away(share + stiffening, pulling, lane.s, lane.rate);
    // centre of mass: c'' = -(1 + gamma (c + 1) / (1 + M)), c + 1 = G + s
    const Real centre = lane.gap + lane.s;
    const mask_of<Real> floats =
        !grounded & (fma(stiffening, centre, one) <= zero) & (lane.gap_rate + lane.rate >= zero);
    const Real work = fma(half * stiffening, (centre - lane.s) * (centre + lane.s),
                          lane.spring.work(lane.s, centre));
    return spring_gone | (floats & (work > half * lane.rate * lane.rate));
}

/// Begins at lift-off with speed alpha.
template <class Real>
HOPSCOTCH_DEVICE inline Real begin_at_lift_off(nonlinear_lane<Real>& lane, const Real& alpha) {
    const Real zero(0.0);
    const mask_of<Real> valid = is_finite(alpha) & (alpha >= zero);
    lane.alpha = select(valid, alpha, zero);
    launch_from_section(lane, valid | !valid);
    return select(valid, zero, code_of<Real>(outcome::invalid_start));
}

/// Begins in any state with the foot on or above the ground; the table of section 2.
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline Real begin_anywhere(nonlinear_lane<Real>& lane,
                                            const engine_state<Real>& start, Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const Real two(2.0);
    const mask_of<Real> valid = is_finite(start.spring) & is_finite(start.spring_rate) &
                                is_finite(start.gap) & is_finite(start.gap_rate) &
                                (start.gap >= zero);
    lane.alpha = zero;
    lane.s = select(valid, start.spring, zero);
    lane.rate = select(valid, start.spring_rate, zero);
    lane.gap = select(valid, start.gap, zero);
    lane.gap_rate = select(valid, start.gap_rate, zero);
    lane.in_contact = lane.gap_zeros = lane.loss = zero;
    lane.from_flight = one;
    lane.pull = pull_of(lane);
    lane.energy = energy_of(lane);
    const mask_of<Real> grounded = valid & (lane.gap == zero);
    const mask_of<Real> impacts = grounded & (lane.gap_rate < zero);
    const mask_of<Real> stands = grounded & (lane.gap_rate == zero);
    const mask_of<Real> lifts = stands & (lane.pull == zero) & (pull_rate(lane) > zero);
    const mask_of<Real> departs = stands & (lane.pull > zero);
    const mask_of<Real> stays = stands & !lifts & !departs;
    lane.gap_zeros = select(lifts, Real(3.0), select(departs, two, select(grounded, one, zero)));
    // an impact, or contact from the start, is booked as the exact map does
    const mask_of<Real> spent = meet_ground(lane, impacts | stays, watch);
    return select(valid, select(spent, code_of<Real>(outcome::stuck), zero),
                  code_of<Real>(outcome::invalid_start));
}

/// One integrator step for every active lane.
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> step_nonlinear(nonlinear_lane<Real>& lane,
                                                      const mask_of<Real>& active, Watch& watch) {
    const Real zero(0.0);
    // alpha = 0 is the resting state: no flight, no further hop
    const mask_of<Real> at_rest =
        active & (lane.gap_zeros == Real(3.0)) & (lane.rate == zero) & (lane.in_contact == zero);
    const mask_of<Real> moves = active & !at_rest;
    nonlinear_motion<Real> a;
    expand(a, lane);
    const nonlinear_step<Real> step = advance(a, lane, moves);
    const Real t = step.duration;
    if constexpr (Watch::is_active) {
        if (moves) watch.phase(lane, a, t);
    }
    const mask_of<Real> launched = moves & ((lane.gap_zeros > zero) | (lane.fresh > zero));
    const Real gap_rate = a.gap_rate(t);
    const mask_of<Real> grounded = lane.in_contact > zero;
    lane.time = select(moves & !grounded, lane.time + t, lane.time);
    lane.contact_time = select(moves & grounded, lane.contact_time + t, lane.contact_time);
    lane.gap = select(moves, select(step.lands, zero, taylor::evaluate(a.gap, t)), lane.gap);
    lane.gap_rate =
        select(moves, select(step.lands, smaller(gap_rate, zero), gap_rate), lane.gap_rate);
    lane.s = select(moves, taylor::evaluate(a.s, t), lane.s);
    lane.rate = select(moves, select(step.turns, zero, taylor::evaluate(a.rate, t)), lane.rate);
    // a short hop's pull is a small difference: its series keeps it relatively exact
    const Real pull = select(launched, taylor::evaluate(a.pull, t), pull_of(lane));
    lane.pull = select(moves, pull, lane.pull);
    lane.gap_zeros = select(moves, zero, lane.gap_zeros);
    lane.fresh = select(moves, zero, lane.fresh);

    // a body whose energy suffices lifts off even where the integration ends a little short of F =
    // 1
    const mask_of<Real> tops = step.turns & step.rising;
    const mask_of<Real> grazes = tops & (lane.pull > Real(-grazing_pull)) & !(lane.damping > zero) &
                                 (lane.energy - lane.loss > zero);
    const mask_of<Real> lifts = step.lifts | grazes;
    mask_of<Real> stuck = tops & !grazes;
    if (any(step.lands)) stuck = stuck | meet_ground(lane, step.lands, watch);
    lane.time = select(stuck, lane.time + lane.settling, lane.time);
    mask_of<Real> returned = lifts;
    if (any(lifts)) {
        const mask_of<Real> dies = lift_off(lane, lane.rate, lifts, watch);
        stuck = stuck | dies;
        returned = returned & !dies;
    }
    const mask_of<Real> goes_on = moves & !step.lands & !lifts & !step.turns;
    Real ended = select(stuck, code_of<Real>(outcome::stuck), zero);
    ended = select(goes_on & has_escaped(lane), code_of<Real>(outcome::escaped), ended);
    ended = select(moves & step.unresolved, code_of<Real>(outcome::unresolved_event), ended);
    const mask_of<Real> broken = moves & (step.broken | !is_finite(lane.s + lane.gap));
    ended = select(broken, code_of<Real>(outcome::not_finite), ended);
    ended = select(at_rest, code_of<Real>(outcome::rest), ended);
    returned = returned & (ended == zero);
    return {returned, ended};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
