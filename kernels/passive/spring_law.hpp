// The passive hopper's nonlinear spring, F(s) = s + q s^2 + c s^3, in gravity 1 + gamma y: its
// potential, the extension at which it lifts the foot, and when a motion leaves for good. Source:
// models/passive_hopper.md section 6.
#pragma once

#include "kernels/contract/info.hpp"
#include "kernels/lanes/dual.hpp"

#include <cmath>
#include <string_view>

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

template <class Real>
struct spring_law {
    Real quadratic;
    Real cubic;

    HOPSCOTCH_DEVICE Real force(const Real& s) const {
        return s * fma(s, fma(s, cubic, quadratic), Real(1.0));
    }
    HOPSCOTCH_DEVICE Real stiffness(const Real& s) const {
        return fma(s, fma(s, Real(3.0) * cubic, Real(2.0) * quadratic), Real(1.0));
    }
    /// Integral of the force from `from` to `to`, without the cancellation of two potentials.
    HOPSCOTCH_DEVICE Real work(const Real& from, const Real& to) const {
        const Real sum = from + to;
        const Real squares = fma(from, from, to * to);
        const Real third = fma(to, from, squares) * Real(2.0);  // (to^3 - from^3) / (to - from)
        const Real mean = fma(cubic * Real(3.0), sum * squares,
                              fma(quadratic * Real(2.0), third, Real(6.0) * sum));
        return (to - from) * mean / Real(12.0);
    }
};

/// The extension s at which the force is `target` (1 but for a damper's share), on the branch of
/// the force that rises through s = 0. NaN where Newton's method finds none.
template <class Real>
HOPSCOTCH_DEVICE inline Real extension_at(const spring_law<Real>& spring, const Real& target) {
    using plain = primal_of<Real>;
    const spring_law<plain> law{primal(spring.quadratic), primal(spring.cubic)};
    const plain wanted = primal(target);
    const plain noise(lane_traits<Real>::rounding * 8.0);
    plain s = wanted;
    mask_of<Real> active = s == s;
    for (int i = 0; i < 100 && any(active); ++i) {
        const plain step = (law.force(s) - wanted) / law.stiffness(s);
        s = select(active, s - step, s);
        active = active & !(abs(step) <= noise * abs(s));
    }
    const mask_of<Real> rises = !active & (law.stiffness(s) > plain(0.0));
    s = select(rises, s, plain(0.0) / plain(0.0));
    return implicit_root(s, spring.force(Real(s)) - target, law.stiffness(s));
}

/// True where a motion s'' = -(linear s + q s^2 + c s^3 + ...) has passed the force's outer zero
/// and moves outward. With c <= 0 nothing beyond pulls it back.
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> runs_away(const Real& linear, const spring_law<Real>& spring,
                                                const Real& s, const Real& rate) {
    const Real zero(0.0);
    const Real secant = fma(s, fma(s, spring.cubic, spring.quadratic), linear);
    return (spring.cubic <= zero) & (secant < zero) & (s * rate > zero);
}

/// Why a hopper on this spring has no lift-off, or "".
inline std::string_view refusal_of_spring(double quadratic, double cubic, double gradient) {
    if (quadratic == 0.0 && cubic == 0.0) return {};
    // the force must rise from 0 to 1 without turning
    const spring_law<double> spring{quadratic, cubic};
    constexpr std::string_view weak =
        "the spring's force s + q s^2 + c s^3 turns before it reaches 1: there is no lift-off";
    double turn = unbounded;
    const double discriminant = quadratic * quadratic - 3.0 * cubic;
    if (cubic == 0.0) {
        if (quadratic < 0.0) turn = -0.5 / quadratic;
    } else if (discriminant >= 0.0) {
        // smallest positive zero of 1 + 2 q s + 3 c s^2
        const double root = std::sqrt(discriminant);
        for (const double s : {1.0 / (-quadratic + root), 1.0 / (-quadratic - root)}) {
            if (s > 0.0 && s < turn) turn = s;
        }
    }
    if (turn < unbounded && !(spring.force(turn) > 1.0)) return weak;
    const double lift = extension_at(spring, 1.0);
    if (!(lift > 0.0 && lift < turn)) return weak;
    if (!(1.0 + gradient * lift > 0.0)) return "gravity 1 + gamma y vanishes below lift-off";
    return {};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
