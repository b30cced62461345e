// `double` as a Real: one trajectory, the reference that every pack and device must match bit for
// bit. Also what a CUDA thread runs.
#pragma once

#include "kernels/lanes/lane.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <>
struct lane_traits<double> {
    using mask = bool;
    using primal = double;
    static constexpr int width = 1;
    static constexpr bool is_binary64 = true;
    static constexpr double rounding = 0x1p-53;
    static constexpr double root_rounding = 0x1p-26;
};

HOPSCOTCH_DEVICE inline double fma(double a, double b, double c) { return ::fma(a, b, c); }
HOPSCOTCH_DEVICE inline double sqrt(double x) { return ::sqrt(x); }
HOPSCOTCH_DEVICE inline double abs(double x) { return ::fabs(x); }
HOPSCOTCH_DEVICE inline double floor(double x) { return ::floor(x); }
HOPSCOTCH_DEVICE inline double nearest(double x) { return ::rint(x); }
HOPSCOTCH_DEVICE inline double copysign(double magnitude, double sign) {
    return ::copysign(magnitude, sign);
}
HOPSCOTCH_DEVICE inline double select(bool condition, double yes, double no) {
    return condition ? yes : no;
}
HOPSCOTCH_DEVICE inline double negate_where(bool condition, double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^
                                 (static_cast<std::uint64_t>(condition) << 63));
}
HOPSCOTCH_DEVICE inline bool any(bool mask) { return mask; }
HOPSCOTCH_DEVICE inline bool all(bool mask) { return mask; }
HOPSCOTCH_DEVICE inline double primal(double x) { return x; }
HOPSCOTCH_DEVICE inline double to_double(double x) { return x; }

/// 2^n for integral n in [-1022, 1023].
HOPSCOTCH_DEVICE inline double power_of_two(double n) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023)
                                 << 52);
}

/// Exponent e and mantissa m in [1, 2) of a positive normal x = m 2^e.
HOPSCOTCH_DEVICE inline double exponent(double x) {
    return static_cast<double>(static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52) -
                               1023);
}
HOPSCOTCH_DEVICE inline double mantissa(double x) {
    constexpr std::uint64_t fraction = 0x000fffffffffffffull;
    constexpr std::uint64_t one = 0x3ff0000000000000ull;
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & fraction) | one);
}

/// Is this bit of the fraction set? Of x = 1.5 2^52 + n it is that bit of the integer n.
template <int Bit>
HOPSCOTCH_DEVICE inline bool has_bit(double x) {
    return ((std::bit_cast<std::uint64_t>(x) >> Bit) & 1u) != 0;
}

/// One bit per lane.
HOPSCOTCH_DEVICE inline std::uint32_t lane_bits(bool mask) { return mask ? 1u : 0u; }
/// The lanes whose bits are set.
HOPSCOTCH_DEVICE inline void set_lanes(bool& mask, std::uint64_t bits) { mask = (bits & 1u) != 0; }
/// Puts consecutive doubles of `from` into the lanes where the mask is set, in order; returns how
/// many.
HOPSCOTCH_DEVICE inline int fill_lanes(double& to, bool where, const double* from) {
    if (where) to = *from;
    return where ? 1 : 0;
}
HOPSCOTCH_DEVICE inline void fill_lanes(std::uint64_t* to, bool where, const std::uint64_t* from) {
    if (where) *to = *from;
}
/// Number of set lanes.
HOPSCOTCH_DEVICE inline int count(bool mask) { return mask ? 1 : 0; }

/// `select` between two forms of one function, the mask saying which keeps more digits. The same
/// bits; arithmetics that follow a whole set of starts (analysis/truth/enclosure.hpp) may cross
/// from one form to the other inside it.
template <class Mask, class Real>
HOPSCOTCH_DEVICE inline Real select_form(const Mask& condition, const Real& yes, const Real& no) {
    return select(condition, yes, no);
}

/// derivative * slope of the chain rule; a slope of zero stays zero even where the derivative is
/// infinite.
template <class Real>
HOPSCOTCH_DEVICE inline Real chained_slope(const Real& derivative, const Real& slope) {
    return select(slope == Real(0.0), Real(0.0), derivative * slope);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
