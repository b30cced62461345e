// The elementary functions of double_double to about 31 digits: a fixed number of Taylor terms
// after reduction, or one Newton step from the double function. Slow by design, used for audits.
// Included by kernels/lanes/double_double.hpp.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/lanes/double_double.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// 1 / k! for k in 2 ... 28.
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> inverse_factorial(int k) {
    constexpr double parts[][2] = {
        {0x1p-1, 0.0},  // 1/2!
        {0x1.5555555555555p-3, 0x1.5555555555555p-57},
        {0x1.5555555555555p-5, 0x1.5555555555555p-59},
        {0x1.1111111111111p-7, 0x1.1111111111111p-63},
        {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
        {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},
        {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},
        {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73},
        {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},
        {0x1.ae64567f544e4p-26, -0x1.c062e06d1f209p-80},
        {0x1.1eed8eff8d898p-29, -0x1.2aec959e14c06p-83},
        {0x1.6124613a86d09p-33, 0x1.f28e0cc748ebep-87},
        {0x1.93974a8c07c9dp-37, 0x1.05d6f8a2efd1fp-92},
        {0x1.ae7f3e733b81fp-41, 0x1.1d8656b0ee8cbp-97},
        {0x1.ae7f3e733b81fp-45, 0x1.1d8656b0ee8cbp-101},
        {0x1.952c77030ad4ap-49, 0x1.ac981465ddc6cp-103},
        {0x1.6827863b97d97p-53, 0x1.eec01221a8b0bp-107},
        {0x1.2f49b46814157p-57, 0x1.2650f61dbdcb4p-112},
        {0x1.e542ba4020225p-62, 0x1.ea72b4afe3c2fp-120},
        {0x1.71b8ef6dcf572p-66, -0x1.d043ae40c4647p-120},
        {0x1.0ce396db7f853p-70, -0x1.aebcdbd20331cp-124},
        {0x1.761b41316381ap-75, -0x1.3423c7d91404fp-130},
        {0x1.f2cf01972f578p-80, -0x1.9ada5fcc1ab14p-135},
        {0x1.3f3ccdd165fa9p-84, -0x1.58ddadf344487p-139},
        {0x1.88e85fc6a4e5ap-89, -0x1.71c37ebd16540p-143},
        {0x1.d1ab1c2dccea3p-94, 0x1.054d0c78aea14p-149},
        {0x1.0a18a2635085dp-98, 0x1.b9e2e28e1aa54p-153},
    };
    return {T(parts[k - 2][0]), T(parts[k - 2][1])};
}

/// a times a power of two, exactly.
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> scaled(const double_double<T>& a, const T& power) {
    return {a.high * power, a.low * power};
}

/// x - n (p_0 + p_1 + p_2 + p_3), the parts being a constant's consecutive roundings to double.
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> reduced(const double_double<T>& x, const T& n, double p0,
                                                 double p1, double p2, double p3) {
    using wide = double_double<T>;
    const wide first = x - wide(two_product(n, T(p0)));
    const wide second = first - wide(two_product(n, T(p1)));
    const wide third = second - wide(two_product(n, T(p2)));
    return third - wide(n * T(p3), T(0.0));
}

/// Sine and cosine: Taylor series on |r| <= pi/4.
///
/// \error  relative 1e-30 for |x| <= 2^40, next to zeros too; beyond and for non-finite x NaN
template <class T>
HOPSCOTCH_DEVICE inline sine_cosine<double_double<T>> sin_cos(const double_double<T>& x) {
    using wide = double_double<T>;
    const T counter = split_quarter_turns(x.high).counter;
    const T n = select(abs(x.high) <= T(0x1p40), counter - T(0x1.8p52), not_a_number<T>());
    const wide r = reduced(x, n, half_pi_parts::high, half_pi_parts::middle, half_pi_parts::low,
                           0x1.4cf98e804177dp-164);
    const wide minus_square = -(r * r);
    wide sine_series = inverse_factorial<T>(27);
    wide cosine_series = inverse_factorial<T>(28);
    for (int k = 25; k >= 3; k -= 2)
        sine_series = sine_series * minus_square + inverse_factorial<T>(k);
    for (int k = 26; k >= 2; k -= 2)
        cosine_series = cosine_series * minus_square + inverse_factorial<T>(k);
    const wide sine = r + r * minus_square * sine_series;
    const wide cosine = wide(1.0) + minus_square * cosine_series;

    const auto swapped = has_bit<0>(counter);
    const auto reversed = has_bit<1>(counter);
    return {negate_where(reversed, select(swapped, cosine, sine)),
            negate_where(reversed, select(swapped, -sine, cosine))};
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> sin(const double_double<T>& x) {
    return sin_cos(x).sin;
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> cos(const double_double<T>& x) {
    return sin_cos(x).cos;
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> tan(const double_double<T>& x) {
    const sine_cosine<double_double<T>> turn = sin_cos(x);
    return turn.sin / turn.cos;
}

/// e^x = 2^n (1 + excess).
template <class T>
struct wide_exponential {
    T n;
    double_double<T> excess;
};

/// e^x - 1 for |x| <= 0.36: Taylor series at x / 16, then four doublings (1 + e)^2 - 1 = e (2 + e).
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> small_expm1(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide r = scaled(x, T(0.0625));
    wide series = inverse_factorial<T>(15);
    for (int k = 14; k >= 2; --k) series = series * r + inverse_factorial<T>(k);
    wide excess = r + r * r * series;
    for (int doubling = 0; doubling < 4; ++doubling) excess = excess * (excess + wide(2.0));
    return excess;
}

template <class T>
HOPSCOTCH_DEVICE inline wide_exponential<T> reduce_wide_exponential(const double_double<T>& x) {
    const T turns = nearest(x.high * T(0x1.71547652b82fep+0));
    const T n = select(turns == turns, turns, T(0.0));
    return {n, small_expm1(reduced(x, n, ln2_parts::high, ln2_parts::low, 0x1.7b57a079a1934p-111,
                                   -0x1.ace93a4ebe5d1p-165))};
}

/// \error  relative 1e-30 where the result's low part is normal (above 1e-290)
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> exp(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide inside = select(abs(x.high) < T(750.0), x, wide(0.0));
    const wide_exponential<T> e = reduce_wide_exponential(inside);
    const wide sum = wide(1.0) + e.excess;
    const T half = floor(e.n * T(0.5));
    const wide result = scaled(scaled(sum, power_of_two(half)), power_of_two(e.n - half));
    const wide finite = select(result.high < infinity<T>(), result, wide(infinity<T>(), T(0.0)));
    return select(abs(x.high) < T(750.0), finite, wide(exp(x.high), T(0.0)));
}

/// \error  relative 1e-30
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> expm1(const double_double<T>& x) {
    using wide = double_double<T>;
    const auto is_middle = (x.high > T(-80.0)) & (x.high < T(80.0));
    const wide_exponential<T> e = reduce_wide_exponential(select(is_middle, x, wide(0.0)));
    const T power = power_of_two(e.n);
    const wide result = scaled(e.excess, power) + wide(two_sum(power, T(-1.0)));
    return select(is_middle, select(e.n == T(0.0), e.excess, result), exp(x) - wide(1.0));
}

/// log(1 + f) for f in [-0.293, 0.415]: one Newton step on e^y from the double result.
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> small_log1p(const double_double<T>& f) {
    using wide = double_double<T>;
    const wide start(log1p(f.high), T(0.0));
    const wide error = f + (wide(1.0) + f) * small_expm1(-start);
    return start + (error - scaled(error * error, T(0.5)));
}

/// \error  relative 1e-30; special values as those of double
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> log(const double_double<T>& x) {
    using wide = double_double<T>;
    const auto ordinary = (x.high >= T(0x1p-1022)) & (x.high < infinity<T>());
    const wide inside = select(ordinary, x, wide(1.0));
    const T exact = exponent(inside.high);
    const T n = select(mantissa(inside.high) > T(0x1.6a09e667f3bcdp+0), exact + T(1.0), exact);
    const T half = floor(n * T(0.5));
    const wide m = scaled(scaled(inside, power_of_two(-half)), power_of_two(half - n));
    const wide result =
        wide(n, T(0.0)) * mathematical_constants<wide>::ln2() + small_log1p(m - wide(1.0));
    return select(ordinary, result, wide(log(x.high), T(0.0)));
}

/// \error  relative 1e-30
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> log1p(const double_double<T>& x) {
    using wide = double_double<T>;
    const auto is_small = (x.high > T(-0.29)) & (x.high < T(0.41));
    const wide small_result = small_log1p(select(is_small, x, wide(0.0)));
    return select(is_small, small_result, log(wide(1.0) + x));
}

/// One Newton step on the direction (cos, sin) of the double result.
///
/// \error  relative 1e-30; zeros, infinities and NaN as for double
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> atan2(const double_double<T>& y,
                                               const double_double<T>& x) {
    using wide = double_double<T>;
    const T y_size = abs(y.high);
    const T x_size = abs(x.high);
    const T largest = select(x_size > y_size, x_size, y_size);
    const auto ordinary = (largest > T(0x1p-900)) & (largest < infinity<T>());
    const T e = exponent(select(ordinary, largest, T(1.0)));
    const T bounded = select(e > T(1000.0), T(1000.0), e);
    const T scale = power_of_two(-bounded);
    // infinities and zeros count by their signs alone
    const auto is_infinite = largest == infinity<T>();
    const T x_sign = copysign(T(1.0), x.high);
    const T y_sign = copysign(T(1.0), y.high);
    const wide x_far(select(x_size == largest, x_sign, T(0.0)), T(0.0));
    const wide y_far(select(y_size == largest, y_sign, T(0.0)), T(0.0));
    const wide x_zero = select(largest == T(0.0), wide(x_sign, T(0.0)), scaled(x, scale));
    const wide x_near = select(is_infinite, x_far, x_zero);
    const wide y_near = select(is_infinite, y_far, scaled(y, scale));

    const T start = atan2(y.high, x.high);
    const sine_cosine<wide> turn = sin_cos(wide(start, T(0.0)));
    const wide radius = sqrt(x_near * x_near + y_near * y_near);
    const wide correction = (y_near * turn.cos - x_near * turn.sin) / radius;
    const wide result = wide(start, T(0.0)) + correction;
    return select(start == T(0.0), wide(start, T(0.0)), result);
}

/// \error  relative 1e-30
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> atan(const double_double<T>& x) {
    return atan2(x, double_double<T>(1.0));
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> asin(const double_double<T>& x) {
    const double_double<T> one(1.0);
    return atan2(x, sqrt((one - x) * (one + x)));
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> acos(const double_double<T>& x) {
    const double_double<T> one(1.0);
    return atan2(sqrt((one - x) * (one + x)), x);
}

/// \error  relative 1e-30
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> sinh(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide size = abs(x);
    const wide e = expm1(select(size.high < T(80.0), size, wide(0.0)));
    const wide near = scaled(e + e / (e + wide(1.0)), T(0.5));
    const wide root = exp(scaled(size, T(0.5)));  // e^x itself may overflow where its half does not
    return copysign(select(size.high < T(80.0), near, scaled(root, T(0.5)) * root), x);
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> cosh(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide size = abs(x);
    const wide e = exp(select(size.high < T(80.0), size, wide(0.0)));
    const wide near = scaled(e + wide(1.0) / e, T(0.5));
    const wide root = exp(scaled(size, T(0.5)));
    return select(size.high < T(80.0), near, scaled(root, T(0.5)) * root);
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> tanh(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide size = abs(x);
    const wide e = expm1(scaled(select(size.high > T(39.0), wide(39.0), size), T(2.0)));
    return copysign(e / (e + wide(2.0)), x);
}

/// \error  relative 1e-30
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> asinh(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide size = abs(x);
    const wide near = select(size.high < T(0x1p60), size, wide(1.0));
    const wide square = near * near;
    const wide small_result = log1p(near + square / (wide(1.0) + sqrt(wide(1.0) + square)));
    const wide large_result = log(size) + mathematical_constants<wide>::ln2();
    return copysign(select(size.high < T(0x1p60), small_result, large_result), x);
}
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> atanh(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide size = abs(x);
    return copysign(scaled(log1p(scaled(size, T(2.0)) / (wide(1.0) - size)), T(0.5)), x);
}

/// \error  relative 1e-30
template <class T>
HOPSCOTCH_DEVICE inline double_double<T> cbrt(const double_double<T>& x) {
    using wide = double_double<T>;
    const wide start(cbrt(x.high), T(0.0));
    const wide square = start * start;
    const wide result = start - (square * start - x) / (wide(3.0) * square);
    const auto ordinary = (abs(x.high) > T(0.0)) & (abs(x.high) < infinity<T>());
    return select(ordinary, result, start);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
