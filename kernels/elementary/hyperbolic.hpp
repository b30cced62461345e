// sinh, cosh, tanh, asinh and atanh of double and pack, from exponentials and logarithms carried in
// two parts.
#pragma once

#include "kernels/elementary/exponential.hpp"
#include "kernels/elementary/logarithm.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// high + low of the sum of two unevaluated sums, rounded.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real rounded_sum(const two_part<Real>& a, const two_part<Real>& b) {
    const two_part<Real> sum = two_sum(a.high, b.high);
    return sum.high + (sum.low + (a.low + b.low));
}

/// constant + a.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline two_part<Real> shifted(double constant, const two_part<Real>& a) {
    const two_part<Real> sum = two_sum(Real(constant), a.high);
    return {sum.high, sum.low + a.low};
}

/// \error  at most 1 ulp; overflows where the result does
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real sinh(const Real& x) {
    const Real size = clamped(abs(x), 0.0, 710.6);
    const two_part<Real> e =
        quarter_expm1(size);  // (e^x - 1) / 4; e^-x (e^x - 1) is the other half
    const auto decayed = size > Real(40.0);
    const two_part<Real> safe{select(decayed, Real(0.0), e.high), e.low};
    const two_part<Real> other = two_part_quotient(safe, shifted(0.25, safe));
    const Real sum = rounded_sum<Real>(e, {Real(0.25) * other.high, Real(0.25) * other.low});
    const Real result = Real(2.0) * select(decayed, e.high + e.low, sum);
    return select(abs(x) < Real(0x1p-28), x, copysign(result, x));
}

/// \error  at most 0.7 ulp; overflows where the result does
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real cosh(const Real& x) {
    const Real size = clamped(abs(x), 0.0, 710.6);
    const two_part<Real> growing = shifted(0.25, quarter_expm1(size));  // e^x / 4
    const auto decayed = size > Real(40.0);
    const two_part<Real> safe{select(decayed, Real(1.0), growing.high), growing.low};
    const two_part<Real> decaying = two_part_quotient<Real>({Real(0.0625), Real(0.0)}, safe);
    const Real sum = rounded_sum(growing, decaying);
    return Real(2.0) * select(decayed, growing.high + growing.low, sum);
}

/// \error  at most 1 ulp
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real tanh(const Real& x) {
    const Real size = clamped(abs(x), 0.0, 22.0);
    const two_part<Real> e = quarter_expm1(size + size);
    const two_part<Real> quotient = two_part_quotient(e, shifted(0.5, e));
    const Real result = quotient.high + quotient.low;
    return select(abs(x) < Real(0x1p-28), x, copysign(result, x));
}

/// log1p of x + x^2 / (1 + sqrt(1 + x^2)), carried in two parts; log(2 x) where x^2 alone remains.
///
/// \error  at most 0.9 ulp
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real asinh(const Real& x) {
    constexpr double large = 0x1p30;
    const Real one(1.0);
    const Real size = abs(x);
    const auto is_large = size > Real(large);
    const Real near = select(is_large, Real(large), size);
    const two_part<Real> square = two_product(near, near);
    const two_part<Real> root = two_part_sqrt(shifted(1.0, square));
    const two_part<Real> excess = two_part_quotient(square, shifted(1.0, root));
    const two_part<Real> sum = two_sum(near, excess.high);
    const Real small_result = log1p_of_sum(sum.high, sum.low + excess.low);

    const log_parts<Real> parts = split_log(select(size < infinity<Real>(), size, one));
    const Real large_result = log_of_parts(parts.n + one, parts.f, Real(0.0));
    const Real finite = select(is_large, large_result, small_result);
    const Real result = select(size < infinity<Real>(), finite, size);
    return select(size < Real(0x1p-28), x, copysign(result, x));
}

/// Half of log1p(2 x / (1 - x)), the quotient carried in two parts.
///
/// \error  at most 0.9 ulp; atanh(+-1) = +-infinity, beyond that NaN
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real atanh(const Real& x) {
    const Real one(1.0);
    const Real zero(0.0);
    const Real size = abs(x);
    const two_part<Real> quotient =
        two_part_quotient<Real>({size + size, zero}, two_sum(one, -size));
    const Real result = Real(0.5) * log1p_of_sum(quotient.high, quotient.low);
    const Real edge = select(size == one, infinity<Real>(), not_a_number<Real>());
    const Real signed_result = copysign(select(size < one, result, edge), x);
    return select(size < Real(0x1p-28), x, signed_result);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
