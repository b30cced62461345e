// cbrt of double and pack: a polynomial start, one step of Halley, one of Newton on the exact
// residual.
#pragma once

#include "kernels/elementary/error_free.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Cube root of y in [1, 8), from the start's relative error 2^-16.7 over 2^-50 to half an ulp.
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real polished_cube_root(const Real& y, const Real& start) {
    const Real cube = start * start * start;
    const Real root = start * ((cube + Real(2.0) * y) / (Real(2.0) * cube + y));
    const two_part<Real> square = two_product(root, root);
    const Real residual = fma(-root, square.high, y) - root * square.low;
    return root + residual / (Real(3.0) * square.high);
}

/// The real cube root.
///
/// \error  at most 0.51 ulp, denormals included; signed zeros, infinities and NaN are kept
template <binary64_lane Real>
HOPSCOTCH_DEVICE inline Real cbrt(const Real& x) {
    const Real size = abs(x);
    const auto is_small = size < Real(0x1p-1022);
    const Real normal = select(is_small, size * Real(0x1p54), size);
    const Real m = mantissa(normal);
    const Real e = exponent(normal);
    const Real thirds = floor((e + Real(0.5)) * Real(0x1.5555555555555p-2));
    const Real left = e - Real(3.0) * thirds;  // 0, 1 or 2
    const Real factor =
        select(left == Real(0.0), Real(1.0), select(left == Real(1.0), Real(2.0), Real(4.0)));
    const Real factor_root =
        select(left == Real(0.0), Real(1.0),
               select(left == Real(1.0), Real(0x1.428a2f98d728bp+0), Real(0x1.965fea53d6e3dp+0)));
    const Real start = factor_root * polynomial(m, 0x1.0392c44551a05p-1, 0x1.6fb1f265b2258p-1,
                                                -0x1.33d39f4fc4881p-2, 0x1.60a16d155891dp-4,
                                                -0x1.5b77f5a105c16p-7);
    const Real scale = power_of_two(select(is_small, thirds - Real(18.0), thirds));
    const Real result = copysign(polished_cube_root(factor * m, start) * scale, x);
    const auto ordinary = (size > Real(0.0)) & (size < Real(__builtin_inf()));
    return select(ordinary, result, x + x);
}

/// A starting point for iterations that need a cube root: relative error 2^-16, x = 0 gives a tiny
/// number, non-finite and denormal x anything.
template <class Real>
HOPSCOTCH_DEVICE inline Real rough_cbrt(const Real& x) {
    if constexpr (binary64_lane<Real>) {
        const Real size = abs(x);
        const Real e = exponent(size);
        const Real m = mantissa(size);
        const Real thirds = floor((e + Real(0.5)) * Real(0x1.5555555555555p-2));
        const Real left = e - Real(3.0) * thirds;
        const Real factor_root = select(
            left == Real(0.0), Real(1.0),
            select(left == Real(1.0), Real(0x1.428a2f98d728bp+0), Real(0x1.965fea53d6e3dp+0)));
        const Real root =
            polynomial(m, 0x1.0392c44551a05p-1, 0x1.6fb1f265b2258p-1, -0x1.33d39f4fc4881p-2,
                       0x1.60a16d155891dp-4, -0x1.5b77f5a105c16p-7);
        return copysign(factor_root * root * power_of_two(thirds), x);
    } else {
        return cbrt(x);
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
