// Sine, cosine and tangent of double and pack: the hot functions of exact flows. Both of a pair
// cost hardly more than one.
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/error_free.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class Real>
struct sine_cosine {
    Real sin, cos;
};

/// x = n pi/2 + (high - minus_low), |high| <= pi/4 (1 + 2^-12). The bits of n are those of
/// `counter`.
template <class Real>
struct quarter_turns {
    Real counter, high, minus_low;
};

/// Splits off quarter turns so that the remainder keeps its relative accuracy next to every
/// multiple of pi/2. n pi/2 is taken off in three parts. The first fma is exact, because x and n
/// pi_1 are multiples of 2^-53 and their difference is below 1. That difference is a multiple of
/// the last bit of n pi_2 (|n| < 2^40), so the second one's error is exact too (Boldo, Graillat,
/// Muller 2017).
///
/// \error  |x| > 2^40 and non-finite x give NaN
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline quarter_turns<Real> split_quarter_turns(const Real& x) {
    constexpr double largest = 0x1p40;
    constexpr double round_to_integer = 0x1.8p52;
    const Real counter = fma(x, Real(0x1.45f306dc9c883p-1), Real(round_to_integer));
    const Real n =
        select(abs(x) <= Real(largest), counter - Real(round_to_integer), not_a_number<Real>());
    const Real rest = fma(n, Real(-half_pi_parts::high), x);
    const Real middle = n * Real(half_pi_parts::middle);
    const Real high = rest - middle;
    const Real error = fma(n, Real(half_pi_parts::middle), high - rest);
    return {counter, high, fma(n, Real(half_pi_parts::low), error)};
}

/// -(sin r - r) for r = high - minus_low; the sign lets a negative zero through `high - result`.
/// Minimax on |r| <= pi/4, relative error of the sine 2^-57.9.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real sine_deficit(const quarter_turns<Real>& r, const Real& square) {
    const Real series =
        polynomial(square, 0x1.5555555555548p-3, -0x1.111111110f730p-7, 0x1.a01a019be9216p-13,
                   -0x1.71de35552b274p-19, 0x1.ae5e4b83a550ap-26, -0x1.5d8b55792489ep-33);
    return fma(r.high * square, series, r.minus_low);
}

/// (cos r - 1) / square. Minimax on |r| <= pi/4, error of the cosine 2^-63.9.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real cosine_slope(const Real& square) {
    return polynomial(square, -0.5, 0x1.555555555554bp-5, -0x1.6c16c16c15013p-10,
                      0x1.a01a019c8ed0dp-16, -0x1.27e4f7f141a04p-22, 0x1.1ee9db8ec244bp-29,
                      -0x1.8fa65ef2a2c70p-37);
}

/// Sine and cosine.
///
/// \error  at most 0.9 ulp each for |x| <= 2^40, relative accuracy kept next to every zero; beyond
///         and for non-finite x NaN. sin(-0) = -0.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline sine_cosine<Real> sin_cos(const Real& x) {
    const quarter_turns<Real> r = split_quarter_turns(x);
    const Real square = r.high * r.high;
    const Real sine = r.high - sine_deficit(r, square);
    const Real cosine = fma(r.high, fma(r.high, cosine_slope(square), r.minus_low), Real(1.0));

    const auto swapped = has_bit<0>(r.counter);
    const auto reversed = has_bit<1>(r.counter);
    const Real sine_of_half_turn = select(swapped, cosine, sine);
    const Real cosine_of_half_turn = select(swapped, -sine, cosine);
    return {negate_where(reversed, sine_of_half_turn), negate_where(reversed, cosine_of_half_turn)};
}

/// Sine and cosine with what they fall short by: x - sin x and 1 - cos x.
template <class Real>
struct sine_cosine_deficits {
    Real sin, cos;
    Real sine_deficit, cosine_deficit;
};

/// Sine, cosine and their deficits at hardly more than the cost of sin_cos.
///
/// \error  sine and cosine as sin_cos. Deficits: relative 3 ulp for |x| < 1/2 (minimax on |x| <=
///         pi/4, relative error 2^-63.6), beyond as the differences of rounded numbers
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline sine_cosine_deficits<Real> sin_cos_deficits(const Real& x) {
    const quarter_turns<Real> r = split_quarter_turns(x);
    const Real square = r.high * r.high;
    const Real series =
        polynomial(square, 0x1.5555555555555p-3, -0x1.1111111111110p-7, 0x1.a01a01a019926p-13,
                   -0x1.71de3a545e911p-19, 0x1.ae64540f86ef8p-26, -0x1.61217ca4ca32ep-33,
                   0x1.ab167f03900fep-41);
    const Real short_sine = fma(r.high * square, series, r.minus_low);
    const Real chord = fma(r.high, cosine_slope(square), r.minus_low);
    const Real sine = r.high - short_sine;
    const Real cosine = fma(r.high, chord, Real(1.0));

    const auto swapped = has_bit<0>(r.counter);
    const auto reversed = has_bit<1>(r.counter);
    const Real full_sine = negate_where(reversed, select(swapped, cosine, sine));
    const Real full_cosine = negate_where(reversed, select(swapped, -sine, cosine));
    const auto is_small = abs(x) < Real(0.5);
    return {full_sine, full_cosine, select(is_small, short_sine, x - full_sine),
            select(is_small, -(r.high * chord), Real(1.0) - full_cosine)};
}

template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real sin(const Real& x) {
    return sin_cos(x).sin;
}

template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real cos(const Real& x) {
    return sin_cos(x).cos;
}

/// Tangent, as the quotient of unrounded sine and cosine.
///
/// \error  as sin_cos; at most 1 ulp
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real tan(const Real& x) {
    const quarter_turns<Real> r = split_quarter_turns(x);
    const Real square = r.high * r.high;
    // the low part enters the sine with weight cos(high): 1 - high^2 / 2 is near enough
    const quarter_turns<Real> weighted{r.counter, r.high,
                                       r.minus_low * fma(Real(-0.5), square, Real(1.0))};
    const two_part<Real> sine = fast_two_sum(r.high, -sine_deficit(weighted, square));
    // cos = 1 + high (high slope + minus_low)
    const Real slope = cosine_slope(square);
    const Real chord = fma(r.high, slope, r.minus_low);
    const Real chord_error = fma(r.high, slope, -chord) + r.minus_low;
    const two_part<Real> product = two_product(r.high, chord);
    two_part<Real> cosine = fast_two_sum(Real(1.0), product.high);
    cosine.low = cosine.low + fma(r.high, chord_error, product.low);

    const auto swapped = has_bit<0>(r.counter);
    const two_part<Real> over{select(swapped, -cosine.high, sine.high),
                              select(swapped, -cosine.low, sine.low)};
    const two_part<Real> under{select(swapped, sine.high, cosine.high),
                               select(swapped, sine.low, cosine.low)};
    const two_part<Real> quotient = two_part_quotient(over, under);
    return select(x == Real(0.0), x, quotient.high + quotient.low);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
