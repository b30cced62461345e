// The guaranteed first zero of a guard on one step of an integrated flow. The guard is a polynomial
// over the whole step; a bound on its curvature gives steps that never pass a zero, so that two
// crossings in one step, a touch, a zero at the end and a whole arc inside the first step are all
// seen.
#pragma once

#include "kernels/integrators/taylor.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::taylor {

/// A guard's polynomial with its known zeros at t = 0 divided out. A guard that has just fired (or
/// an arc that begins on its own guard) is exactly zero there; what is left is positive.
///
/// \param guard   positive while nothing happens, falls through zero at the event
/// \param zeros   lane-wise 0, 1, 2 or 3: how many leading coefficients are zero by definition
template <class Real>
HOPSCOTCH_DEVICE inline series<Real> without_zeros(const series<Real>& guard, const Real& zeros) {
    series<Real> result = guard;
    for (int k = 1; k <= 3; ++k) {
        const mask_of<Real> shifted = zeros >= Real(static_cast<double>(k));
        if (!any(shifted)) break;
        for (int n = 0; n < order<Real>; ++n) {
            result.c[n] = select(shifted, result.c[n + 1], result.c[n]);
        }
        result.c[order<Real>] = select(shifted, Real(0.0), result.c[order<Real>]);
    }
    return result;
}

template <class Real>
struct guard_search {
    mask_of<Real> found;
    mask_of<Real> unresolved;  // the search came to no decision
    Real time;
};

/// Value and slope of a polynomial without derivatives.
template <class Real>
HOPSCOTCH_DEVICE inline value_and_slope<Real> value_slope(const series<Real>& a, const Real& t) {
    Real value = a.c[order<Real>];
    Real slope(0.0);
    for (int n = order<Real> - 1; n >= 0; --n) {
        slope = fma(slope, t, value);
        value = fma(value, t, a.c[n]);
    }
    return {value, slope};
}

/// Next to a zero of third order the curvature's bound gives ever shorter steps. There the bound on
/// the third derivative, |g'''| <= B, is the better one: nothing happens while the cubic
/// g + g' d + g'' d^2 / 2 - B d^3 / 6 stays above zero (above the value's noise, lest a touch be
/// passed). The bound holds up to a quarter beyond t: over a long step it would be too weak.
///
/// \param safe  a step known to pass no zero
/// \return      a longer one, where the cubic allows it
template <class Real>
HOPSCOTCH_DEVICE inline Real longer_step(const series<Real>& guard, const Real& t,
                                         const Real& horizon, const Real& noise, const Real& safe) {
    const Real zero(0.0);
    const Real half(0.5);
    Real value = guard.c[order<Real>];
    Real slope(0.0);
    Real bend(0.0);  // half the second derivative
    const Real reach = smaller(horizon - t, t * Real(0.25));
    const Real end = t + reach;
    Real third(0.0);
    for (int n = order<Real>; n >= 3; --n) {
        const double factor = static_cast<double>(n) * (n - 1) * (n - 2);
        third = fma(third, end, abs(guard.c[n]) * Real(factor));
    }
    for (int n = order<Real> - 1; n >= 0; --n) {
        bend = fma(bend, t, slope);
        slope = fma(slope, t, value);
        value = fma(value, t, guard.c[n]);
    }
    const Real steep = third / Real(6.0);
    const auto cubic = [&](const Real& d) {
        return fma(d, fma(d, fma(-d, steep, bend), slope), value);
    };
    // where the cubic has a minimum before d, it must be above zero there too
    const Real discriminant = fma(bend, bend, half * third * slope);
    const mask_of<Real> dips = (slope < zero) & (bend > zero) & (discriminant > zero);
    const Real bottom = -slope / (bend + sqrt(select(dips, discriminant, zero)));
    const mask_of<Real> touches = dips & !(cubic(bottom) > noise);
    const auto is_safe = [&](const Real& d) {
        return (d <= reach) & (cubic(d) > noise) & !(touches & (bottom < d));
    };
    Real step = safe;
    constexpr int most_doublings = lane_traits<Real>::rounding > 0x1p-60 ? 24 : 100;
    for (int i = 0; i < most_doublings; ++i) {
        const Real next = step * Real(2.0);
        const mask_of<Real> longer = is_safe(next);
        step = select(longer, next, step);
        if (!any(longer)) break;
    }
    Real more = step * half;
    for (int i = 0; i < 3; ++i) {
        step = select(is_safe(step + more), step + more, step);
        more = more * half;
    }
    return step;
}

