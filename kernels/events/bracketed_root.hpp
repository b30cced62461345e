// Newton's or Halley's method inside a bracket, lane by lane: the workhorse behind every event
// time. Each lane stops on its own convergence, so that its bits do not depend on its neighbours.
#pragma once

#include "kernels/lanes/lane.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// A function's value and its derivative at one point.
template <class Real>
struct value_and_slope {
    Real value;
    Real slope;
};

/// A function's value (only its sign counts) and the step of an iteration towards its root, x -
/// step.
template <class Real>
struct value_and_step {
    Real value;
    Real step;
};

template <class Real>
HOPSCOTCH_DEVICE inline value_and_step<Real> iteration(const value_and_slope<Real>& f) {
    return {f.value, f.value / f.slope};
}
template <class Real>
HOPSCOTCH_DEVICE inline value_and_step<Real> iteration(const value_and_step<Real>& f) {
    return f;
}

/// rounding^(1/order) / 16: a step shorter than that leaves an error below rounding.
template <class Real, int Order>
constexpr double settled_step() {
    double root = 1.0;
    for (int i = 0; i < 2000;
         ++i) {  // x -> root of x^Order = rounding, by Newton's method from above
        double power = 1.0;
        for (int j = 1; j < Order; ++j) power *= root;
        root -= (root * power - lane_traits<Real>::rounding) / (Order * power);
    }
    return root / 16.0;
}

template <class Real>
struct bracket {
    Real low;
    Real high;
};

template <class Real>
HOPSCOTCH_DEVICE inline Real larger(const Real& a, const Real& b) {
    return select(a < b, b, a);
}
template <class Real>
HOPSCOTCH_DEVICE inline Real smaller(const Real& a, const Real& b) {
    return select(b < a, b, a);
}

/// Most Newton or bisection steps: a bracket of any width shrinks to one ulp long before.
inline constexpr int most_root_steps = 400;

/// Root of a function that rises through zero on [low, high].
///
/// \tparam Order   of convergence: 2 Newton, 3 Halley
/// \param rising  x -> value_and_slope or value_and_step; value <= 0 at low, >= 0 at high
/// \param within  the bracket, lane-wise
/// \param guess   starting point; a guess outside the bracket is replaced by its midpoint
/// \param wanted  lanes to solve; the others return their guess
/// \return        the root, converged below the rounding of x
/// \error         none; a lane whose function is not finite stops where it is
/// Steps that leave the bracket, or that shrink slower than bisection would, become bisections. A
/// lane is done when a step is so short that the next would be below rounding, or when the bracket
/// collapsed.
template <class Real, int Order = 2, class Function>
HOPSCOTCH_DEVICE inline Real bracketed_root(Function&& rising, bracket<Real> within, Real guess,
                                            mask_of<Real> wanted) {
    // an arithmetic of whole sets has no single point to iterate on and brings its own way
    if constexpr (requires { root_by_arithmetic(rising, within, guess, wanted); }) {
        return root_by_arithmetic(rising, within, guess, wanted);
    } else {
        constexpr double settled_share = settled_step<Real, Order>();
        const Real close_enough(settled_share);
        const Real collapsed(lane_traits<Real>::rounding * 2.0);
        const Real half(0.5);
        Real low = within.low;
        Real high = within.high;
        const mask_of<Real> inside = (guess >= low) & (guess <= high);
        Real x = select(inside, guess, (low + high) * half);
        Real last_step = high - low;
        mask_of<Real> active = wanted;
        for (int i = 0; i < most_root_steps && any(active); ++i) {
            const value_and_step<Real> f = iteration(rising(x));
            const mask_of<Real> left = f.value < Real(0.0);
            low = select(active & left, x, low);
            high = select(active & !left, x, high);
            const Real newton = x - f.step;
            const mask_of<Real> good =
                (newton >= low) & (newton <= high) & (abs(f.step) <= last_step * Real(0.75));
            const Real middle = (low + high) * half;
            const Real next = select(good, newton, middle);
            const Real scale = abs(next);
            const mask_of<Real> settled = (good & (abs(f.step) <= close_enough * scale)) |
                                          ((high - low) <= collapsed * scale) |
                                          (f.value == Real(0.0));
            const mask_of<Real> lost = !(f.value == f.value);
            last_step = select(active, abs(next - x), last_step);
            x = select(active & !lost & !(f.value == Real(0.0)), next, x);
            active = active & !settled & !lost;
        }
        return x;
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
