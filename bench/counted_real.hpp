// A double that counts what is done with it: the operations a kernel needs, told from any time or
// machine. One trajectory, as a GPU thread runs it.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/lanes/scalar.hpp"

#include <array>
#include <cstdint>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// Operations on doubles; bit operations cost no floating-point unit.
struct operation_counts {
    double fused = 0.0;  // a b + c
    double plain = 0.0;  // one sum, product or comparison
    double divisions = 0.0;
    double square_roots = 0.0;
    double roundings = 0.0;    // floor, nearest
    double comparisons = 0.0;  // that `plain` has too
    double selections = 0.0;
};

/// Kinds of elementary functions, by the one whose time stands for the kind.
enum class elementary_kind : std::uint8_t { sin_cos, exp, log, atan2, cbrt };
inline constexpr int n_elementary_kinds = 5;

inline thread_local operation_counts counts;         // all
inline thread_local operation_counts inside_counts;  // of these, those inside elementary functions
inline thread_local std::array<double, n_elementary_kinds> elementary_calls;

/// One call of an elementary function by a model: what it calls itself is no further call.
class elementary_call {
public:
    explicit elementary_call(elementary_kind kind) {
        if (depth_++ > 0) return;
        before_ = counts;
        ++elementary_calls[static_cast<std::size_t>(kind)];
    }
    ~elementary_call() {
        if (--depth_ > 0) return;
        const auto add = [this](double operation_counts::*field) {
            inside_counts.*field += counts.*field - before_.*field;
        };
        add(&operation_counts::fused), add(&operation_counts::plain);
        add(&operation_counts::divisions), add(&operation_counts::square_roots);
        add(&operation_counts::roundings), add(&operation_counts::comparisons);
        add(&operation_counts::selections);
    }
    elementary_call(const elementary_call&) = delete;
    elementary_call& operator=(const elementary_call&) = delete;

private:
    static inline thread_local int depth_ = 0;
    operation_counts before_;
};

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
        ++counts.comparisons;
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
inline counted select(bool condition, counted yes, counted no) {
    ++counts.selections;
    return condition ? yes : no;
}
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

// ---- elementary functions: counted as calls, computed by the kernels' own
inline sine_cosine<counted> sin_cos(const counted& x) {
    const elementary_call call(elementary_kind::sin_cos);
    return sin_cos<counted>(x);
}
inline sine_cosine_deficits<counted> sin_cos_deficits(const counted& x) {
    const elementary_call call(elementary_kind::sin_cos);
    return sin_cos_deficits<counted>(x);
}
inline counted tan(const counted& x) {
    const elementary_call call(elementary_kind::sin_cos);
    return tan<counted>(x);
}
inline counted exp(const counted& x) {
    const elementary_call call(elementary_kind::exp);
    return exp<counted>(x);
}
inline counted expm1(const counted& x) {
    const elementary_call call(elementary_kind::exp);
    return expm1<counted>(x);
}
inline counted sinh(const counted& x) {
    const elementary_call call(elementary_kind::exp);
    return sinh<counted>(x);
}
inline counted cosh(const counted& x) {
    const elementary_call call(elementary_kind::exp);
    return cosh<counted>(x);
}
inline counted log(const counted& x) {
    const elementary_call call(elementary_kind::log);
    return log<counted>(x);
}
inline counted log1p(const counted& x) {
    const elementary_call call(elementary_kind::log);
    return log1p<counted>(x);
}
inline counted atan(const counted& x) {
    const elementary_call call(elementary_kind::atan2);
    return atan<counted>(x);
}
inline counted atan2(const counted& y, const counted& x) {
    const elementary_call call(elementary_kind::atan2);
    return atan2<counted>(y, x);
}
inline counted asin(const counted& x) {
    const elementary_call call(elementary_kind::atan2);
    return asin<counted>(x);
}
inline counted acos(const counted& x) {
    const elementary_call call(elementary_kind::atan2);
    return acos<counted>(x);
}
inline counted cbrt(const counted& x) {
    const elementary_call call(elementary_kind::cbrt);
    return cbrt<counted>(x);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
