// One Taylor step of a passive hopper with a nonlinear spring or height-dependent gravity, in the
// air or on the ground, and the first event on it. In the air
//   s'' = -F - gamma s / (1 + M),   G'' = F - 1 - gamma G / (1 + M),   F = s + q s^2 + c s^3 + 2
//   zeta s';
// on the ground y1 = s and s'' = -mu F - (1 + gamma s) / (1 + M). Source: models/passive_hopper.md
// section 6; with gravity 1 + gamma y the equations of s and G part.
#pragma once

#include "kernels/integrators/first_zero.hpp"
#include "kernels/integrators/taylor.hpp"
#include "kernels/passive/nonlinear_lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// The motion over one step as polynomials in time.
template <class Real>
struct nonlinear_motion {
    taylor::series<Real> s, rate, gap;
    taylor::series<Real> pull;  // F - 1

    HOPSCOTCH_DEVICE Real gap_rate(const Real& t) const {
        Real sum(0.0);
        for (int n = taylor::order<Real>; n >= 1; --n)
            sum = fma(sum, t, Real(static_cast<double>(n)) * gap.c[n]);
        return sum;
    }
};

template <class Real>
HOPSCOTCH_DEVICE inline void expand(nonlinear_motion<Real>& a, const nonlinear_lane<Real>& lane) {
    using taylor::over;
    const Real zero(0.0);
    const Real one(1.0);
    const mask_of<Real> grounded = lane.in_contact > zero;
    const Real share = select(grounded, lane.mu, one);
    const Real weight = select(grounded, lane.inverse_total, zero);
    const Real in_air = select(grounded, zero, one);
    const Real stiffening = lane.gradient * lane.inverse_total;
    const Real damper = Real(2.0) * lane.damping;
    taylor::series<Real> squares;
    a.s.c[0] = lane.s;
    a.rate.c[0] = lane.rate;
    a.gap.c[0] = lane.gap;
    a.gap.c[1] = lane.gap_rate;
    for (int n = 0; n < taylor::order<Real>; ++n) {
        const int m = n + 1;
        squares.c[n] = taylor::square(a.s, n);
        const Real cubes = taylor::product(a.s, squares, n);
        const Real elastic =
            fma(lane.spring.cubic, cubes, fma(lane.spring.quadratic, squares.c[n], a.s.c[n]));
        a.pull.c[n] = n == 0 ? lane.pull : fma(damper, a.rate.c[n], elastic);
        const Real force = n == 0 ? lane.pull + one : a.pull.c[n];
        const Real pulled = fma(share, force, stiffening * a.s.c[n]);
        a.s.c[m] = over(a.rate.c[n], m);
        a.rate.c[m] = -over(n == 0 ? pulled + weight : pulled, m);
        if (m < taylor::order<Real>) {
            const Real opening = in_air * fma(-stiffening, a.gap.c[n], a.pull.c[n]);
            a.gap.c[m + 1] = over(over(opening, m), m + 1);
        }
    }
    a.pull.c[taylor::order<Real>] = zero;
}

/// Where a step came to.
template <class Real>
struct nonlinear_step {
    Real duration;
    mask_of<Real> lands;   // from the air: the gap has closed
    mask_of<Real> lifts;   // from the ground: F has risen to 1
    mask_of<Real> turns;   // on the ground: the body has stopped
    mask_of<Real> rising;  // on the ground: it was on its way up
    mask_of<Real> unresolved, broken;
};

/// One step: up to its full length, or to its first event.
template <class Real>
HOPSCOTCH_DEVICE inline nonlinear_step<Real> advance(const nonlinear_motion<Real>& a,
                                                     const nonlinear_lane<Real>& lane,
                                                     const mask_of<Real>& active) {
    using plain = primal_of<Real>;
    const Real zero(0.0);
    const Real one(1.0);
    taylor::step_length<Real> size;
    size.watch(a.s);
    size.watch(a.rate);
    size.watch(a.gap);
    const plain horizon = size.length(primal(lane.tolerance), plain(1e6));
    const mask_of<Real> grounded = active & (lane.in_contact > zero);
    const mask_of<Real> airborne = active & !grounded;

    // on the ground: 1 - F, zero from the start where contact begins at F = 1 falling
    const Real force_rate = pull_rate(lane);
    const mask_of<Real> begins_at_one = grounded & (lane.fresh > zero) & (lane.pull == zero);
    const Real slack_zeros = select(begins_at_one & (force_rate < zero), one,
                                    select(begins_at_one & (force_rate == zero), Real(2.0), zero));
    taylor::series<Real> event;
    taylor::series<Real> turning;
    const Real acceleration = acceleration_of_spring(lane);
    const mask_of<Real> still = lane.rate == zero;
    const mask_of<Real> rising = (lane.rate > zero) | (still & (acceleration >= zero));
    for (int n = 0; n <= taylor::order<Real>; ++n) {
        event.c[n] = select(grounded, -a.pull.c[n], a.gap.c[n]);
        turning.c[n] = negate_where(!rising, a.rate.c[n]);
    }
    taylor::divide_out_zeros(event, select(grounded, slack_zeros, lane.gap_zeros));
    taylor::divide_out_zeros(turning, select(still, one, zero));
    const auto first = taylor::first_zero(event, horizon, active);
    const auto turn = taylor::first_zero(turning, horizon, grounded);

    const mask_of<Real> turns = turn.found & !(first.found & (first.time <= turn.time));
    const mask_of<Real> happens = first.found & !turns;
    const mask_of<Real> lands = happens & airborne;
    const mask_of<Real> lifts = happens & grounded;
    const mask_of<Real> unresolved = (first.unresolved & !turns) | (turn.unresolved & !happens);
    const mask_of<Real> broken = active & !(horizon >= plain(0.0));
    const Real duration = select(happens, first.time, select(turns, turn.time, Real(horizon)));
    return {duration, lands, lifts, turns, rising, unresolved, broken};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
