// Flights of the undamped passive hopper that start from contact: gap and its rate vanish at
// launch, so half the flight time x solves H(x; eta) = V, whose first root has an O(1) bracket.
// Written in the distance xi = x - centre from a lossless point (or from 0), which keeps full
// relative accuracy at the triple root. Source: models/passive_hopper.md sections 3 and 9 (H1, H3),
// CPRR Eqs (7)-(12).
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/cube_root.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/events/alternating_series.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/dual.hpp"
#include "kernels/lanes/lane.hpp"
#include "kernels/passive/lossless_point.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// A launch with gap = gap rate = 0, y1 = 1 + eta and launch velocity V = centre + offset.
/// centre is 0 or a lossless point; cosine is its cosine (1 for 0), its sine is centre * cosine.
template <class Real>
struct launch {
    Real centre;
    Real cosine;
    Real offset;
    Real eta;
};

template <class Real>
HOPSCOTCH_DEVICE inline launch<primal_of<Real>> without_derivatives(const launch<Real>& from) {
    return {primal(from.centre), primal(from.cosine), primal(from.offset), primal(from.eta)};
}

/// The functions of the half flight time that every formula of section 3 is made of.
template <class Real>
struct half_flight_terms {
    Real x;         // half flight time
    Real sine;      // S = sin x
    Real cosine;    // C = cos x
    Real p;         // x cos x - sin x
    Real q;         // x - sin x cos x  (> 0)
    Real r;         // p - eta S
    Real residual;  // (H - V) q, rising through zero
};

/// Evaluates them at xi without cancellation (brackets of H1, series below |xi| = 1/2).
template <class Real>
HOPSCOTCH_DEVICE inline half_flight_terms<Real> terms_at(const launch<Real>& from, Real xi) {
    const auto angle = sin_cos(xi);
    Real a = xi - angle.sin * angle.cos;
    Real b = fma(xi, xi, -(angle.sin * angle.sin));
    Real e = fma(xi, angle.cos, -angle.sin);
    const mask_of<Real> is_small = abs(xi) < Real(0.5);
    if (any(is_small)) {
        a = select(is_small, x_minus_sin_cos_series(xi), a);
        b = select(is_small, square_minus_sin_square_series(xi), b);
        e = select(is_small, x_cos_minus_sin_series(xi), e);
    }
    const Real x = from.centre + xi;
    const Real sine = from.cosine * fma(from.centre, angle.cos, angle.sin);
    const Real cosine = from.cosine * fma(-from.centre, angle.sin, angle.cos);
    const Real q = select(from.centre == Real(0.0), a, fma(-sine, cosine, x));
    const Real p = from.cosine * fma(-(from.centre * x), angle.sin, e);
    const Real r = fma(-from.eta, sine, p);
    const Real residual = fma(from.centre, a, b) - fma(from.eta * sine, sine, from.offset * q);
    return {x, sine, cosine, p, q, r, residual};
}

/// Halley's step towards H = V, with one division: f = residual / q, f' = w / q^2 with w = 2 p r,
/// and f''/f' = p'/p + r'/r - 2 q'/q.
template <class Real>
HOPSCOTCH_DEVICE inline value_and_step<Real> halley(const launch<Real>& from,
                                                    const half_flight_terms<Real>& at) {
    const Real w = Real(2.0) * at.p * at.r;
    const Real dp = -(at.x * at.sine);
    const Real dr = fma(-from.eta, at.cosine, dp);
    const Real bend = fma(fma(dp, at.r, dr * at.p), at.q, -(Real(2.0) * w * (at.sine * at.sine)));
    return {at.residual, at.residual * at.q * w / fma(w, w, -(at.residual * bend))};
}

/// Starting point for a lift-off: the inverse of beta = K xi^3 (1 - ...) next to a lossless point
/// and of alpha = x/2 ... on the first branch, continued by least-squares polynomials; within 0.3 %
/// everywhere (asserted by `the_guess_is_within_three_permille`).
template <class Real>
HOPSCOTCH_DEVICE inline Real lift_off_guess(const launch<Real>& from) {
    const Real centre = select(from.centre == Real(0.0), Real(1.0), from.centre);
    const Real inverse = Real(1.0) / centre;
    const Real cubic = Real(2.0 / 3.0) * fma(inverse, inverse, Real(1.0));
    const Real root = rough_cbrt(from.offset / cubic);
    const Real first = inverse * fma(inverse, Real(-0.0124253), Real(0.512853));
    const Real second =
        fma(inverse, fma(inverse, Real(0.309018), Real(0.00199093)), Real(0.0594438));
    const Real rest = fma(root, Real(0.023261), inverse * Real(-0.123963));
    const Real near_point = root * fma(root, fma(root, fma(root, rest, second), first), Real(1.0));
    const Real alpha = from.offset;
    Real ratio = fma(alpha, Real(0.01081185), Real(-0.1108123));
    ratio = fma(alpha, ratio, Real(0.4284739));
    ratio = fma(alpha, ratio, Real(-0.6940456));
    ratio = fma(alpha, ratio, Real(0.01608502));
    const Real first_branch = alpha * fma(alpha, ratio, Real(2.000571));
    return select(from.centre == Real(0.0), first_branch, near_point);
}

