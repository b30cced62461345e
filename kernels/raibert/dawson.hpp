// Dawson's integral D(x) = exp(-x^2) times the integral of exp(t^2) from 0 to x: the time a body
// takes through a stance on an air spring without gravity. Used by the pneumatic hoppers.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/lanes/lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::raibert {

/// Above this square the asymptotic series' smallest term, e^-square, is below rounding.
template <class Real>
inline constexpr int dawson_far = lane_traits<Real>::rounding > 0x1p-60    ? 40
                                  : lane_traits<Real>::rounding > 0x1p-110 ? 76
                                                                           : 152;

/// 1 / n, rounded once in the precision of Real.
template <class Real>
HOPSCOTCH_DEVICE inline Real reciprocal(double n) {
    if constexpr (lane_traits<Real>::rounding > 0x1p-60)
        return Real(1.0 / n);
    else
        return Real(1.0) / Real(n);
}

/// D(sqrt(square)) / sqrt(square).
///
/// \param square  >= 0
/// \error  a few ulp, up to 1e-14 relative at square = 40 (double)
/// Up to dawson_far the series exp(-q) sum of q^n / (n! (2 n + 1)), all terms positive; each lane's
/// sum stops changing on its own. Beyond, sum of (2 n - 1)!! / (2 q)^n over 2 q.
template <class Real>
HOPSCOTCH_DEVICE inline Real dawson_over_root(const Real& square) {
    constexpr int far = dawson_far<Real>;
    const Real one(1.0);
    const mask_of<Real> is_far = square > Real(static_cast<double>(far));
    const Real near = select(is_far, one, square);
    Real term = one;
    Real sum = one;
    mask_of<Real> grows = near > Real(0.0);
    for (int n = 1; n <= 8 * far && any(grows); ++n) {
        term = term * near * reciprocal<Real>(n);
        const Real next = fma(term, reciprocal<Real>(2.0 * n + 1.0), sum);
        grows = grows & (!(next == sum) | (near > Real(static_cast<double>(n))));
        sum = next;
    }
    Real result = exp(-near) * sum;
    if (any(is_far)) {
        const Real step = Real(0.5) / select(is_far, square, Real(static_cast<double>(far)));
        Real far_term = one;
        Real far_sum = one;
        for (int n = 1; n <= far; ++n) {
            far_term = far_term * step * Real(2.0 * n - 1.0);
            far_sum = far_sum + far_term;
        }
        result = select(is_far, far_sum * step, result);
    }
    return result;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::raibert
