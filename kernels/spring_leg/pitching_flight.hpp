// Flight of the pitching runner: a parabola and a body that turns evenly. The foot of the leg held ready touches
// the ground where a transcendental function of time falls through zero; its curvature is bounded, so that no
// crossing is passed. Source: models/slip.md section 6.
#pragma once

#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/implicit_root.hpp"
#include "kernels/spring_leg/pitching_lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// Height of the foot held ready: centre's height + swing_cos cos(pitch) + swing_sin sin(pitch) - level.
template <class Real>
struct foot_height {
    Real height, climb;      // of the centre at lift-off
    Real pitch, pitch_rate;
    Real swing_cos, swing_sin, level;

    HOPSCOTCH_DEVICE value_and_slope<Real> at(const Real& t) const {
        const auto turned = sin_cos(fma(pitch_rate, t, pitch));
        const Real centre = fma(t, fma(Real(-0.5), t, climb), height);
        const Real swing = fma(swing_cos, turned.cos, swing_sin * turned.sin);
        const Real swing_rate = fma(swing_sin, turned.cos, -(swing_cos * turned.sin));
        return {centre + (swing - level), fma(pitch_rate, swing_rate, climb - t)};
    }
};

template <class Real>
HOPSCOTCH_DEVICE inline foot_height<primal_of<Real>> without_slopes(const foot_height<Real>& foot) {
    return {primal(foot.height),    primal(foot.climb),     primal(foot.pitch), primal(foot.pitch_rate),
            primal(foot.swing_cos), primal(foot.swing_sin), primal(foot.level)};
}

/// Time at which a body at `height` > 0 with upward velocity `climb` falls to the ground.
template <class Real>
HOPSCOTCH_DEVICE inline Real fall_time(const Real& height, const Real& climb) {
    const Real impact = sqrt(fma(climb, climb, height + height));
    return select(climb < Real(0.0), (height + height) / (impact - climb), climb + impact);
}

template <class Real>
struct touchdown_search {
    mask_of<Real> found, unresolved;
    Real time;
};

/// Most steps of the search: of the order of ten per turn of the body while the foot is near the ground.
inline constexpr int most_flight_steps = 2000;

/// First downward zero of the foot's height before the centre of mass falls to the ground. A foot below the
/// ground at lift-off (the leg is reset through it) is ignored until it has risen above.
///
/// \param foot    in units where gravity is 1
/// \param wanted  lanes in flight
/// \error  touching from above to rounding counts; touching from below is `unresolved`
/// With |h''| <= L a zero is at least (h' + sqrt(h'^2 + 2 L h)) / L away; while the parabola alone is higher
/// than the swing can reach, the whole arc is skipped.
template <class Real>
HOPSCOTCH_DEVICE inline touchdown_search<Real> first_touchdown(const foot_height<Real>& foot,
                                                               const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const plain zero(0.0);
    const plain one(1.0);
    const plain two(2.0);
    const auto f = without_slopes(foot);
    const plain reach = sqrt(fma(f.swing_cos, f.swing_cos, f.swing_sin * f.swing_sin));
    const plain curvature = fma(reach, f.pitch_rate * f.pitch_rate, one);
    const plain end = fall_time(f.height, f.climb);
    // |t - climb|^2 below this: the foot is up whatever the pitch
    const plain clear = fma(f.climb, f.climb, two * ((f.height - f.level) - reach));
    const plain clear_until = f.climb + sqrt(larger(clear, zero));
    const plain ulps(lane_traits<Real>::rounding * 4.0);
    const plain noise_at_start = ulps * (abs(f.height) + reach + abs(f.level));

    plain t(0.0);
    const value_and_slope<plain> start = f.at(t);
    plain below = select((start.value > zero) | ((start.value == zero) & (start.slope > zero)), zero, one);
    mask_of<Real> active = wanted;
    mask_of<Real> found = wanted & !wanted;
    mask_of<Real> unresolved = found;
    for (int i = 0; i < most_flight_steps && any(active); ++i) {
        const value_and_slope<plain> at = f.at(t);
        const mask_of<Real> is_below = below > zero;
        const plain value = negate_where(is_below, at.value);
        const plain slope = negate_where(is_below, at.slope);
        const plain distance = larger(value, zero);
        const plain root = sqrt(fma(slope, slope, two * curvature * distance));
        const plain step = select(slope > zero, (slope + root) / curvature, two * distance / (root - slope));
        const plain noise = fma(ulps * t, abs(f.climb) + t, noise_at_start);
        const mask_of<Real> near = value <= noise;
        const mask_of<Real> touches = near & (slope * slope <= two * curvature * noise);
        const mask_of<Real> crosses = (near | (step <= ulps * t)) & (slope < zero);
        const mask_of<Real> arrived = active & (touches | crosses);
        const plain from_top = t - f.climb;
        const mask_of<Real> is_clear = !is_below & (from_top * from_top < clear);
        const plain next = select(is_clear, larger(t + step, clear_until), t + step);
        const mask_of<Real> passed = active & !arrived & !(next < end);
        found = found | (arrived & !is_below);
        unresolved = unresolved | (arrived & is_below & touches);
        below = select(arrived & is_below, zero, below);
        t = select(active & !arrived & !passed, next, t);
        active = active & !passed & !unresolved & !found;
    }
    unresolved = unresolved | active;
    if constexpr (std::same_as<plain, Real>) {
        return {found, unresolved, t};
    } else {
        const plain slope = f.at(t).slope;
        return {found, unresolved,
                implicit_root(t, foot.at(Real(t)).value, select(slope == zero, infinity<plain>(), slope))};
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
