// Motion under a constant force with viscous friction, from rest: the thrust phase of Raibert's
// hoppers, and the time it takes to cover a given height where lift-off cuts it short.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/implicit_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::raibert {

/// first = (1 - e^-y) / y, second = (y - 1 + e^-y) / y^2: 1 and 1/2 without friction.
template <class Real>
struct friction_factors {
    Real first, second;
};

/// \param y  friction times time, >= 0
/// \error    a few ulp: below 1/2 both come from the series, where differences would cancel
template <class Real>
HOPSCOTCH_DEVICE inline friction_factors<Real> friction_factors_at(const Real& y) {
    constexpr int terms = lane_traits<Real>::rounding > 0x1p-60    ? 15
                          : lane_traits<Real>::rounding > 0x1p-110 ? 26
                                                                   : 42;
    const Real one(1.0);
    const auto is_small = y < Real(0.5);
    const Real near = select(is_small, y, Real(0.0));
    Real second = one;  // 1 - y/3 (1 - y/4 (1 - ...)), twice the second factor
    for (int n = terms; n >= 3; --n) {
        if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
            second = fma(-near * Real(1.0 / n), second, one);
        } else {
            second = one - near / Real(static_cast<double>(n)) * second;
        }
    }
    second = second * Real(0.5);
    const Real first = fma(-near, second, one);
    const Real far = select(is_small, one, y);
    const Real first_far = -expm1(-far) / far;
    const Real second_far = (one - first_far) / far;
    return {select(is_small, first, first_far), select(is_small, second, second_far)};
}

/// How long a constant acceleration takes to lift a body from rest by `height`, against friction.
///
/// \param friction      gamma >= 0, 1/s
/// \param acceleration  > 0 in the lanes wanted
/// \param height        >= 0
/// Newton's method on the square root of the displacement, which is nearly linear in time; that
/// function is concave and the start, the time without friction, lies below the root.
template <class Real>
HOPSCOTCH_DEVICE inline Real thrust_duration(const Real& friction, const Real& acceleration,
                                             const Real& height, mask_of<Real> wanted) {
    using plain = primal_of<Real>;
    const plain gamma = primal(friction);
    const plain free = sqrt(plain(2.0) * primal(height) / primal(acceleration));
    const plain latest = fma(gamma * free, free, free + free);
    const auto late = [&](const plain& t) {
        const friction_factors<plain> at = friction_factors_at(gamma * t);
        const plain root = sqrt(at.second + at.second);
        return value_and_slope<plain>{fma(t, root, -free), at.first / root};
    };
    const plain t = bracketed_root<plain>(late, {free * plain(0.5), latest}, free, wanted);
    const friction_factors<plain> at = friction_factors_at(gamma * t);
    const Real time(t);
    const Real moved =
        acceleration * time * time * friction_factors_at(friction * time).second - height;
    return implicit_root(t, moved, primal(acceleration) * t * at.first);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::raibert
