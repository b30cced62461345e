// The gap between a ball in flight and a sinusoidal paddle, without cancellation at short times,
// and its first zero. Source: models/paddle_juggler.md, section 2.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/events/alternating_series.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/double_double.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::paddle {

/// Gap and its derivatives at one time.
template <class Real>
struct gap_values {
    Real value, rate, curvature;
};

/// Flight that leaves the paddle at phase theta with relative velocity U >= 0. Units: gravity 1,
/// angular frequency 1.
template <class Real>
struct ball_gap {
    Real amplitude;  // Gamma
    Real speed;      // U
    Real sine;       // of theta
    Real cosine;
    Real weight;  // effective gravity on the paddle at launch, 1 - Gamma sin theta

    HOPSCOTCH_DEVICE gap_values<Real> at(const Real& t) const {
        const Real one(1.0);
        const Real half(0.5);
        const auto is_short = t <= half;
        const sine_cosine<Real> turn = sin_cos(t);
        Real cubic(0.0);    // t - sin t
        Real quartic(0.0);  // cos t - 1 + t^2 / 2
        Real verse = one - turn.cos;
        Real lag = t - turn.sin;
        if (any(is_short)) {
            const Real near = select(is_short, t, half);
            const Real square = near * near;
            cubic = near * square / Real(6.0) * nested_sum<2, 3>(square);
            quartic = square * square / Real(24.0) * nested_sum<3, 4>(square);
            verse = select(is_short, half * square - quartic, verse);
            lag = select(is_short, cubic, lag);
        }
        // on short flights the t^2 terms of ball and paddle are joined before they cancel
        const Real gravity = select(is_short, weight, one);
        const Real rise = select(is_short, -quartic, verse);
        const Real rise_rate = select(is_short, -cubic, turn.sin);
        const Real free = t * fma(-(half * gravity), t, speed);
        const Real value = fma(amplitude, fma(sine, rise, cosine * lag), free);
        const Real rate =
            fma(amplitude, fma(sine, rise_rate, cosine * verse), fma(-gravity, t, speed));
        const Real curvature = fma(amplitude, fma(sine, turn.cos, cosine * turn.sin), -one);
        return {value, rate, curvature};
    }
};

template <class Real>
HOPSCOTCH_DEVICE inline ball_gap<Real> gap_after(const Real& amplitude, const Real& phase,
                                                 const Real& speed) {
    const sine_cosine<Real> turn = sin_cos(phase);
    return {amplitude, speed, turn.sin, turn.cos, fma(-amplitude, turn.sin, Real(1.0))};
}

/// The least gap of a near miss, where rounding hides its sign: recomputed in twice the digits.
template <class Real>
HOPSCOTCH_DEVICE inline Real precise_gap(const Real& amplitude, const Real& phase,
                                         const Real& speed, const Real& t) {
    if constexpr (binary64_lane<Real>) {
        using wide = double_double<Real>;
        const Real zero(0.0);
        const sine_cosine<wide> start = sin_cos(wide(phase, zero));
        const sine_cosine<wide> turn = sin_cos(wide(t, zero));
        const wide moved =
            start.sin * (wide(1.0) - turn.cos) + start.cos * (wide(t, zero) - turn.sin);
        const wide free = wide(speed, zero) - wide(t, zero) * wide(0.5);
        const wide gap = wide(t, zero) * free + wide(amplitude, zero) * moved;
        return gap.high;
    } else {
        return gap_after(amplitude, phase, speed).at(t).value;
    }
}

/// The stretch of flight that is searched now: between two inflections of the gap.
template <class Real>
struct piece {
    Real from, to;
    mask_of<Real> is_convex;
};

/// Everything the search needs of a flight, in primal arithmetic.
template <class Real>
struct flight_search {
    ball_gap<Real> gap;
    Real phase;
    Real convex_from;  // phi_1 = asin(1 / Gamma): the paddle falls faster than the ball from here
    Real convex_to;    // pi - phi_1
    mask_of<Real> has_convex;  // Gamma > 1
    Real above_from;           // between these times the ball is above the top of the stroke
    Real above_to;
    Real latest;        // contact has happened by then
    Real lowest_start;  // where Newton's method starts on far pieces
};

template <class Real>
HOPSCOTCH_DEVICE inline Real first_convex_phase(const Real& amplitude) {
    const Real one(1.0);
    const auto has_convex = amplitude > one;
    const Real excess = select(has_convex, (amplitude - one) * (amplitude + one), Real(0.0));
    return atan2(one, sqrt(excess));
}

template <class Real>
HOPSCOTCH_DEVICE inline flight_search<Real> search_of(const ball_gap<Real>& gap, const Real& phase,
                                                      const Real& convex_from) {
    const Real zero(0.0);
    const Real two(2.0);
    flight_search<Real> search{.gap = gap, .phase = phase, .convex_from = convex_from};
    search.convex_to = pi<Real>() - convex_from;
    search.has_convex = gap.amplitude > Real(1.0);
    const Real velocity = fma(gap.amplitude, gap.cosine, gap.speed);  // V, absolute
    const Real square = velocity * velocity;
    const Real below_top = two * gap.amplitude * (Real(1.0) - gap.sine);
    const auto rises_above = (velocity > zero) & (square > below_top);
    const Real root = sqrt(select(rises_above, square - below_top, zero));
    // a margin of 1e-9: a ball that is level with the top somewhere near the ends is not skipped
    search.above_to = select(rises_above, (velocity + root) * Real(1.0 - 1e-9), -Real(1.0));
    search.above_from = (velocity - root) * Real(1.0 + 1e-9) + Real(1e-12);
    search.latest = velocity + sqrt(fma(two * gap.amplitude, Real(1.0) + gap.sine, square));
    const Real level = fma(two * gap.amplitude, gap.sine, square);
    search.lowest_start = velocity + sqrt(select(level > zero, level, zero));
    return search;
}

