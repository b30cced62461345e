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

/// Sine, cosine and the three brackets of H1 at xi, none of which cancels.
template <class Real>
struct bracket_terms {
    Real sin, cos;
    Real a;  // xi - sin xi cos xi
    Real b;  // xi^2 - sin^2 xi
    Real e;  // xi cos xi - sin xi
};

/// In double from the deficits of sine and cosine.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline bracket_terms<Real> brackets_at(const Real& xi) {
    const auto angle = sin_cos_deficits(xi);
    return {angle.sin, angle.cos, fma(angle.sin, angle.cosine_deficit, angle.sine_deficit),
            angle.sine_deficit * (xi + angle.sin),
            fma(-xi, angle.cosine_deficit, angle.sine_deficit)};
}

/// In other arithmetics by series below |xi| = 1/2.
template <class Real>
HOPSCOTCH_DEVICE inline bracket_terms<Real> brackets_at(const Real& xi) {
    const auto angle = sin_cos(xi);
    bracket_terms<Real> at{angle.sin, angle.cos, xi - angle.sin * angle.cos,
                           fma(xi, xi, -(angle.sin * angle.sin)), fma(xi, angle.cos, -angle.sin)};
    const mask_of<Real> is_small = abs(xi) < Real(0.5);
    if (any(is_small)) {
        at.a = select_form(is_small, x_minus_sin_cos_series(xi), at.a);
        at.b = select_form(is_small, square_minus_sin_square_series(xi), at.b);
        at.e = select_form(is_small, x_cos_minus_sin_series(xi), at.e);
    }
    return at;
}

/// Evaluates them at xi without cancellation.
template <class Real>
HOPSCOTCH_DEVICE inline half_flight_terms<Real> terms_at(const launch<Real>& from, Real xi) {
    const bracket_terms<Real> at = brackets_at(xi);
    const Real x = from.centre + xi;
    const Real sine = from.cosine * fma(from.centre, at.cos, at.sin);
    const Real cosine = from.cosine * fma(-from.centre, at.sin, at.cos);
    const Real q = select(from.centre == Real(0.0), at.a, fma(-sine, cosine, x));
    const Real p = from.cosine * fma(-(from.centre * x), at.sin, at.e);
    const Real r = fma(-from.eta, sine, p);
    const Real residual =
        fma(from.centre, at.a, at.b) - fma(from.eta * sine, sine, from.offset * q);
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

/// Starting point for a short bounce. It lasts theta = 2 V + sqrt(4 V^2 + 12 eta); half of it,
/// written without cancellation for V < 0 (H3), is continued by a polynomial. Its error, 2 % at
/// most, is spread so that two Halley steps reach every root below V = pi (their second is below
/// 9e-8 of x on bounces sampled at M = 0.1 ... 3000).
template <class Real>
HOPSCOTCH_DEVICE inline Real bounce_guess(const launch<Real>& from) {
    constexpr double coefficient[6][6] = {
        {1.007096, 0.008579701, -0.003912399, -0.002026906, -0.0002382166, -8.269128e-06},
        {-0.002574306, -0.05244798, -0.01667463, -0.001526672, -4.035934e-05},
        {0.1053856, 0.01157369, 0.004170035, 0.0002234502},
        {-0.01675098, -0.001015868, -0.0003444641},
        {0.001179934, 4.517409e-05},
        {-2.752254e-05}};
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
    return parabola / ratio;
}

/// Starting point for a bounce with V >= pi. In the distance t from a multiple of pi (`anchor`),
///   (anchor + t)(t - nu) = sin t ((1 + eta) sin t - V cos t),  nu = V - anchor:
/// the root of its quadratic part, corrected by a polynomial, and one Halley step with sines of
/// four digits. Two more steps then reach all but 7 in 10^4 of the bounces sampled at M = 2 ...
/// 3000; the rest is next to grazing.
template <class Real>
HOPSCOTCH_DEVICE inline Real fast_bounce_guess(const launch<Real>& from, Real anchor) {
    const Real one(1.0);
    const Real speed = from.offset;
    const Real pull = one + from.eta;
    const Real nu = speed - anchor;
    const Real inverse = one / speed;
    const Real ratio = pull * inverse;
    const Real first = nu / (one + sqrt(larger(fma(-ratio, nu, one), Real(0.0))));
    const Real bend = fma(fma(Real(0.2023887), ratio, Real(1.476065)), first,
                          fma(Real(0.3482298), ratio, Real(0.01208153)));
    const Real t = first * fma(first, fma(Real(-0.6218596), inverse, bend), Real(0.7658346));
    const Real square = t * t;
    const Real sine =
        t * fma(square,
                fma(square, fma(square, Real(-1.0 / 5040), Real(1.0 / 120)), Real(-1.0 / 6)), one);
    const Real cosine = fma(
        square,
        fma(square, fma(square, fma(square, Real(1.0 / 40320), Real(-1.0 / 720)), Real(1.0 / 24)),
            Real(-0.5)),
        one);
    const Real x = anchor + t;
    const Real gap = t - nu;
    const Real value = fma(x, gap, -(sine * fma(pull, sine, -(speed * cosine))));
    const Real double_sine = Real(2.0) * sine * cosine;  // of 2 t
    const Real double_cosine = fma(Real(-2.0) * sine, sine, one);
    const Real slope = fma(speed, double_cosine, fma(-pull, double_sine, x + gap));
    const Real curvature_half = fma(-speed, double_sine + double_sine, one) - pull * double_cosine;
    return x - value * slope / fma(slope, slope, -(value * curvature_half));
}

template <class Real>
struct bracketed_guess {
    bracket<Real> within;
    Real guess;
};

/// Bracket of the first root of a bounce (eta > 0, centre 0), on which H rises (page, section 3),
/// and a starting point.
template <class Real>
HOPSCOTCH_DEVICE inline bracketed_guess<Real> bounce_start(const launch<Real>& from) {
    const Real speed = from.offset;
    bracketed_guess<Real> result{{Real(0.0), pi<Real>()}, bounce_guess(from)};
    if (!any(speed >= Real(3.1415))) return result;
    // H(m pi) = m pi, and V cot V changes sign there: which side of m pi a speed lies on decides
    const Real m = cell_of(speed);
    const mask_of<Real> is_fast = m >= Real(1.0);
    if (any(is_fast)) {
        const Real point = lossless_point(select(is_fast, m, Real(1.0))).high;
        const auto angle = sin_cos(speed);
        // V cot V >= 1 + eta, without the division
        const Real along = negate_where(angle.sin < Real(0.0), speed * angle.cos);
        const mask_of<Real> grazes_first =
            (speed < point) & (along >= (Real(1.0) + from.eta) * abs(angle.sin));
        const Real before = m * pi<Real>();
        const Real after = (m + Real(1.0)) * pi<Real>();
        result.within.low = select(is_fast, select(grazes_first, before, point), result.within.low);
        result.within.high =
            select(is_fast, select(grazes_first, speed, after), result.within.high);
        result.guess = select(is_fast, fast_bounce_guess(from, select(grazes_first, before, after)),
                              result.guess);
    }
    return result;
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
        const bracketed_guess<plain> bounce = bounce_start(start);
        within.low = select(is_bounce, bounce.within.low, within.low);
        within.high = select(is_bounce, bounce.within.high, within.high);
        guess = select(is_bounce, bounce.guess, guess);
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
