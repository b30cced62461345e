// atan, atan2, asin and acos of double and pack: one quotient, reduced to |t| <= tan(pi/8).
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/error_free.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Angle in [0, pi] of the point (x, y), or of (-x, y) where `mirrored`.
///
/// \param y  >= 0, with its low part
/// \param x  >= 0, with its low part; not both zero, sums and products in the normal range
/// Below tan(pi/8) the quotient y/x is used, above tan(3 pi/8) -x/y from pi/2, between them
/// (y - x)/(y + x) from pi/4. Minimax for (atan t - t)/t^3, relative error 2^-59.5.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real upper_angle(const two_part<Real>& y, const two_part<Real>& x,
                                         const mask_of<Real>& mirrored) {
    const auto steep = y.high > Real(0x1.3504f333f9de6p+1) * x.high;
    const auto flat = y.high <= Real(0x1.a827999fcef32p-2) * x.high;
    const two_part<Real> difference = two_sum(y.high, -x.high);
    const two_part<Real> sum = two_sum(y.high, x.high);
    const two_part<Real> over{
        select(flat, y.high, select(steep, -x.high, difference.high)),
        select(flat, y.low, select(steep, -x.low, difference.low + (y.low - x.low)))};
    const two_part<Real> under{
        select(flat, x.high, select(steep, y.high, sum.high)),
        select(flat, x.low, select(steep, y.low, sum.low + (y.low + x.low)))};
    const two_part<Real> t = two_part_quotient(over, under);

    const Real square = t.high * t.high;
    const Real series = polynomial(
        square, -0x1.555555555553dp-2, 0x1.999999999589bp-3, -0x1.24924922af0cep-3,
        0x1.c71c70e6c9635p-4, -0x1.745cf8f1cfc5dp-4, 0x1.3b111a9399d8ep-4, -0x1.10ebc85c42925p-4,
        0x1.df1029daf3ac7p-5, -0x1.9cd66cc713db6p-5, 0x1.37de604221df8p-5, -0x1.257c0913f9ca3p-6);
    const Real rest = fma(t.high * square, series, t.low);

    constexpr double eighth_turn = 0x1.921fb54442d18p-1;
    constexpr double eighth_turn_low = 0x1.1a62633145c07p-55;
    const Real from_axis = select(flat, Real(0.0), select(steep, Real(2.0), Real(1.0)));
    const Real eighths = select(mirrored, Real(4.0) - from_axis, from_axis);
    const Real base = eighths * Real(eighth_turn);
    const Real base_low = fma(eighths, Real(eighth_turn), -base) + eighths * Real(eighth_turn_low);
    const two_part<Real> angle = fast_two_sum(base, select(mirrored, -t.high, t.high));
    return angle.high + (angle.low + (base_low + select(mirrored, -rest, rest)));
}

/// The arc tangent.
///
/// \error  at most 0.85 ulp; atan(+-infinity) = +-pi/2, signed zeros and tiny values kept
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real atan(const Real& x) {
    const Real size = select(abs(x) > Real(0x1p100), Real(0x1p100), abs(x));
    const Real zero(0.0);
    const Real one(1.0);
    return copysign(upper_angle<Real>({size, zero}, {one, zero}, one < zero), x);
}

/// Angle of the point (x, y) in [-pi, pi], with the signs and special cases of IEEE 754 (zeros,
/// infinities, axes).
///
/// \error  at most 0.85 ulp where the result is normal
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real atan2(const Real& y, const Real& x) {
    const Real zero(0.0);
    const Real one(1.0);
    const Real y_size = abs(y);
    const Real x_size = abs(x);
    const Real largest = select(x_size > y_size, x_size, y_size);

    // bring the larger of the two near 1, so that nothing over- or underflows on the way
    const Real wanted = -exponent(largest);
    const Real bounded = select(wanted < Real(-1022.0), Real(-1022.0), wanted);
    const Real scale = power_of_two(select(bounded > Real(1022.0), Real(1022.0), bounded));
    const auto is_infinite = largest == infinity<Real>();
    const Real y_near = select(is_infinite, select(y_size == largest, one, zero), y_size * scale);
    const Real x_finite = select(is_infinite, select(x_size == largest, one, zero), x_size * scale);
    const Real x_near = select(largest == zero, one, x_finite);

    const Real angle = upper_angle<Real>({y_near, zero}, {x_near, zero}, copysign(one, x) < zero);
    const Real result = copysign(angle, y);
    return select((x == x) & (y == y), result, not_a_number<Real>());
}

/// sqrt(1 - x^2) with its low part; 1 - x^2 is first split exactly.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline two_part<Real> cofunction(const Real& x) {
    const Real zero(0.0);
    const two_part<Real> square = two_product(x, x);
    const two_part<Real> difference = two_sum(Real(1.0), -square.high);
    const two_part<Real> root =
        two_part_sqrt(fast_two_sum(difference.high, difference.low - square.low));
    return {root.high, select(root.high == zero, zero, root.low)};
}

/// The arc sine, in [-pi/2, pi/2].
///
/// \error  at most 1 ulp; |x| > 1 gives NaN
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real asin(const Real& x) {
    const Real zero(0.0);
    return copysign(upper_angle<Real>({abs(x), zero}, cofunction(x), Real(1.0) < zero), x);
}

/// The arc cosine, in [0, pi].
///
/// \error  at most 1 ulp; |x| > 1 gives NaN
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real acos(const Real& x) {
    const Real zero(0.0);
    return upper_angle<Real>(cofunction(x), {abs(x), zero}, x < zero);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
