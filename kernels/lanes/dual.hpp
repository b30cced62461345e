// Forward-mode dual numbers: a value and N derivatives, over any primal arithmetic. Running a model
// in them gives the exact derivatives of its return map; the values are bit for bit those of the
// primal.
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/lanes/implicit_root.hpp"
#include "kernels/lanes/scalar.hpp"

#include <type_traits>

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class T, int N>
struct dual {
    T value;
    T slope[N];

    dual() = default;
    HOPSCOTCH_DEVICE dual(
        double x)  // NOLINT(google-explicit-constructor): constants mix with lanes
        : value(x) {
        for (int i = 0; i < N; ++i) slope[i] = T(0.0);
    }
    HOPSCOTCH_DEVICE dual(const T& x)  // NOLINT(google-explicit-constructor): so do primal values
        requires(!std::same_as<T, double>)
        : value(x) {
        for (int i = 0; i < N; ++i) slope[i] = T(0.0);
    }
    /// The i-th independent variable.
    HOPSCOTCH_DEVICE static dual variable(const T& x, int i) {
        dual result(x);
        result.slope[i] = T(1.0);
        return result;
    }
    /// A value with slopes given by a function of their index.
    template <class Function>
    HOPSCOTCH_DEVICE static dual with_slopes(const T& value, Function&& function) {
        dual result;
        result.value = value;
        for (int i = 0; i < N; ++i) result.slope[i] = function(i);
        return result;
    }

    friend HOPSCOTCH_DEVICE dual operator+(const dual& a, const dual& b) {
        return with_slopes(a.value + b.value, [&](int i) { return a.slope[i] + b.slope[i]; });
    }
    friend HOPSCOTCH_DEVICE dual operator-(const dual& a, const dual& b) {
        return with_slopes(a.value - b.value, [&](int i) { return a.slope[i] - b.slope[i]; });
    }
    friend HOPSCOTCH_DEVICE dual operator*(const dual& a, const dual& b) {
        return with_slopes(a.value * b.value,
                           [&](int i) { return fma(a.value, b.slope[i], a.slope[i] * b.value); });
    }
    friend HOPSCOTCH_DEVICE dual operator/(const dual& a, const dual& b) {
        const T quotient = a.value / b.value;
        return with_slopes(quotient,
                           [&](int i) { return fma(-quotient, b.slope[i], a.slope[i]) / b.value; });
    }
    friend HOPSCOTCH_DEVICE dual operator-(const dual& a) {
        return with_slopes(-a.value, [&](int i) { return -a.slope[i]; });
    }
    HOPSCOTCH_DEVICE dual& operator+=(const dual& b) { return *this = *this + b; }
    HOPSCOTCH_DEVICE dual& operator-=(const dual& b) { return *this = *this - b; }
    HOPSCOTCH_DEVICE dual& operator*=(const dual& b) { return *this = *this * b; }

    friend HOPSCOTCH_DEVICE mask_of<T> operator<(const dual& a, const dual& b) {
        return a.value < b.value;
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator<=(const dual& a, const dual& b) {
        return a.value <= b.value;
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator>(const dual& a, const dual& b) {
        return a.value > b.value;
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator>=(const dual& a, const dual& b) {
        return a.value >= b.value;
    }
    friend HOPSCOTCH_DEVICE mask_of<T> operator==(const dual& a, const dual& b) {
        return a.value == b.value;
    }

    friend HOPSCOTCH_DEVICE dual fma(const dual& a, const dual& b, const dual& c) {
        return with_slopes(fma(a.value, b.value, c.value), [&](int i) {
            return fma(a.value, b.slope[i], fma(a.slope[i], b.value, c.slope[i]));
        });
    }
    friend HOPSCOTCH_DEVICE dual select(const mask_of<T>& condition, const dual& yes,
                                        const dual& no) {
        return with_slopes(select(condition, yes.value, no.value),
                           [&](int i) { return select(condition, yes.slope[i], no.slope[i]); });
    }
    friend HOPSCOTCH_DEVICE dual select_form(const mask_of<T>& condition, const dual& yes,
                                             const dual& no) {
        return with_slopes(select_form(condition, yes.value, no.value), [&](int i) {
            return select_form(condition, yes.slope[i], no.slope[i]);
        });
    }
    friend HOPSCOTCH_DEVICE dual negate_where(const mask_of<T>& condition, const dual& x) {
        return select(condition, -x, x);
    }
    friend HOPSCOTCH_DEVICE T primal(const dual& x) { return x.value; }
    friend auto to_double(const dual& x) { return to_double(x.value); }

    /// f(x) by the chain rule, from f's value and derivative at the primal. A constant stays one
    /// even where the derivative is infinite.
    friend HOPSCOTCH_DEVICE dual chain(const dual& x, const T& value, const T& derivative) {
        return with_slopes(value, [&](int i) { return chained_slope(derivative, x.slope[i]); });
    }
    friend HOPSCOTCH_DEVICE dual sqrt(const dual& x) {
        const T root = sqrt(x.value);
        return chain(x, root, T(0.5) / root);
    }
    friend HOPSCOTCH_DEVICE dual abs(const dual& x) {
        return chain(x, abs(x.value), select(x.value < T(0.0), T(-1.0), T(1.0)));
    }
    friend HOPSCOTCH_DEVICE dual floor(const dual& x) { return dual(floor(x.value)); }
    friend HOPSCOTCH_DEVICE dual nearest(const dual& x) { return dual(nearest(x.value)); }
    friend HOPSCOTCH_DEVICE dual copysign(const dual& magnitude, const dual& sign) {
        const T flip = copysign(T(1.0), magnitude.value) * copysign(T(1.0), sign.value);
        return chain(magnitude, copysign(magnitude.value, sign.value), flip);
    }
};

template <class T, int N>
struct lane_traits<dual<T, N>> {
    using mask = mask_of<T>;
    using primal = T;
    static constexpr int width = width_of<T>;
    static constexpr bool is_binary64 = false;
    static constexpr double rounding = lane_traits<T>::rounding;
    static constexpr double root_rounding = lane_traits<T>::root_rounding;
};

template <class T, int N>
struct mathematical_constants<dual<T, N>> {
    HOPSCOTCH_DEVICE static dual<T, N> pi() { return mathematical_constants<T>::pi(); }
    HOPSCOTCH_DEVICE static dual<T, N> ln2() { return mathematical_constants<T>::ln2(); }
    HOPSCOTCH_DEVICE static dual<T, N> sqrt2() { return mathematical_constants<T>::sqrt2(); }
};

/// The root of a dual residual: see implicit_root.hpp.
template <class T, int N>
HOPSCOTCH_DEVICE inline dual<T, N> implicit_root(const std::type_identity_t<T>& root,
                                                 const dual<T, N>& residual,
                                                 const std::type_identity_t<T>& slope) {
    return dual<T, N>::with_slopes(root, [&](int i) { return -(residual.slope[i] / slope); });
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET

#include "kernels/elementary/dual.hpp"  // its elementary functions, so that one include is enough