/// Index k of the cell (k pi, (k + 1) pi] that holds a speed >= 0; decided with the low part of pi
/// (H5).
template <class Real>
HOPSCOTCH_DEVICE inline Real cell_of(Real speed) {
    Real k = floor(speed * Real(0.31830988618379069));  // may be off by one, corrected below
    const auto beyond = [&](Real turns) {  // speed - turns * pi without cancellation error
        if constexpr (binary64_lane<Real>) {
            return fma(-turns, Real(2.0 * half_pi_parts::middle), fma(-turns, pi<Real>(), speed));
        } else {
            return speed - turns * pi<Real>();
        }
    };
    k = select(beyond(k) <= Real(0.0), k - Real(1.0), k);
    k = select(beyond(k + Real(1.0)) > Real(0.0), k + Real(1.0), k);
    return larger(k, Real(0.0));
}

/// Bracket of the only root of a lift-off flight (eta = 0): the half cell of the lossless point.
///
/// \param k  index of the cell, k pi < alpha <= (k + 1) pi
template <class Real>
HOPSCOTCH_DEVICE inline bracket<Real> lift_off_bracket(const launch<Real>& from, Real k) {
    const Real left = fma(k, pi<Real>(), -from.centre);
    const Real right = fma(k + Real(1.0), pi<Real>(), -from.centre);
    const mask_of<Real> after = from.offset >= Real(0.0);
    return {select(after, Real(0.0), left), select(after, right, Real(0.0))};
}

/// Bracket of the first root of a bounce (eta > 0, centre 0), on which H rises (page, section 3).
template <class Real>
HOPSCOTCH_DEVICE inline bracket<Real> bounce_bracket(const launch<Real>& from) {
    const Real speed = from.offset;
    bracket<Real> result{Real(0.0), pi<Real>()};
    if (!any(speed >= Real(3.1415))) return result;
    // H(m pi) = m pi, and V cot V changes sign there: which side of m pi a speed lies on decides
    const Real m = cell_of(speed);
    const mask_of<Real> is_fast = m >= Real(1.0);
    if (any(is_fast)) {
        const Real point = lossless_point(select(is_fast, m, Real(1.0))).high;
        const auto angle = sin_cos(speed);
        const mask_of<Real> grazes_first =
            (speed < point) & ((speed * angle.cos) / angle.sin >= Real(1.0) + from.eta);
        const Real left = select(grazes_first, m * pi<Real>(), point);
        const Real right = select(grazes_first, speed, (m + Real(1.0)) * pi<Real>());
        result.low = select(is_fast, left, result.low);
        result.high = select(is_fast, right, result.high);
    }
    return result;
}

/// Starting point for a bounce. Short ones last theta = 2 V + sqrt(4 V^2 + 12 eta); half of it,
/// written without cancellation for V < 0 (H3), is continued by a least-squares polynomial: within
/// 0.6 % on bounces sampled at M = 0.1 ... 1000. From V = pi on, the middle of the two ends the
/// root lies between.
template <class Real>
HOPSCOTCH_DEVICE inline Real bounce_guess(const launch<Real>& from) {
    constexpr double coefficient[6][6] = {
        {1.003669, -0.004362674, -0.006795545, -0.001882852, -0.000184943, -5.9593e-06},
        {0.01206859, -0.02675348, -0.009014498, -0.0009059759, -2.768147e-05},
        {0.08756648, -0.004029858, 0.0009804678, 7.7005e-05},
        {-0.009406283, 0.002678904, 2.91785e-05},
        {-9.781343e-05, -0.000258929},
        {5.386822e-05}};
    const Real speed = from.offset;
    const Real root = sqrt(fma(speed, speed, Real(3.0) * from.eta));
    const Real parabola =
        select(speed < Real(0.0), Real(3.0) * from.eta / (root - speed), speed + root);
    Real ratio(0.0);
#pragma GCC unroll 6
    for (int i = 5; i >= 0; --i) {
        Real row(coefficient[i][5 - i]);
#pragma GCC unroll 6
        for (int j = 4 - i; j >= 0; --j) row = fma(row, speed, Real(coefficient[i][j]));
        ratio = fma(ratio, parabola, row);
    }
    const Real right = (floor(speed / pi<Real>()) + Real(1.0)) * pi<Real>();
    return select(speed >= pi<Real>(), (speed + right) * Real(0.5), parabola / ratio);
}

/// First contact after a launch: the half flight time as xi, and every term at it.
///
/// \param from        the launch
/// \param k           cell of a lift-off (ignored for bounces)
/// \param is_bounce   lanes that start from eta > 0
/// \param wanted      lanes to solve
/// \return            terms at the first root (guaranteed: the bracket holds exactly one, the
/// first) \error             none
template <class Real>
HOPSCOTCH_DEVICE inline half_flight_terms<Real> first_contact(const launch<Real>& from, Real k,
                                                              mask_of<Real> is_bounce,
                                                              mask_of<Real> wanted) {
    const launch<primal_of<Real>> start = without_derivatives(from);
    using plain = primal_of<Real>;
    bracket<plain> within = lift_off_bracket(start, primal(k));
    plain guess = lift_off_guess(start);
    if (any(is_bounce & wanted)) {
        const bracket<plain> bounce = bounce_bracket(start);
        within.low = select(is_bounce, bounce.low, within.low);
        within.high = select(is_bounce, bounce.high, within.high);
        guess = select(is_bounce, bounce_guess(start), guess);
    }
    const auto rising = [&](const plain& xi) { return halley(start, terms_at(start, xi)); };
    const plain root = bracketed_root<plain, 3>(rising, within, guess, wanted);
    if constexpr (std::is_same_v<plain, Real>) {
        return terms_at(from, root);
    } else {
        const half_flight_terms<plain> at = terms_at(start, root);
        const half_flight_terms<Real> tangent = terms_at(from, Real(root));
        const plain slope = plain(2.0) * at.p * at.r / at.q;
        return terms_at(from, implicit_root(root, tangent.residual, slope));
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
