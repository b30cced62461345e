// Any flight of the passive hopper in closed form: free starts, rebounds (restitution > 0) and
// damped springs. State: spring extension s, its rate, gap G = (1 + M) y2 and its rate; G'' = F - 1
// with the spring force F = s + 2 zeta s'. Source: models/passive_hopper.md sections 2 and 6, CPRR
// Eqs (2), (4).
#pragma once

#include "kernels/elementary/arctangent.hpp"
#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/exponential.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/events/piece_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// Solution of u'' + 2 zeta u' + u = 0 from (u0, u0'); Damped = false is the case zeta = 0.
template <bool Damped, class Real>
struct oscillator {
    Real value;      // u(0)
    Real rate;       // u'(0)
    Real damping;    // zeta in [0, 1)
    Real frequency;  // sqrt(1 - zeta^2)

    struct state {
        Real value;
        Real rate;
    };

    HOPSCOTCH_DEVICE state at(Real t) const {
        if constexpr (Damped) {
            const auto angle = sin_cos(frequency * t);
            const Real decay = exp(-(damping * t));
            const Real ratio = angle.sin / frequency;
            return {decay * fma(value, angle.cos, (rate + damping * value) * ratio),
                    decay * fma(rate, angle.cos, -((value + damping * rate) * ratio))};
        } else {
            const auto angle = sin_cos(t);
            return {fma(value, angle.cos, rate * angle.sin),
                    fma(rate, angle.cos, -(value * angle.sin))};
        }
    }

    /// u(t) - u(0) - u'(0) t and u'(t) - u'(0) by the Taylor series, for 0 <= t <= 1/2.
    HOPSCOTCH_DEVICE state departure(Real t) const {
        constexpr int terms = lane_traits<Real>::rounding > 0x1p-60    ? 17
                              : lane_traits<Real>::rounding > 0x1p-110 ? 28
                                                                       : 46;
        Real before = value;  // n-th and (n+1)-th derivatives at 0
        Real current = rate;
        Real power(1.0);  // t^n / n!
        Real sum(0.0);
        Real rate_sum(0.0);
        for (int n = 1; n < terms; ++n) {
            const Real next = Damped ? -(before + Real(2.0) * damping * current) : -before;
            power = power * t / Real(n);
            rate_sum = fma(next, power, rate_sum);
            sum = fma(next, power * t / Real(n + 1), sum);
            before = current;
            current = next;
        }
        return {sum, rate_sum};
    }
};

/// The gap of a flight as a function of time since its start.
template <bool Damped, class Real>
struct free_flight {
    oscillator<Damped, Real> spring;
    Real gap0;
    Real rate0;

    HOPSCOTCH_DEVICE typename oscillator<Damped, Real>::state departure(Real t) const {
        const auto there = spring.at(t);
        Real value = (there.value - spring.value) - spring.rate * t;
        Real rate = there.rate - spring.rate;
        const mask_of<Real> is_short = t < Real(0.5);
        if (any(is_short)) {
            const auto series = spring.departure(t);
            value = select_form(is_short, series.value, value);
            rate = select_form(is_short, series.rate, rate);
        }
        return {value, rate};
    }

    HOPSCOTCH_DEVICE Real gap(Real t) const {
        return gap0 + (t * fma(t, Real(-0.5), rate0) - departure(t).value);
    }
    HOPSCOTCH_DEVICE Real gap_rate(Real t) const { return (rate0 - t) - departure(t).rate; }
    HOPSCOTCH_DEVICE Real gap_curvature(Real t) const { return force(t) - Real(1.0); }

    /// F = s + 2 zeta s'.
    HOPSCOTCH_DEVICE Real force(Real t) const {
        const auto there = spring.at(t);
        return Damped ? fma(Real(2.0) * spring.damping, there.rate, there.value) : there.value;
    }
};

/// How a flight leaves t = 0 (flagged by the caller, never inferred from rounded values).
template <class Real>
struct contact_search {
    Real time;
    mask_of<Real> found;
};

/// Most half oscillations that a search looks at: a flight that long starts 5e10 spring lengths
/// high. Damped swings of such a size are not skipped, since the spring's reach is taken at the
/// start.
inline constexpr int most_flight_pieces = 100000;

