// Sums and products split into the rounded result and its exact rounding error, and polynomials by
// Horner's rule. The bricks of the elementary functions and of double_double.
#pragma once

#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// A number as the unevaluated sum high + low, |low| far below |high|.
template <class Real>
struct two_part {
    Real high, low;
};

/// a + b exactly (Knuth); no condition on the sizes.
template <class Real>
HOPSCOTCH_DEVICE inline two_part<Real> two_sum(const Real& a, const Real& b) {
    const Real sum = a + b;
    const Real b_seen = sum - a;
    return {sum, (a - (sum - b_seen)) + (b - b_seen)};
}

/// a + b exactly (Dekker) where |a| >= |b|, or a = 0, or a is a multiple of b's last bit.
template <class Real>
HOPSCOTCH_DEVICE inline two_part<Real> fast_two_sum(const Real& a, const Real& b) {
    const Real sum = a + b;
    return {sum, b - (sum - a)};
}

/// a * b exactly, barring underflow.
template <class Real>
HOPSCOTCH_DEVICE inline two_part<Real> two_product(const Real& a, const Real& b) {
    const Real product = a * b;
    return {product, fma(a, b, -product)};
}

/// numerator / denominator of two unevaluated sums, to about 2^-100 of the quotient; no condition
/// on the sizes except that the quotient and the products with it stay in the normal range.
template <class Real>
HOPSCOTCH_DEVICE inline two_part<Real> two_part_quotient(const two_part<Real>& numerator,
                                                         const two_part<Real>& denominator) {
    const Real quotient = numerator.high / denominator.high;
    const Real rest = fma(-quotient, denominator.high, numerator.high);
    const Real low = fma(-quotient, denominator.low, rest + numerator.low);
    return {quotient, low / denominator.high};
}

/// Square root of high + low, where high > 0 is normal.
template <class Real>
HOPSCOTCH_DEVICE inline two_part<Real> two_part_sqrt(const two_part<Real>& x) {
    const Real root = sqrt(x.high);
    return {root, (fma(-root, root, x.high) + x.low) / (root + root)};
}

/// c0 + c1 x + c2 x^2 + ..., by fused Horner steps.
template <class Real>
HOPSCOTCH_DEVICE inline Real polynomial(const Real&, double c0) {
    return Real(c0);
}
template <class Real, class... Doubles>
HOPSCOTCH_DEVICE inline Real polynomial(const Real& x, double c0, Doubles... higher) {
    return fma(x, polynomial(x, higher...), Real(c0));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
