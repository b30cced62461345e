// The thrust phase of the vertical hopper in closed form: constant force against gravity and
// viscous friction, from rest at the bottom, cut when the leg leaves the ground. Source:
// models/raibert_hopper.md section 3; Koditschek, Buehler 1991, (8), (10).
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/implicit_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

/// Response to a unit acceleration under friction: velocity (1 - e^{-gamma s}) / gamma and
/// displacement (s - velocity) / gamma after the time s. No cancellation for small gamma s.
template <class Real>
struct unit_push {
    Real velocity, displacement;
};

template <class Real>
HOPSCOTCH_DEVICE inline unit_push<Real> push(const Real& s, const Real& friction) {
    constexpr int terms = lane_traits<Real>::rounding > 0x1p-60    ? 12
                          : lane_traits<Real>::rounding > 0x1p-110 ? 22
                                                                   : 36;
    const Real one(1.0);
    const Real y = friction * s;
    const mask_of<Real> none = friction == Real(0.0);
    const Real divisor = select(none, one, friction);
    const Real velocity = select(none, s, -expm1(-y) / divisor);
    Real sum(1.0);
    for (int k = terms; k >= 1; --k) {
        if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
            sum = fma(-y * Real(1.0 / (k + 2)), sum, one);
        } else {
            sum = one - y / Real(static_cast<double>(k + 2)) * sum;
        }
    }
    const Real near = Real(0.5) * s * s * sum;
    return {velocity, select_form(y < Real(0.3), near, (s - velocity) / divisor)};
}

/// How thrust ends.
template <class Real>
struct thrust_end {
    mask_of<Real> cut;      // at lift-off, before its time
    mask_of<Real> crashes;  // the body reaches the foot (thrust below gravity)
    Real duration, velocity;
    Real rise;  // displacement
};

/// Thrust from rest at the bottom.
///
/// \param depth   lift-off height minus bottom height
/// \param height  bottom height
/// \param net     thrust minus gravity
/// \param wanted  lanes at the bottom
/// An end of thrust at the very lift-off is not cut. The time of a cut is found from the square
/// root of the displacement, which is nearly linear in time however small the depth.
template <class Real>
HOPSCOTCH_DEVICE inline thrust_end<Real> thrust(const Real& depth, const Real& height,
                                                const Real& net, const Real& friction,
                                                const Real& time, const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const Real zero(0.0);
    const unit_push<Real> full = push(time, friction);
    const Real rise = net * full.displacement;
    const mask_of<Real> cut = wanted & (rise > depth);
    const mask_of<Real> crashes = wanted & (rise < zero) & (height + rise <= zero);
    Real duration = time;
    Real velocity = full.velocity;
    if (any(cut)) {
        const plain gamma = primal(friction);
        const plain target = sqrt(larger(primal(depth / net), plain(0.0)));
        const auto rising = [&](const plain& s) {
            const unit_push<plain> there = push(s, gamma);
            const plain root = sqrt(there.displacement);
            return value_and_slope<plain>{root - target, plain(0.5) * there.velocity / root};
        };
        const plain guess = target * sqrt2<plain>();
        const plain s = bracketed_root<plain>(rising, {plain(0.0), primal(time)}, guess, cut);
        const unit_push<Real> there = push(Real(s), friction);
        const Real exact = implicit_root(s, net * there.displacement - depth,
                                         primal(net) * primal(there.velocity));
        duration = select(cut, exact, time);
        velocity = select(cut, push(duration, friction).velocity, velocity);
    }
    return {cut, crashes, duration, net * velocity, select(cut, depth, rise)};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
