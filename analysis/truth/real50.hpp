// `real50`: 50-digit arithmetic with the interface of the kernels' lanes, on Boost.Multiprecision.
// It is the truth that tests and audits compare with. Host only; not for the kernels' own objects.
#pragma once

#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/sin_cos.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <ios>
#include <string>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// 64 digits, so that 50 are left after the usual losses.
struct real50 {
    using number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<64>,
                                                 boost::multiprecision::et_off>;
    number value;

    real50() = default;
    real50(double x) : value(x) {}  // NOLINT(google-explicit-constructor): constants mix with lanes
    explicit real50(const number& x) : value(x) {}
    /// From a decimal numeral such as "-1.25e-3" or "inf"; throws std::runtime_error on anything
    /// else.
    explicit real50(const std::string& decimal) : value(decimal) {}

    friend real50 operator+(const real50& a, const real50& b) { return real50(a.value + b.value); }
    friend real50 operator-(const real50& a, const real50& b) { return real50(a.value - b.value); }
    friend real50 operator*(const real50& a, const real50& b) { return real50(a.value * b.value); }
    friend real50 operator/(const real50& a, const real50& b) { return real50(a.value / b.value); }
    friend real50 operator-(const real50& a) { return real50(-a.value); }
    real50& operator+=(const real50& b) { return *this = *this + b; }
    real50& operator-=(const real50& b) { return *this = *this - b; }
    real50& operator*=(const real50& b) { return *this = *this * b; }

    friend bool operator<(const real50& a, const real50& b) { return a.value < b.value; }
    friend bool operator<=(const real50& a, const real50& b) { return a.value <= b.value; }
    friend bool operator>(const real50& a, const real50& b) { return a.value > b.value; }
    friend bool operator>=(const real50& a, const real50& b) { return a.value >= b.value; }
    friend bool operator==(const real50& a, const real50& b) { return a.value == b.value; }
};

template <>
struct lane_traits<real50> {
    using mask = bool;
    using primal = real50;
    static constexpr int width = 1;
    static constexpr bool is_binary64 = false;
    static constexpr double rounding = 0x1p-200;  // of the 213 bits carried
    static constexpr double root_rounding = 0x1p-100;
};

/// The nearest double.
inline double to_double(const real50& x) { return x.value.convert_to<double>(); }

/// Decimal with this many significant digits.
inline std::string to_string(const real50& x, int digits = 50) {
    return x.value.str(digits - 1, std::ios_base::scientific);  // digits after the point
}

inline real50 fma(const real50& a, const real50& b, const real50& c) { return a * b + c; }
inline real50 sqrt(const real50& x) { return real50(real50::number(sqrt(x.value))); }
inline real50 abs(const real50& x) { return real50(real50::number(abs(x.value))); }
inline real50 floor(const real50& x) { return real50(real50::number(floor(x.value))); }
inline real50 select(bool condition, const real50& yes, const real50& no) {
    return condition ? yes : no;
}
inline real50 negate_where(bool condition, const real50& x) { return condition ? -x : x; }
inline real50 copysign(const real50& magnitude, const real50& sign) {
    return negate_where(signbit(magnitude.value) != signbit(sign.value), magnitude);
}
/// Ties to even.
inline real50 nearest(const real50& x) {
    const real50 below = floor(x);
    const real50 rest = x - below;
    const bool below_is_odd = floor(below * 0.5) * 2.0 < below;
    return rest > 0.5 || (rest == 0.5 && below_is_odd) ? below + 1.0 : below;
}
inline real50 primal(const real50& x) { return x; }

template <>
struct mathematical_constants<real50> {
    static real50 pi() {
        return real50(
            "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899");
    }
    static real50 ln2() {
        return real50(
            "0.693147180559945309417232121458176568075500134360255254120680009493393621969694715");
    }
    static real50 sqrt2() { return sqrt(real50(2.0)); }
};

/// Sine and cosine. The first two parts of pi/2 are doubles, so that their products are exact and
/// all 50 digits survive next to multiples of pi/2 too, for |x| < 1e40.
inline sine_cosine<real50> sin_cos(const real50& x) {
    static const real50 half_pi_rest(
        "-1.497384904859169777320797133937725094986669701841027904483071357847845e-33");
    const real50 quarters = nearest(x / half_pi<real50>());
    if (!(abs(x) < 1e40)) return {not_a_number<real50>(), not_a_number<real50>()};
    const real50 r = x - quarters * half_pi_parts::high - quarters * half_pi_parts::middle -
                     quarters * half_pi_rest;
    const real50 sine(real50::number(sin(r.value)));
    const real50 cosine(real50::number(cos(r.value)));
    const real50 cycle = quarters - floor(quarters * 0.25) * 4.0;
    if (cycle == 1.0) return {cosine, -sine};
    if (cycle == 2.0) return {-sine, -cosine};
    if (cycle == 3.0) return {-cosine, sine};
    return {sine, cosine};
}
inline real50 sin(const real50& x) { return sin_cos(x).sin; }
inline real50 cos(const real50& x) { return sin_cos(x).cos; }
inline real50 tan(const real50& x) {
    const sine_cosine<real50> turn = sin_cos(x);
    return turn.sin / turn.cos;
}

inline real50 exp(const real50& x) { return real50(real50::number(exp(x.value))); }
inline real50 expm1(const real50& x) { return real50(real50::number(expm1(x.value))); }
inline real50 log(const real50& x) { return real50(real50::number(log(x.value))); }
inline real50 log1p(const real50& x) { return real50(real50::number(log1p(x.value))); }
inline real50 atan(const real50& x) { return real50(real50::number(atan(x.value))); }
inline real50 atan2(const real50& y, const real50& x) {
    return real50(real50::number(atan2(y.value, x.value)));
}
inline real50 asin(const real50& x) { return real50(real50::number(asin(x.value))); }
inline real50 acos(const real50& x) { return real50(real50::number(acos(x.value))); }
inline real50 sinh(const real50& x) { return real50(real50::number(sinh(x.value))); }
inline real50 cosh(const real50& x) { return real50(real50::number(cosh(x.value))); }
inline real50 tanh(const real50& x) { return real50(real50::number(tanh(x.value))); }
inline real50 asinh(const real50& x) { return real50(real50::number(asinh(x.value))); }
inline real50 atanh(const real50& x) { return real50(real50::number(atanh(x.value))); }
inline real50 cbrt(const real50& x) { return real50(real50::number(cbrt(x.value))); }

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