/// The first contact. \param from_release  lanes that leave the paddle on the inflection itself
template <class Real>
HOPSCOTCH_DEVICE inline Real first_contact(const flight_search<Real>& search,
                                           mask_of<Real> from_release, mask_of<Real> wanted,
                                           mask_of<Real>& found) {
    const Real zero(0.0);
    const Real half(0.5);
    const Real turn = two_pi<Real>();
    const Real phase = search.phase;
    const mask_of<Real> starts_convex =
        search.has_convex &
        (from_release | ((phase >= search.convex_from) & (phase < search.convex_to)));
    const mask_of<Real> before = phase < search.convex_from;
    // next phase at which the curvature changes sign
    Real edge = select(starts_convex, search.convex_to,
                       select(before, search.convex_from, search.convex_from + turn));
    piece<Real> now{zero, edge - phase, starts_convex};
    // one concave piece where the paddle never falls faster than the ball
    now.to = select(search.has_convex, now.to, fma(search.latest, Real(1.0 + 1e-9), Real(1e-6)));
    mask_of<Real> searching = wanted;
    found = wanted & !wanted;
    bracket<Real> within{zero, zero};  // of the contact
    Real begin = zero;
    for (int i = 0; i < 4000 && any(searching); ++i) {
        const mask_of<Real> skipped =
            (now.from >= search.above_from) & (now.to < search.above_to) & search.has_convex;
        const mask_of<Real> here = searching & !skipped;
        if (any(here)) {
            const mask_of<Real> is_first = now.from == zero;
            gap_values<Real> end = search.gap.at(now.to);
            Real lowest = now.to;
            const mask_of<Real> bowl =
                here & now.is_convex & !is_first & (search.gap.at(now.from).rate < zero);
            const mask_of<Real> has_minimum = bowl & (end.rate > zero);
            if (any(has_minimum)) {
                const auto rate = [&](const Real& t) {
                    const gap_values<Real> gap = search.gap.at(t);
                    return value_and_slope<Real>{gap.rate, gap.curvature};
                };
                lowest = bracketed_root<Real>(rate, {now.from, now.to}, (now.from + now.to) * half,
                                              has_minimum);
                lowest = select(has_minimum, lowest, now.to);
                end = search.gap.at(lowest);
                const mask_of<Real> is_close =
                    has_minimum &
                    (abs(end.value) <= Real(1e-13) * (fma(lowest, lowest, search.gap.amplitude)));
                if (any(is_close)) {
                    const Real precise =
                        precise_gap(search.gap.amplitude, phase, search.gap.speed, lowest);
                    end.value = select(is_close, precise, end.value);
                }
            }
            const mask_of<Real> hits = (bowl | (here & !now.is_convex)) & (end.value <= zero);
            const Real short_flight = (search.gap.speed + search.gap.speed) / search.gap.weight;
            const Real guess = select(is_first & (short_flight > zero) & (short_flight < now.to),
                                      short_flight, search.lowest_start);
            const Real start = select(guess < now.to, guess,
                                      select(now.is_convex, (now.from + lowest) * half, now.to));
            within.low = select(hits, now.from, within.low);
            within.high = select(hits, lowest, within.high);
            begin = select(hits, start, begin);
            found = found | hits;
            searching = searching & !hits;
        }
        // to the next piece, or to the one before the ball comes down to the stroke again
        const Real after = select(now.is_convex, search.convex_from + turn, search.convex_to);
        const Real turns = floor((edge - search.convex_from) / turn + Real(1e-6));
        const Real next_edge = fma(turns, turn, after);
        const Real landing_turns = floor((phase + search.above_to - search.convex_from) / turn);
        const Real jump_from = fma(landing_turns, turn, search.convex_from);
        const mask_of<Real> jumps = skipped & (jump_from > edge);
        now.from = select(jumps, jump_from - phase, now.to);
        const mask_of<Real> next_convex = jumps | !now.is_convex;
        edge = select(jumps, fma(landing_turns, turn, search.convex_to), next_edge);
        now.to = edge - phase;
        now.is_convex = next_convex;
        searching = searching & (now.from == now.from);
    }
    // all lanes together, once every one has its piece. Halley's method for gap / t, so that the
    // zero at launch is not met; stopped like Newton's, because next to a graze it is as slow
    const auto fallen = [&](const Real& t) {
        const gap_values<Real> gap = search.gap.at(t);
        const Real value = gap.value;
        const Real slope = fma(gap.rate, t, -value);                    // of gap / t, times t^2
        const Real bend = fma(gap.curvature * t, t, -(slope + slope));  // second one, times t^3
        const Real under = fma(-half * value, bend, slope * slope);
        return value_and_step<Real>{-value, value * t * slope / under};
    };
    return select(found, bracketed_root<Real>(fallen, within, begin, found), zero);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::paddle
