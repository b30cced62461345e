// The guaranteed first zero of a guard on one step of an integrated flow. The guard is a polynomial
// over the whole step; a bound on its curvature gives steps that never pass a zero, so that two
// crossings in one step, a touch, a zero at the end and a whole arc inside the first step are all
// seen.
#pragma once

#include "kernels/integrators/taylor.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::taylor {

/// Divides a guard's known zeros at t = 0 out of its polynomial. A guard that has just fired (or an
/// arc that begins on its own guard) is exactly zero there; what is left is positive.
///
/// \param guard   positive while nothing happens, falls through zero at the event
/// \param zeros   lane-wise 0, 1, 2 or 3: how many leading coefficients are zero by definition
template <class Real>
HOPSCOTCH_DEVICE inline void divide_out_zeros(series<Real>& guard, const Real& zeros) {
    for (int k = 1; k <= 3; ++k) {
        const mask_of<Real> shifted = zeros >= Real(static_cast<double>(k));
        if (!any(shifted)) break;
        for (int n = 0; n < order<Real>; ++n) {
            guard.c[n] = select(shifted, guard.c[n + 1], guard.c[n]);
        }
        guard.c[order<Real>] = select(shifted, Real(0.0), guard.c[order<Real>]);
    }
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

template <class Real>
struct value_and_bends {
    Real value, slope, bend;  // bend: half the second derivative
};

template <class Real>
HOPSCOTCH_DEVICE inline value_and_bends<Real> value_bends(const series<Real>& a, const Real& t) {
    value_and_bends<Real> at{a.c[order<Real>], Real(0.0), Real(0.0)};
    for (int n = order<Real> - 1; n >= 0; --n) {
        at.bend = fma(at.bend, t, at.slope);
        at.slope = fma(at.slope, t, at.value);
        at.value = fma(at.value, t, a.c[n]);
    }
    return at;
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
    const Real reach = smaller(horizon - t, t * Real(0.25));
    const Real end = t + reach;
    Real third(0.0);
    for (int n = order<Real>; n >= 3; --n) {
        const double factor = static_cast<double>(n) * (n - 1) * (n - 2);
        third = fma(third, end, abs(guard.c[n]) * Real(factor));
    }
    const auto [value, slope, bend] = value_bends(guard, t);
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

/// Share of a bound's first term that its rounding errors stay below.
inline constexpr double bound_rounding = 0x1p-40;

/// Does a bound show that the guard stays positive on the whole step?
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> stays_positive(const series<Real>& guard,
                                                     const Real& horizon) {
    const Real zero(0.0);
    Real least = guard.c[order<Real>];  // of c_n + c_{n+1} t + ...
    for (int n = order<Real> - 1; n >= 0; --n) {
        least = fma(horizon, select(least < zero, least, zero), guard.c[n]);
    }
    return least > guard.c[0] * Real(bound_rounding);
}

/// Does a bound of its rate show that the guard falls on the whole step?
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> falls_throughout(const series<Real>& guard,
                                                       const Real& horizon) {
    const Real zero(0.0);
    Real most = guard.c[order<Real>] * Real(static_cast<double>(order<Real>));
    for (int n = order<Real> - 1; n >= 1; --n) {
        most = fma(horizon, select(most > zero, most, zero),
                   guard.c[n] * Real(static_cast<double>(n)));
    }
    return most < guard.c[1] * Real(bound_rounding);
}

/// The zero of a guard that falls on the whole step, from above zero to `end`: Halley's method from
/// the cubic in the guard's value that fits both ends.
template <class Real>
HOPSCOTCH_DEVICE inline Real zero_of_falling(const series<Real>& guard, const Real& horizon,
                                             const value_and_slope<Real>& end,
                                             const mask_of<Real>& wanted) {
    const Real fall = guard.c[0] - end.value;
    const Real passed = guard.c[0] / fall;  // share of the fall before the zero
    const Real left = Real(1.0) - passed;
    // fall over rate at both ends; more than that would turn the cubic around
    const Real most = Real(3.0) * horizon;
    const Real first = smaller(fall / -guard.c[1], most);
    const Real last = smaller(fall / -end.slope, most);
    const Real mean = horizon * fma(passed, Real(-2.0), Real(3.0));
    const Real guess = passed * fma(passed, mean, left * fma(first, left, -(last * passed)));
    const auto fallen = [&](const Real& t) {
        const value_and_bends<Real> at = value_bends(guard, t);
        const Real under = fma(-at.value, at.bend, at.slope * at.slope);
        return value_and_step<Real>{-at.value, at.value * at.slope / under};
    };
    return bracketed_root<Real, 3>(fallen, {Real(0.0), horizon}, guess, wanted);
}

/// First zero of any guard that is positive at 0, by steps that never pass one.
///
/// \return  `found`, `unresolved` and `time` of the lanes wanted
template <class Real>
HOPSCOTCH_DEVICE inline guard_search<Real> zero_by_safe_steps(const series<Real>& g,
                                                              const Real& horizon,
                                                              const mask_of<Real>& wanted) {
    const Real zero(0.0);
    // bounds over the whole step: of the curvature, and of what the value's linear part leaves out
    Real curvature(0.0);
    Real bend(0.0);
    for (int n = order<Real>; n >= 2; --n) {
        const double factor = static_cast<double>(n) * (n - 1);
        const Real size = abs(g.c[n]);
        curvature = fma(curvature, horizon, size * Real(factor));
        bend = fma(bend, horizon, size);
    }
    const Real steepness = fma(bend, horizon, abs(g.c[1]));  // |value - start| over the time
    const Real noise_now = Real(lane_traits<Real>::rounding * 4.0) * abs(g.c[0]);
    const Real noise_rate = Real(lane_traits<Real>::rounding * 4.0) * steepness;
    mask_of<Real> active = wanted;
    mask_of<Real> found = wanted & !wanted;
    Real t(0.0);
    const Real settled(lane_traits<Real>::rounding * 4.0);
    constexpr int most_steps = lane_traits<Real>::rounding > 0x1p-60 ? 200 : 1000;
    constexpr int short_search = 12;  // simple zeros take 3 to 8 steps
    for (int i = 0; i < most_steps && any(active); ++i) {
        const value_and_slope<Real> at = value_slope(g, t);
        const Real reach = larger(at.value, zero);
        const Real root = sqrt(fma(at.slope, at.slope, Real(2.0) * curvature * reach));
        // the smaller root of value + slope d - curvature d^2 / 2, without cancellation
        const mask_of<Real> rises = at.slope > zero;
        Real step = select(rises, at.slope + root, reach + reach) /
                    select(rises, curvature, root - at.slope);
        Real noise = fma(noise_rate, t, noise_now);  // of the value at t
        if (i >= short_search) {
            step = longer_step(g, t, horizon, fma(noise_rate, horizon, noise_now), step);
            noise = noise + noise;
        }
        const Real next = t + step;
        const mask_of<Real> touches =
            (at.value <= noise) & (at.slope * at.slope <= Real(2.0) * curvature * noise);
        const Real scale = smaller(next, horizon);
        // the next step would be below rounding: curvature step^2 / |slope| bounds it
        const mask_of<Real> close = (next < horizon) & (Real(8.0) * curvature * (step * step) <=
                                                        settled * scale * -at.slope);
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
    return {found, active, t};
}

/// First time in [0, horizon] at which the guard is zero or below.
///
/// \param guard    after `divide_out_zeros`; its value at 0 decides: <= 0 there gives time 0
/// \param horizon  length of the step
/// \param wanted   lanes to search
/// \error  touching to rounding counts. Guards that bounds show to stay positive, or to fall on the
///         whole step, are decided at its end. Others are searched: where guard >= 0, guard' and
///         |guard''| <= L, nothing happens before (g' + sqrt(g'^2 + 2 L g)) / L; after a few such
///         steps, see `longer_step`. A lane not decided after 200 steps (1000 of wide arithmetic)
///         is `unresolved`; a guard that is not finite is not found.
template <class Real>
HOPSCOTCH_DEVICE inline guard_search<Real> first_zero(const series<Real>& guard,
                                                      const primal_of<Real>& horizon,
                                                      const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const plain zero(0.0);
    const auto& g = primal_series(guard);
    const mask_of<Real> none = wanted & !wanted;
    const mask_of<Real> at_once = wanted & (g.c[0] <= zero);
    guard_search<plain> zeros{at_once, none, zero};
    const mask_of<Real> open = wanted & (g.c[0] > zero) & !stays_positive(g, horizon);
    if (any(open)) {
        const mask_of<Real> falls = open & falls_throughout(g, horizon);
        const value_and_slope<plain> end = value_slope(g, horizon);
        const mask_of<Real> crosses = falls & (end.value <= zero);
        if (any(crosses)) {
            zeros.time = select(crosses, zero_of_falling(g, horizon, end, crosses), zeros.time);
            zeros.found = zeros.found | crosses;
        }
        const mask_of<Real> undecided = open & !falls;
        if (any(undecided)) {
            const guard_search<plain> rest = zero_by_safe_steps(g, horizon, undecided);
            zeros.time = select(undecided, rest.time, zeros.time);
            zeros.found = zeros.found | rest.found;
            zeros.unresolved = rest.unresolved;
        }
    }
    if constexpr (std::same_as<plain, Real>) {
        return zeros;
    } else {
        const plain slope = value_slope(g, zeros.time).slope;
        return {zeros.found, zeros.unresolved,
                implicit_root(zeros.time, evaluate(guard, zeros.time),
                              select(slope == zero, infinity<plain>(), slope))};
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::taylor
