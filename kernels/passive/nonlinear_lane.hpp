// One trajectory of the passive hopper or juggler whose spring or gravity is not linear. Flight and
// sustained contact are integrated in the coordinates of the exact flights: spring extension s, gap
// G = (1 + M) y2, and the pull F - 1 that decides every landing.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/passive/spring_law.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

template <class Real>
struct nonlinear_lane {
    // parameters and what follows from them; the first seven are not moved where none varies
    // (n_parameter_fields of hopper_lane.hpp)
    Real mu;             // M / (1 + M)
    Real kappa;          // M / (1 + M)^2
    Real inverse_total;  // 1 / (1 + M)
    Real restitution;
    Real damping;
    Real increment;
    spring_law<Real> spring;
    Real gradient;        // gamma of the gravity 1 + gamma y
    Real lift_extension;  // s where F = 1 without a damper: y1 at lift-off
    Real tolerance;       // of a step of the integrator

    Real alpha;  // section state: lift-off speed

    // the motion
    Real s, rate;
    Real gap, gap_rate;
    Real pull;          // F - 1, relatively exact from a launch or landing on
    Real in_contact;    // 1 while the foot is on the ground
    Real gap_zeros;     // leading coefficients of the gap that vanish: 3 at lift-off, 2 at a bounce
                        // without and 1 with rebound, 0 later
    Real fresh;         // 1 at the beginning of contact
    Real contact_time;  // of the contact under way; booked at its lift-off
    Real settling;      // of the chatter before that contact; booked if it does not lift off

    // energy of the current return, as the square of the lift-off speed it would give
    Real energy;
    Real loss;
    Real from_flight;  // 1 while the first return of a flight start is under way

    // reported
    Real time, events, bounces, total_loss;
};

template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> is_finite(const Real& x) {
    return x - x == Real(0.0);
}

/// Acceleration s'' in the air (foot_share 1) or on the ground (mu), where y1 = s, for F = pull
/// + 1.
template <class Real>
HOPSCOTCH_DEVICE inline Real acceleration_of_spring(const nonlinear_lane<Real>& lane) {
    const mask_of<Real> grounded = lane.in_contact > Real(0.0);
    const Real share = select(grounded, lane.mu, Real(1.0));
    const Real weight = select(grounded, lane.inverse_total, Real(0.0));
    return -fma(share, lane.pull + Real(1.0),
                fma(lane.gradient * lane.inverse_total, lane.s, weight));
}

/// dF/dt.
template <class Real>
HOPSCOTCH_DEVICE inline Real pull_rate(const nonlinear_lane<Real>& lane) {
    return fma(lane.spring.stiffness(lane.s), lane.rate,
               Real(2.0) * lane.damping * acceleration_of_spring(lane));
}

/// F - 1 from the state.
template <class Real>
HOPSCOTCH_DEVICE inline Real pull_of(const nonlinear_lane<Real>& lane) {
    return fma(Real(2.0) * lane.damping, lane.rate, lane.spring.force(lane.s) - Real(1.0));
}

/// Energy of any state as the square of the lift-off speed it would give, 2 E / (1 + M) from the
/// lift-off state at rest. Conserved in flight and contact without a damper; an impact takes
/// kappa (1 - e^2) G'^2. Holds for M = infinity.
template <class Real>
HOPSCOTCH_DEVICE inline Real energy_of(const nonlinear_lane<Real>& lane) {
    const Real half(0.5);
    const Real foot = lane.gap * lane.inverse_total;
    const Real body = lane.s + foot;
    const Real body_rate = fma(lane.gap_rate, lane.inverse_total, lane.rate);
    const Real from = lane.lift_extension;
    const Real rise = body - from;
    const Real body_weight =
        lane.inverse_total * rise * fma(half * lane.gradient, body + from, Real(1.0));
    const Real foot_weight = lane.mu * foot * fma(half * lane.gradient, foot, Real(1.0));
    const Real potential = fma(lane.mu, lane.spring.work(from, lane.s), body_weight + foot_weight);
    const Real foot_motion = lane.kappa * lane.gap_rate * lane.gap_rate;
    return fma(Real(2.0), potential, fma(body_rate, body_rate, foot_motion));
}

/// Puts the lanes wanted at lift-off with the section's speed alpha.
template <class Real>
HOPSCOTCH_DEVICE inline void launch_from_section(nonlinear_lane<Real>& lane,
                                                 const mask_of<Real>& wanted) {
    const Real zero(0.0);
    const Real damper = Real(2.0) * lane.damping * lane.alpha;
    const mask_of<Real> is_damped = wanted & (lane.damping > zero);
    Real extension = lane.lift_extension;
    if (any(is_damped)) {
        extension = select(is_damped, extension_at(lane.spring, Real(1.0) - damper), extension);
    }
    lane.s = select(wanted, extension, lane.s);
    lane.rate = select(wanted, lane.alpha, lane.rate);
    lane.gap = select(wanted, zero, lane.gap);
    lane.gap_rate = select(wanted, zero, lane.gap_rate);
    lane.pull = select(wanted, zero, lane.pull);
    lane.in_contact = select(wanted, zero, lane.in_contact);
    lane.gap_zeros = select(wanted, Real(3.0), lane.gap_zeros);
    lane.energy = select(wanted, lane.alpha * lane.alpha, lane.energy);
    lane.loss = select(wanted, zero, lane.loss);
    lane.from_flight = select(wanted, zero, lane.from_flight);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
