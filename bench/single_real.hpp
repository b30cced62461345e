// IEEE binary32 as a Real, one trajectory: every operation of a kernel rounded to float. What
// float32 kernels would answer, told without writing them; nothing about their speed.
#pragma once

#include "kernels/elementary/sin_cos.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// A float, kept in a double: the ensemble loop takes lanes for columns of doubles. Sums, products,
/// quotients and roots of floats that are rounded to double first are still correctly rounded (53
/// >= 2 24 + 2).
struct single {
    double value;

    single() = default;
    single(double x) : value(static_cast<float>(x)) {}  // NOLINT(google-explicit-constructor)
    explicit operator int() const { return static_cast<int>(value); }

    friend single operator+(single a, single b) { return a.value + b.value; }
    friend single operator-(single a, single b) { return a.value - b.value; }
    friend single operator*(single a, single b) { return a.value * b.value; }
    friend single operator/(single a, single b) { return a.value / b.value; }
    friend single operator-(single a) { return -a.value; }
    single& operator+=(single b) { return *this = *this + b; }
    single& operator-=(single b) { return *this = *this - b; }
    single& operator*=(single b) { return *this = *this * b; }

    friend bool operator<(single a, single b) { return a.value < b.value; }
    friend bool operator<=(single a, single b) { return a.value <= b.value; }
    friend bool operator>(single a, single b) { return a.value > b.value; }
    friend bool operator>=(single a, single b) { return a.value >= b.value; }
    friend bool operator==(single a, single b) { return a.value == b.value; }
};

/// `is_binary64` opens the elementary functions, whose formulas serve any binary format; what they
/// know of double's digits is replaced below.
template <>
struct lane_traits<single> : lane_traits<double> {
    using primal = single;
    static constexpr double rounding = 0x1p-24;
    static constexpr double root_rounding = 0x1p-12;
};

inline single fma(single a, single b, single c) {
    return ::fmaf(static_cast<float>(a.value), static_cast<float>(b.value),
                  static_cast<float>(c.value));
}
inline single sqrt(single x) { return sqrt(x.value); }
inline single floor(single x) { return floor(x.value); }
inline single nearest(single x) { return nearest(x.value); }
inline single abs(single x) { return abs(x.value); }
inline single copysign(single magnitude, single sign) {
    return copysign(magnitude.value, sign.value);
}
inline single select(bool condition, single yes, single no) { return condition ? yes : no; }
inline single negate_where(bool condition, single x) { return negate_where(condition, x.value); }
inline single primal(single x) { return x; }
inline double to_double(single x) { return x.value; }
inline single power_of_two(single n) {
    return std::exp2(static_cast<float>(n.value));  // a float's range
}
inline single exponent(single x) { return exponent(x.value); }
inline single mantissa(single x) { return mantissa(x.value); }
template <int Bit>
bool has_bit(single x) {
    return has_bit<Bit>(x.value + 0x1.8p52);  // of the number of quarter turns below
}
inline int fill_lanes(single& to, bool where, const double* from) {
    return fill_lanes(to.value, where, from);
}

/// The remainder to two floats, as a reduction with constants made for float would give it.
inline quarter_turns<single> split_quarter_turns(const single& x) {
    const quarter_turns<double> exact = split_quarter_turns(x.value);
    const single high = exact.high - exact.minus_low;
    return {exact.counter - 0x1.8p52, high, high.value - (exact.high - exact.minus_low)};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