/// First time in [0, horizon] at which the guard is zero or below.
///
/// \param guard    from `without_zeros`; its value at 0 decides: <= 0 there gives time 0
/// \param horizon  length of the step
/// \param wanted   lanes to search
/// \error  touching to rounding counts. Where guard >= 0, guard' and |guard''| <= L, nothing
/// happens before
///         (g' + sqrt(g'^2 + 2 L g)) / L; after a few such steps, see `longer_step`. A lane not
///         decided after 200 steps (1000 of wide arithmetic) is `unresolved`; a guard that is not
///         finite is not found.
template <class Real>
HOPSCOTCH_DEVICE inline guard_search<Real> first_zero(const series<Real>& guard,
                                                      const primal_of<Real>& horizon,
                                                      const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const plain zero(0.0);
    const series<plain> g = primal_series(guard);
    // bounds over the whole step: of the curvature, and of what the value's linear part leaves out
    plain curvature(0.0);
    plain bend(0.0);
    for (int n = order<Real>; n >= 2; --n) {
        const double factor = static_cast<double>(n) * (n - 1);
        const plain size = abs(g.c[n]);
        curvature = fma(curvature, horizon, size * plain(factor));
        bend = fma(bend, horizon, size);
    }
    const plain steepness = fma(bend, horizon, abs(g.c[1]));  // |value - start| over the time
    const plain noise_now = plain(lane_traits<Real>::rounding * 4.0) * abs(g.c[0]);
    const plain noise_rate = plain(lane_traits<Real>::rounding * 4.0) * steepness;
    const plain lower_end = smaller(g.c[0], fma(g.c[1], horizon, g.c[0]));
    mask_of<Real> active = wanted & !(lower_end > bend * horizon * horizon);
    plain t(0.0);
    mask_of<Real> found = active & (g.c[0] <= zero);
    active = active & (g.c[0] > zero);
    if (any(active)) {
        const plain settled(lane_traits<Real>::rounding * 4.0);
        constexpr int most_steps = lane_traits<Real>::rounding > 0x1p-60 ? 200 : 1000;
        constexpr int short_search = 12;  // simple zeros take 3 to 8 steps
        for (int i = 0; i < most_steps && any(active); ++i) {
            const value_and_slope<plain> at = value_slope(g, t);
            const plain reach = larger(at.value, zero);
            const plain root = sqrt(fma(at.slope, at.slope, plain(2.0) * curvature * reach));
            // the smaller root of value + slope d - curvature d^2 / 2, without cancellation
            const mask_of<Real> rises = at.slope > zero;
            plain step = select(rises, at.slope + root, reach + reach) /
                         select(rises, curvature, root - at.slope);
            plain noise = fma(noise_rate, t, noise_now);  // of the value at t
            if (i >= short_search) {
                step = longer_step(g, t, horizon, fma(noise_rate, horizon, noise_now), step);
                noise = noise + noise;
            }
            const plain next = t + step;
            const mask_of<Real> touches =
                (at.value <= noise) & (at.slope * at.slope <= plain(2.0) * curvature * noise);
            const plain scale = smaller(next, horizon);
            // the next step would be below rounding: curvature step^2 / |slope| bounds it
            const mask_of<Real> close =
                (next < horizon) &
                (plain(8.0) * curvature * (step * step) <= settled * scale * -at.slope);
            const mask_of<Real> arrived =
                active & ((at.value <= zero) | touches | (step <= settled * scale));
            const mask_of<Real> passed = active & !arrived & !(next < horizon);
            found = found | arrived | (active & close);
            t = select(active & !arrived & !passed, next, t);
            active = active & !arrived & !passed & !close;
            // at the step's end itself nothing is left to bound
            const mask_of<Real> at_end = passed & (value_slope(g, horizon).value <= zero);
            t = select(at_end, horizon, t);
            found = found | at_end;
        }
    }
    if constexpr (std::same_as<plain, Real>) {
        return {found, active, t};
    } else {
        const plain slope = value_slope(g, t).slope;
        return {
            found, active,
            implicit_root(t, evaluate(guard, t), select(slope == zero, infinity<plain>(), slope))};
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::taylor
