// The elementary functions of dual numbers, by the chain rule from those of the primal arithmetic.
// Included by kernels/lanes/dual.hpp.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/lanes/dual.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class T, int N>
HOPSCOTCH_DEVICE inline sine_cosine<dual<T, N>> sin_cos(const dual<T, N>& x) {
    const sine_cosine<T> turn = sin_cos(x.value);
    return {chain(x, turn.sin, turn.cos), chain(x, turn.cos, -turn.sin)};
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> sin(const dual<T, N>& x) {
    return sin_cos(x).sin;
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> cos(const dual<T, N>& x) {
    return sin_cos(x).cos;
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> tan(const dual<T, N>& x) {
    const T value = tan(x.value);
    return chain(x, value, fma(value, value, T(1.0)));
}

template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> exp(const dual<T, N>& x) {
    const T value = exp(x.value);
    return chain(x, value, value);
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> expm1(const dual<T, N>& x) {
    return chain(x, expm1(x.value), exp(x.value));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> log(const dual<T, N>& x) {
    return chain(x, log(x.value), T(1.0) / x.value);
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> log1p(const dual<T, N>& x) {
    return chain(x, log1p(x.value), T(1.0) / (T(1.0) + x.value));
}

template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> atan(const dual<T, N>& x) {
    return chain(x, atan(x.value), T(1.0) / fma(x.value, x.value, T(1.0)));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> atan2(const dual<T, N>& y, const dual<T, N>& x) {
    const T square = fma(x.value, x.value, y.value * y.value);
    return dual<T, N>::with_slopes(atan2(y.value, x.value), [&](int i) {
        return fma(x.value, y.slope[i], -(y.value * x.slope[i])) / square;
    });
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> asin(const dual<T, N>& x) {
    return chain(x, asin(x.value), T(1.0) / sqrt(fma(-x.value, x.value, T(1.0))));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> acos(const dual<T, N>& x) {
    return chain(x, acos(x.value), T(-1.0) / sqrt(fma(-x.value, x.value, T(1.0))));
}

template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> sinh(const dual<T, N>& x) {
    return chain(x, sinh(x.value), cosh(x.value));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> cosh(const dual<T, N>& x) {
    return chain(x, cosh(x.value), sinh(x.value));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> tanh(const dual<T, N>& x) {
    const T cosine = cosh(x.value);
    return chain(x, tanh(x.value), T(1.0) / (cosine * cosine));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> asinh(const dual<T, N>& x) {
    return chain(x, asinh(x.value), T(1.0) / sqrt(fma(x.value, x.value, T(1.0))));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> atanh(const dual<T, N>& x) {
    return chain(x, atanh(x.value), T(1.0) / fma(-x.value, x.value, T(1.0)));
}
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> cbrt(const dual<T, N>& x) {
    const T root = cbrt(x.value);
    return chain(x, root, T(1.0) / (T(3.0) * root * root));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