/// First contact of a flight: G falls through zero, or touches it.
///
/// \param flow      the flight
/// \param lift_off  lanes with G = G' = 0, F = 1 rising at t = 0 (an inflection that does not
/// count) \param wanted    lanes to search \return          time and found; found = false where
/// gravity has not closed the gap within the last
///                  possible contact time (a non-finite state) or within most_flight_pieces
/// \error           none
/// The extrema of F are equally spaced; between two of them F = 1 has at most one root, an
/// inflection of the gap, so that every piece between has curvature of one sign. While the ball is
/// higher than the spring can reach, whole oscillations are skipped (page, section 6).
template <bool Damped, class Real>
HOPSCOTCH_DEVICE inline contact_search<Real> first_contact(const free_flight<Damped, Real>& flow,
                                                           mask_of<Real> lift_off,
                                                           mask_of<Real> wanted) {
    const Real zero(0.0);
    const Real one(1.0);
    const oscillator<Damped, Real>& spring = flow.spring;
    const Real damping = Damped ? spring.damping : zero;
    const Real frequency = Damped ? spring.frequency : one;
    const Real half_period = pi<Real>() / frequency;
    const Real force0 = spring.value + Real(2.0) * damping * spring.rate;
    const Real force_rate0 = spring.rate - Real(2.0) * damping * force0;
    const Real phase = atan2(frequency * force_rate0, force0 + damping * force_rate0);
    const Real first_extremum = select(phase > zero, phase, phase + pi<Real>()) / frequency;

    const Real lag = (spring.rate + damping * spring.value) / frequency;
    const Real reach = sqrt(fma(spring.value, spring.value, lag * lag)) * Real(1.0 + 1e-9);
    const Real rise = flow.rate0 + spring.rate;
    const Real height = flow.gap0 + spring.value;
    const Real above = fma(rise, rise, Real(2.0) * (height - reach));
    const Real safe_until =
        rise + sqrt(larger(above, zero));  // above the spring's reach just before
    const Real last_time = rise + sqrt(fma(rise, rise, Real(2.0) * (height + reach))) + half_period;

    Real segment(0.0);
    Real from(0.0);
    Real bend = select(lift_off, one, force0 - one);  // sign of the curvature at `from`
    mask_of<Real> searching = wanted;
    mask_of<Real> found = wanted & !wanted;
    Real time(0.0);
    for (int piece = 0; piece < most_flight_pieces && any(searching); ++piece) {
        const Real to = fma(segment, half_period, first_extremum);
        const Real bend_to = flow.gap_curvature(to);
        const mask_of<Real> convex = bend > zero;
        const mask_of<Real> changes =
            searching & ((convex & (bend_to < zero)) | ((bend < zero) & (bend_to > zero)));
        Real middle = to;
        if (any(changes)) {
            const Real direction = select(convex, Real(-1.0), one);
            const auto rising = [&](const Real& t) {
                const auto there = spring.at(t);
                const Real force = there.value + Real(2.0) * damping * there.rate;
                const Real force_rate = there.rate - Real(2.0) * damping * force;
                return value_and_slope<Real>{direction * (force - one), direction * force_rate};
            };
            middle = select(
                changes, bracketed_root<Real>(rising, {from, to}, (from + to) * Real(0.5), changes),
                to);
        }
        // a rebound from the ground lands near the root of its parabola
        const Real parabola = Real(2.0) * flow.rate0 / (one - force0);
        const Real guess = select((segment == zero) & (flow.gap0 == zero), parabola, middle);
        const found_root<Real> first =
            first_root_on_piece<Real>(flow, from, middle, convex, guess, searching);
        const mask_of<Real> go_on = changes & !first.found;
        const found_root<Real> second =
            first_root_on_piece<Real>(flow, middle, to, !convex, to, go_on);
        time = select(searching & first.found, first.time,
                      select(go_on & second.found, second.time, time));
        const mask_of<Real> now = searching & (first.found | (go_on & second.found));
        found = found | now;

        const Real centre_height = fma(to, fma(to, Real(-0.5), rise), height);
        const Real skipped = floor((safe_until - first_extremum) / half_period);
        const mask_of<Real> out_of_reach = (centre_height > reach) & (skipped > segment);
        from = select(out_of_reach, fma(skipped, half_period, first_extremum), to);
        segment = select(out_of_reach, skipped, segment) + one;
        bend = flow.gap_curvature(from);
        // beyond 1e16 time no longer advances, beyond 1e154 squares overflow: no search comes to an
        // end
        const mask_of<Real> advances = fma(segment, half_period, first_extremum) > from;
        searching = searching & !now & advances & (from <= last_time) & (last_time < Real(1e300));
    }
    return {time, found};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
