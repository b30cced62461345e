// Sums  1 - y/d_1 (1 - y/d_2 (1 - ...)):  the tails of sine and cosine that would cancel if they
// were computed from the functions themselves. Used by flows near their launch.
#pragma once

#include "kernels/lanes/lane.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Terms that make the nested sum exact to rounding where y <= 1 and d_n = (2 n + 2)(2 n + 3) or
/// more, or y <= 1/4 and d_n = 2 n (2 n + 3): the first one left out is 5e-17 for double.
template <class Real>
inline constexpr int series_terms = lane_traits<Real>::rounding > 0x1p-60    ? 7
                                    : lane_traits<Real>::rounding > 0x1p-110 ? 15
                                                                             : 26;

/// Nested alternating sum with divisors d(n) = (2 n + First) (2 n + Second), n = 1, 2, ...
template <int First, int Second, class Real>
HOPSCOTCH_DEVICE inline Real nested_sum(Real y) {
    Real sum(1.0);
#pragma GCC unroll 16
    for (int n = series_terms<Real>; n >= 1; --n) {
        const double divisor = (2.0 * n + First) * (2.0 * n + Second);
        if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
            sum = fma(-y * Real(1.0 / divisor), sum, Real(1.0));
        } else {
            sum = Real(1.0) - y / Real(divisor) * sum;
        }
    }
    return sum;
}

/// x - sin x cos x for |x| <= 1/2, to rounding (x^3 2/3 at the origin).
template <class Real>
HOPSCOTCH_DEVICE inline Real x_minus_sin_cos_series(Real x) {
    const Real square = x * x;
    return x * square * (Real(2.0) / Real(3.0)) * nested_sum<2, 3>(square * Real(4.0));
}

/// x^2 - sin^2 x for |x| <= 1/2, to rounding (x^4 / 3 at the origin).
template <class Real>
HOPSCOTCH_DEVICE inline Real square_minus_sin_square_series(Real x) {
    const Real square = x * x;
    return square * square / Real(3.0) * nested_sum<3, 4>(square * Real(4.0));
}

/// x cos x - sin x for |x| <= 1/2, to rounding (-x^3 / 3 at the origin).
template <class Real>
HOPSCOTCH_DEVICE inline Real x_cos_minus_sin_series(Real x) {
    const Real square = x * x;
    return -(x * square) / Real(3.0) * nested_sum<0, 3>(square);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
