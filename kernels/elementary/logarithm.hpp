// log and log1p of double and pack, and log1p of an unevaluated sum for the inverse hyperbolic
// functions.
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/error_free.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// n ln 2 + log(1 + f + low), for f in [sqrt(1/2) - 1, sqrt(2) - 1] and |low| below 2^-52.
/// With s = f / (2 + f): log(1 + f) = f - f^2/2 + s (f^2/2 + R(s^2)); minimax R, error 2^-59.5.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real log_of_parts(const Real& n, const Real& f, const Real& low) {
    constexpr double ln2_short = 0x1.62e42fefa3800p-1;  // 42 bits: n times it is exact
    constexpr double ln2_rest = 0x1.ef35793c76730p-45;
    const Real s = f / (Real(2.0) + f);
    const Real square = s * s;
    const Real series =
        square * polynomial(square, 0x1.5555555555593p-1, 0x1.999999997f9f8p-2,
                            0x1.249249422a477p-2, 0x1.c71c51d7cccb9p-3, 0x1.746649b031f3ep-3,
                            0x1.39a0957578c81p-3, 0x1.2f11808540cb9p-3);
    const Real half_square = Real(0.5) * f * f;
    // low / (1 + f) by 1 / (1 + f) = (1 - s) / (1 + s), good to s^3: far more than low needs
    const Real low_part = low * (Real(1.0) - s) * fma(s, s - Real(1.0), Real(1.0));
    const Real small = fma(n, Real(ln2_rest), low_part);
    const two_part<Real> sum = fast_two_sum(n * Real(ln2_short), f);
    return sum.high + (sum.low - (half_square - fma(s, half_square + series, small)));
}

/// x = 2^n (1 + f), f in [sqrt(1/2) - 1, sqrt(2) - 1], for positive normal x.
template <class Real>
struct log_parts {
    Real n, f;
};

template <binary64_lane Real>
HOPSCOTCH_DEVICE inline log_parts<Real> split_log(const Real& x) {
    const Real m = mantissa(x);
    const auto upper = m > Real(0x1.6a09e667f3bcdp+0);
    const Real n = exponent(x);
    return {select(upper, n + Real(1.0), n), select(upper, m * Real(0.5), m) - Real(1.0)};
}

/// The natural logarithm.
///
/// \error  at most 0.9 ulp, denormals included; log(0) = -infinity, negative x and NaN give NaN
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real log(const Real& x) {
    const auto is_small = x < Real(0x1p-1022);
    const log_parts<Real> parts = split_log(select(is_small, x * Real(0x1p54), x));
    const Real n = select(is_small, parts.n - Real(54.0), parts.n);
    const Real result = log_of_parts(n, parts.f, Real(0.0));
    const Real special = select(x == Real(0.0), -infinity<Real>(), not_a_number<Real>());
    return select(x > Real(0.0), select(x < infinity<Real>(), result, x), special);
}

/// log(1 + x + x_low), |x_low| <= ulp(x).
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real log1p_of_sum(const Real& x, const Real& x_low) {
    const two_part<Real> sum = two_sum(Real(1.0), x);
    const log_parts<Real> parts = split_log(sum.high);
    // the error of 1 + x matters only while 1 and x are of comparable size
    const Real n_bounded = select(parts.n < Real(200.0), parts.n, Real(200.0));
    const Real scaled_low = (sum.low + x_low) * power_of_two(-n_bounded);
    const auto direct = (x > Real(-0.29)) & (x < Real(0.41));
    const Real zero(0.0);
    const Real result =
        log_of_parts(select(direct, zero, parts.n), select(direct, x, parts.f),
                     select(direct, x_low, select(parts.n < Real(200.0), scaled_low, zero)));
    const Real special = select(x == Real(-1.0), -infinity<Real>(), not_a_number<Real>());
    return select(x > Real(-1.0), select(x < infinity<Real>(), result, x), special);
}

/// log(1 + x).
///
/// \error  at most 0.9 ulp; log1p(-1) = -infinity, below that NaN; log1p(-0) = -0
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real log1p(const Real& x) {
    return select(abs(x) < Real(0x1p-54), x, log1p_of_sum(x, Real(0.0)));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
