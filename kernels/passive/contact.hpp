// Sustained contact of the passive hopper: the foot rests on the ground and the body oscillates
// until the spring force reaches 1. Source: models/passive_hopper.md section 2, CPRR Eq (5).
#pragma once

#include "kernels/elementary/arctangent.hpp"
#include "kernels/lanes/dual.hpp"
#include "kernels/passive/free_flight.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// The body at the beginning of sustained contact: y1 = 1 + eta (eta <= 0 when undamped), y1' =
/// velocity.
template <class Real>
struct contact_start {
    Real eta;
    Real velocity;
};

/// Energy of a state on the ground as the square of the lift-off speed it would have (undamped):
/// alpha^2 = V^2 + (Y - 1)(M (Y + 1) + 2) / (1 + M), with Y = 1 + eta. Holds for M = infinity.
template <class Real>
HOPSCOTCH_DEVICE inline Real energy_on_ground(const contact_start<Real>& start, Real mu,
                                              Real inverse_total) {
    const Real bracket = mu * (Real(2.0) + start.eta) + Real(2.0) * inverse_total;
    return fma(start.eta, bracket, start.velocity * start.velocity);
}

/// Duration of undamped sustained contact that ends at lift-off speed alpha; no 0/0, no
/// cancellation. \return dimensionless time; 0 where contact begins and ends at once
template <class Real>
HOPSCOTCH_DEVICE inline Real contact_duration(const contact_start<Real>& start, Real alpha, Real mu,
                                              Real inverse_mass) {
    const Real frequency = sqrt(mu);
    const mask_of<Real> falls = start.velocity <= Real(0.0);
    const Real opposite = select(falls, alpha - start.velocity, -(frequency * start.eta));
    const Real adjacent =
        select(falls, -(frequency * (start.eta + (Real(2.0) + Real(2.0) * inverse_mass))),
               start.velocity + alpha);
    return Real(2.0) / frequency * atan2(opposite, adjacent);
}

/// End of sustained contact with a damped spring.
template <class Real>
struct damped_lift_off {
    mask_of<Real> found;  // false: the force never reaches 1 (stuck)
    Real duration;
    Real speed;  // alpha = y1' at lift-off; y1 = 1 - 2 zeta alpha there
};

/// Motion on the ground about the equilibrium y1 = -1/M: frequency^2 = mu, decay rate zeta mu.
template <class Real>
struct contact_motion {
    Real decay;
    Real frequency;
    Real mu;
    Real damping;
    Real height;    // y1 + 1/M at the beginning
    Real velocity;  // y1'

    /// A solution of the contact oscillator and its rate, from its initial values.
    HOPSCOTCH_DEVICE value_and_slope<Real> oscillate(Real value, Real rate, Real t) const {
        const auto angle = sin_cos(frequency * t);
        const Real ratio = angle.sin / frequency;
        const Real scale = exp(-(decay * t));
        return {scale * fma(value, angle.cos, fma(decay, value, rate) * ratio),
                scale * fma(rate, angle.cos, -(fma(mu, value, decay * rate) * ratio))};
    }
    HOPSCOTCH_DEVICE Real acceleration() const {
        return -fma(Real(2.0) * decay, velocity, mu * height);
    }
    /// F + 1/M and its rate.
    HOPSCOTCH_DEVICE value_and_slope<Real> force0() const {
        return {fma(Real(2.0) * damping, velocity, height),
                fma(Real(2.0) * damping, acceleration(), velocity)};
    }
    HOPSCOTCH_DEVICE value_and_slope<Real> force(Real t) const {
        const value_and_slope<Real> at_start = force0();
        return oscillate(at_start.value, at_start.slope, t);
    }
    HOPSCOTCH_DEVICE value_and_slope<Real> body(Real t) const {
        return oscillate(height, velocity, t);
    }
};

/// First upward crossing of F = 1. F + 1/M obeys the contact oscillator; its turning points are in
/// closed form, and it rises monotonically to its first maximum.
///
/// \param start   y1 = 1 + eta, y1' = velocity, foot at rest on the ground
/// \param wanted  lanes in contact
/// \error         none; a first maximum of F at or below 1 is stuck
template <class Real>
HOPSCOTCH_DEVICE inline damped_lift_off<Real> lift_off_damped(const contact_start<Real>& start,
                                                              Real damping, Real mu,
                                                              Real inverse_mass,
                                                              mask_of<Real> wanted) {
    using plain = primal_of<Real>;
    const Real decay = damping * mu;
    const Real target = Real(1.0) + inverse_mass;
    const contact_motion<Real> motion{decay,   sqrt(fma(-decay, decay, mu)), mu,
                                      damping, target + start.eta,           start.velocity};
    const contact_motion<plain> value{
        primal(motion.decay), primal(motion.frequency), primal(mu),
        primal(damping),      primal(motion.height),    primal(motion.velocity)};
    const plain zero(0.0);
    const value_and_slope<plain> force0 = value.force0();
    const plain turn = atan2(value.frequency * force0.slope,
                             fma(value.decay, force0.slope, value.mu * force0.value));
    const mask_of<Real> rises = force0.slope > zero;
    const plain first = select(turn > zero, turn, turn + pi<plain>()) / value.frequency;
    const plain low = select(rises, zero, first);
    const plain high = select(rises, first, first + pi<plain>() / value.frequency);
    const auto rising = [&](const plain& t) {
        const value_and_slope<plain> force = value.force(t);
        return value_and_slope<plain>{force.value - primal(target), force.slope};
    };
    const mask_of<Real> found = wanted & (rising(high).value > zero);
    const plain root = bracketed_root<plain>(rising, {low, high}, (low + high) * plain(0.5), found);
    const Real t =
        implicit_root(root, motion.force(Real(root)).value - target, value.force(root).slope);
    return {found, t, motion.body(t).slope};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
