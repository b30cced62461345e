// pi, ln 2 and their kin for every arithmetic, each to that arithmetic's full precision, and pi/2
// split into doubles for argument reduction. Used by the elementary functions and by models.
#pragma once

#include "kernels/lanes/lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// The constants of one arithmetic; dual, double_double and real50 specialise it in their own
/// headers.
template <class Real>
struct mathematical_constants;

template <binary64_lane Real>
struct mathematical_constants<Real> {
    HOPSCOTCH_DEVICE static Real pi() { return Real(3.141592653589793); }
    HOPSCOTCH_DEVICE static Real ln2() { return Real(0.6931471805599453); }
    HOPSCOTCH_DEVICE static Real sqrt2() { return Real(1.4142135623730951); }
};

template <class Real>
HOPSCOTCH_DEVICE inline Real pi() {
    return mathematical_constants<Real>::pi();
}
template <class Real>
HOPSCOTCH_DEVICE inline Real two_pi() {
    return mathematical_constants<Real>::pi() * Real(2.0);
}
template <class Real>
HOPSCOTCH_DEVICE inline Real half_pi() {
    return mathematical_constants<Real>::pi() * Real(0.5);
}
template <class Real>
HOPSCOTCH_DEVICE inline Real quarter_pi() {
    return mathematical_constants<Real>::pi() * Real(0.25);
}
template <class Real>
HOPSCOTCH_DEVICE inline Real ln2() {
    return mathematical_constants<Real>::ln2();
}
template <class Real>
HOPSCOTCH_DEVICE inline Real sqrt2() {
    return mathematical_constants<Real>::sqrt2();
}

/// pi/2 = high + middle + low to 2^-163: consecutive roundings to double of what is left.
struct half_pi_parts {
    static constexpr double high = 0x1.921fb54442d18p+0;
    static constexpr double middle = 0x1.1a62633145c07p-54;
    static constexpr double low = -0x1.f1976b7ed8fbcp-110;
};

/// ln 2 = high + low to 2^-109.
struct ln2_parts {
    static constexpr double high = 0x1.62e42fefa39efp-1;
    static constexpr double low = 0x1.abc9e3b39803fp-56;
};

/// Not-a-number and infinity as a Real of any arithmetic that can be built from a double.
template <class Real>
HOPSCOTCH_DEVICE inline Real not_a_number() {
    return Real(__builtin_nan(""));
}
template <class Real>
HOPSCOTCH_DEVICE inline Real infinity() {
    return Real(__builtin_inf());
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
