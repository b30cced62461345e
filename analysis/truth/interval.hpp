// Intervals of doubles with outward rounding: every operation gives bounds of the exact result for
// all operands in its intervals. Exact results stay points, so that counters and flags do not blur.
// The arithmetic below `enclosure` (analysis/truth/enclosure.hpp), which proofs of traps run in.
#pragma once

#include "kernels/lanes/scalar.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// All numbers from `low` to `high`, both included; both NaN: not a number, whatever the operands.
struct interval {
    double low = 0.0;
    double high = 0.0;

    static constexpr double huge = std::numeric_limits<double>::infinity();
    static constexpr interval point(double x) { return {x, x}; }
    static constexpr interval entire() { return {-huge, huge}; }
    static constexpr interval nan() { return point(std::numeric_limits<double>::quiet_NaN()); }
    constexpr bool is_nan() const { return !(low == low); }
    constexpr bool is_point() const { return low == high; }
    constexpr bool is_zero() const { return low == 0.0 && high == 0.0; }
    constexpr bool is_entire() const { return low == -huge && high == huge; }
    constexpr bool is_bounded() const { return low > -huge && high < huge; }
    constexpr bool holds(double x) const { return low <= x && x <= high; }
    /// Largest absolute value.
    constexpr double size() const { return std::max(-low, high); }
    /// A number inside, the middle where there is one.
    constexpr double middle() const {
        if (is_point()) return low;
        const double sum = 0.5 * low + 0.5 * high;
        return sum == sum && is_bounded() ? std::clamp(sum, low, high) : 0.0;
    }
};

/// The neighbours of a double; infinities away from zero and NaN stay.
inline double just_above(double x) {
    if (!(x < interval::huge)) return x;
    if (x == 0.0) return std::numeric_limits<double>::denorm_min();
    const auto bits = std::bit_cast<std::int64_t>(x);
    return std::bit_cast<double>(bits + (bits >= 0 ? 1 : -1));
}
inline double just_below(double x) { return -just_above(-x); }

interval operator+(const interval& a, const interval& b);
interval operator-(const interval& a, const interval& b);
interval operator-(const interval& a);
interval operator*(const interval& a, const interval& b);
/// The whole line where the divisor holds zero inside, half of it where at its end.
interval operator/(const interval& a, const interval& b);
interval square(const interval& a);
/// Not a number where all of a is negative; the whole line where a part of it is.
interval sqrt(const interval& a);
interval abs(const interval& a);
/// The smallest interval that holds both.
interval hull(const interval& a, const interval& b);

// derivatives: what multiplies an exact zero vanishes, even where it is not known
interval product_of_slopes(const interval& a, const interval& slope);

// elementary functions: the kernels' own in double, widened by more than their stated error
interval sin(const interval& x);
interval cos(const interval& x);
interval tan(const interval& x);
interval exp(const interval& x);
interval expm1(const interval& x);
interval log(const interval& x);
interval log1p(const interval& x);
interval atan(const interval& x);
/// The whole turn where the box meets the cut, the negative half of the x axis.
interval atan2(const interval& y, const interval& x);
interval asin(const interval& x);
interval acos(const interval& x);
interval sinh(const interval& x);
interval cosh(const interval& x);
interval tanh(const interval& x);
interval asinh(const interval& x);
interval atanh(const interval& x);
interval cbrt(const interval& x);

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
