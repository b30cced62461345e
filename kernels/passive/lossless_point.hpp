// The lossless motions of the passive hopper: alpha*_k = tan alpha*_k, kept as a double and the
// rest, so that a lift-off speed next to one is known by its distance to it. Used wherever a flight
// starts.
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/lanes/double_double.hpp"
#include "kernels/lanes/dual.hpp"
#include "kernels/lanes/lane.hpp"
#include "kernels/passive/lossless_table.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// A lossless point alpha*_k = high + low (high: rounded) and its cosine.
template <class Real>
using lossless = tabulated_point<Real>;

/// pi/2 - alpha*_k + k pi, the small angle delta with cot delta = alpha*_k, to working precision.
///
/// \param turns  z = (k + 1/2) pi, k >= 1
/// The asymptotic series starts Newton's method on (z - delta) sin delta = cos delta.
template <class Real>
HOPSCOTCH_DEVICE inline Real lossless_angle(Real turns, int newton_steps) {
    const Real inverse = Real(1.0) / turns;
    const Real square = inverse * inverse;
    Real delta = inverse * (Real(1.0) + square * (Real(0.66666666666666663) +
                                                  square * (Real(0.8666666666666667) +
                                                            square * Real(1.3904761904761904))));
    for (int i = 0; i < newton_steps; ++i) {
        const auto angle = sin_cos(delta);
        const Real alpha = turns - delta;
        delta = delta - (alpha * angle.sin - angle.cos) / (alpha * angle.cos);
    }
    return delta;
}

/// (-1)^k / sqrt(1 + alpha^2) = cos alpha*_k.
template <class Real>
HOPSCOTCH_DEVICE inline Real lossless_cosine(Real k, Real alpha) {
    const Real half = k * Real(0.5);
    const Real sign = select(floor(half) == half, Real(1.0), Real(-1.0));
    return sign / sqrt(fma(alpha, alpha, Real(1.0)));
}

/// Beyond the table, k >= 64: one Newton step in double-double takes the angle from one to two
/// double precisions.
template <class Real>
HOPSCOTCH_DEVICE inline lossless<Real> lossless_by_newton(Real k) {
    using wide = double_double<Real>;
    const wide turns = (wide(k) + wide(0.5)) * pi<wide>();
    const wide delta(lossless_angle(turns.high, 3));
    const auto angle = sin_cos(delta);
    const wide alpha = turns - delta;
    const wide exact = alpha + (alpha * angle.sin - angle.cos) / (alpha * angle.cos);
    return {exact.high, exact.low, lossless_cosine(k, exact.high)};
}

/// alpha*_k of CPRR Eq (12), k = 0, 1, 2, ... (alpha*_0 = 0).
///
/// \param k  integral, lane-wise
/// \error    |high + low - alpha*_k| about rounding^2; low = 0 in the slow arithmetics, whose own
/// precision
///           is enough
template <class Real>
HOPSCOTCH_DEVICE inline lossless<Real> lossless_point(Real k) {
    if constexpr (binary64_lane<Real>) {
        const mask_of<Real> is_far = k >= Real(n_tabulated);
        // idle lanes may hold anything, also NaN
        const mask_of<Real> is_near = (k >= Real(0.0)) & (k < Real(n_tabulated));
        lossless<Real> point = lossless_from_table(select(is_near, k, Real(0.0)));
        if (any(is_far)) {
            const lossless<Real> far = lossless_by_newton(select(is_far, k, Real(n_tabulated)));
            point = {select(is_far, far.high, point.high), select(is_far, far.low, point.low),
                     select(is_far, far.cosine, point.cosine)};
        }
        return point;
    } else {
        const mask_of<Real> none = k < Real(0.5);
        const Real turns = (select(none, Real(1.0), k) + Real(0.5)) * pi<Real>();
        const Real alpha = select(none, Real(0.0), turns - lossless_angle(turns, 6));
        return {alpha, Real(0.0), lossless_cosine(k, alpha)};
    }
}

/// The same for dual numbers: a constant.
template <class T, int N>
HOPSCOTCH_DEVICE inline lossless<dual<T, N>> lossless_point(const dual<T, N>& k) {
    const lossless<T> point = lossless_point(primal(k));
    return {dual<T, N>(point.high), dual<T, N>(point.low), dual<T, N>(point.cosine)};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
