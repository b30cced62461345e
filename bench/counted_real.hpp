// A double that counts what is done with it: the operations a kernel needs, told from any time or
// machine. One trajectory, as a GPU thread runs it.
#pragma once

#include "kernels/lanes/scalar.hpp"

#include <cstdint>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Operations on doubles; selections and bit operations cost no floating-point unit.
struct operation_counts {
    double fused = 0.0;  // a b + c
    double plain = 0.0;  // one sum, product or comparison
    double divisions = 0.0;
    double square_roots = 0.0;
    double roundings = 0.0;  // floor, nearest
};

inline thread_local operation_counts counts;

struct counted {
    double value;

    counted() = default;
    counted(double x) : value(x) {}  // NOLINT(google-explicit-constructor): as lanes are
    explicit operator int() const { return static_cast<int>(value); }

    friend counted operator+(counted a, counted b) { return plain(a.value + b.value); }
    friend counted operator-(counted a, counted b) { return plain(a.value - b.value); }
    friend counted operator*(counted a, counted b) { return plain(a.value * b.value); }
    friend counted operator/(counted a, counted b) {
        ++counts.divisions;
        return a.value / b.value;
    }
    friend counted operator-(counted a) { return -a.value; }
    counted& operator+=(counted b) { return *this = *this + b; }
    counted& operator-=(counted b) { return *this = *this - b; }
    counted& operator*=(counted b) { return *this = *this * b; }

    friend bool operator<(counted a, counted b) { return compared(a.value < b.value); }
    friend bool operator<=(counted a, counted b) { return compared(a.value <= b.value); }
    friend bool operator>(counted a, counted b) { return compared(a.value > b.value); }
    friend bool operator>=(counted a, counted b) { return compared(a.value >= b.value); }
    friend bool operator==(counted a, counted b) { return compared(a.value == b.value); }

private:
    static counted plain(double x) {
        ++counts.plain;
        return x;
    }
    static bool compared(bool result) {
        ++counts.plain;
        return result;
    }
};

template <>
struct lane_traits<counted> : lane_traits<double> {
    using primal = counted;
};

inline counted fma(counted a, counted b, counted c) {
    ++counts.fused;
    return fma(a.value, b.value, c.value);
}
inline counted sqrt(counted x) {
    ++counts.square_roots;
    return sqrt(x.value);
}
inline counted floor(counted x) {
    ++counts.roundings;
    return floor(x.value);
}
inline counted nearest(counted x) {
    ++counts.roundings;
    return nearest(x.value);
}
inline counted abs(counted x) { return abs(x.value); }
inline counted copysign(counted magnitude, counted sign) {
    return copysign(magnitude.value, sign.value);
}
inline counted select(bool condition, counted yes, counted no) { return condition ? yes : no; }
inline counted negate_where(bool condition, counted x) { return negate_where(condition, x.value); }
inline counted primal(counted x) { return x; }
inline double to_double(counted x) { return x.value; }
inline counted power_of_two(counted n) { return power_of_two(n.value); }
inline counted exponent(counted x) { return exponent(x.value); }
inline counted mantissa(counted x) { return mantissa(x.value); }
template <int Bit>
bool has_bit(counted x) {
    return has_bit<Bit>(x.value);
}
inline int fill_lanes(counted& to, bool where, const double* from) {
    return fill_lanes(to.value, where, from);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
