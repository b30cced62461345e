// exp and expm1 of double and pack, and the reduced forms that the hyperbolic functions build on.
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/error_free.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// e^x = 2^doublings (1 + linear + rest) with |linear| <= ln 2 / 2.
template <class Real>
struct reduced_exponential {
    Real doublings, linear, rest;
};

/// \param x  finite or NaN, |x| < 800
/// x - n ln2_high is exact (both are multiples of 2^-54 and the difference is below 0.35). Minimax
/// for (e^r - 1 - r) / r^2, error 2^-60.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline reduced_exponential<Real> reduce_exponential(const Real& x) {
    const Real turns = nearest(x * Real(0x1.71547652b82fep+0));
    const Real n = select(turns == turns, turns, Real(0.0));
    const Real exact = fma(-n, Real(ln2_parts::high), x);
    const Real linear = fma(-n, Real(ln2_parts::low), exact);
    const Real low = fma(-n, Real(ln2_parts::low), exact - linear);
    const Real series = polynomial(
        linear, 0.5, 0x1.555555555555cp-3, 0x1.555555555555ep-5, 0x1.111111110ebadp-7,
        0x1.6c16c16c1354cp-10, 0x1.a01a01b3bf104p-13, 0x1.a01a01b467e7fp-16, 0x1.71ddef8687278p-19,
        0x1.27e4bf0a08364p-22, 0x1.af6ce88fb5bf9p-26, 0x1.1f9e2a53d5fc1p-29);
    return {n, linear, fma(linear * linear, series, low)};
}

/// x moved into [lowest, highest]; NaN stays.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real clamped(const Real& x, double lowest, double highest) {
    const Real below = select(x > Real(highest), Real(highest), x);
    return select(below < Real(lowest), Real(lowest), below);
}

/// The natural exponential.
///
/// \error  at most 0.7 ulp; 1 ulp where the result is denormal (rounded twice); above 709.78...
///         infinity, below -745.13... zero
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real exp(const Real& x) {
    const reduced_exponential<Real> e = reduce_exponential(clamped(x, -746.0, 710.0));
    const two_part<Real> sum = fast_two_sum(Real(1.0), e.linear);
    const Real mantissa = sum.high + (sum.low + e.rest);
    const Real half =
        floor(e.doublings * Real(0.5));  // 2^n itself may lie outside the normal range
    return (mantissa * power_of_two(half)) * power_of_two(e.doublings - half);
}

/// (e^x - 1) / 4 to about 2^-56 relative, as high + low. The quarter keeps sinh and cosh from
/// overflowing early.
///
/// \param x  NaN or in [-60, 710.6]
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline two_part<Real> quarter_expm1(const Real& x) {
    const reduced_exponential<Real> e = reduce_exponential(x);
    const Real scale = power_of_two(e.doublings - Real(2.0));
    const two_part<Real> constant = two_sum(scale, Real(-0.25));
    const two_part<Real> sum = two_sum(constant.high, scale * e.linear);
    return fast_two_sum(sum.high, sum.low + fma(scale, e.rest, constant.low));
}

/// e^x - 1.
///
/// \error  at most 1.2 ulp; expm1(-0) = -0
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real expm1(const Real& x) {
    const two_part<Real> quarter = quarter_expm1(clamped(x, -60.0, 710.0));
    const Real result = Real(4.0) * (quarter.high + quarter.low);
    return select(abs(x) < Real(0x1p-54), x, result);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
