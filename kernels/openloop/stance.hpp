// Stance of the clock-driven hopper: a damped oscillator about a resting point, in closed form for
// every damping, and the guaranteed first upward crossing of its solutions. Scaled units (page,
// section 1): y'' + 2 zeta y' + y = resting. Source: models/openloop_hopper.md sections 2 and 3.1.
#pragma once

#include "kernels/elementary/arctangent.hpp"
#include "kernels/elementary/constants.hpp"
#include "kernels/elementary/exponential.hpp"
#include "kernels/elementary/hyperbolic.hpp"
#include "kernels/elementary/sin_cos.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/implicit_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::openloop {

/// The oscillator's responses to a unit step and to a unit impulse (the derivative of the first).
template <class Real>
struct response {
    Real step;     // 1 - EC - zeta ES, about s^2 / 2
    Real impulse;  // ES, about s
};

/// The oscillator itself. AnyDamping = false leaves out zeta >= 1.
template <bool AnyDamping, class Real>
struct oscillator {
    Real damping;    // zeta
    Real frequency;  // sqrt |1 - zeta^2|, at least 1e-100 so that zeta = 1 needs no case of its own
    Real decay;  // of the slower exponential: zeta, or 1 / (zeta + sqrt(zeta^2 - 1)) from zeta = 1

    HOPSCOTCH_DEVICE static oscillator with(const Real& zeta) {
        const Real one(1.0);
        const Real size = sqrt(abs((one - zeta) * (one + zeta)));
        const Real frequency = select(size > Real(1e-100), size, Real(1e-100));
        if constexpr (AnyDamping) {
            return {zeta, frequency, select(zeta < one, zeta, one / (zeta + frequency))};
        } else {
            return {zeta, frequency, zeta};
        }
    }

    HOPSCOTCH_DEVICE response<Real> at(const Real& s) const {
        const Real one(1.0);
        const auto angle = sin_cos(frequency * s);
        const Real scale = exp(-(decay * s));
        Real even = scale * angle.cos;
        Real impulse = scale * angle.sin / frequency;
        if constexpr (AnyDamping) {
            const mask_of<Real> creeps = damping >= one;
            const Real lost = expm1(-(Real(2.0) * frequency * s));
            even = select(creeps, scale * fma(lost, Real(0.5), one), even);
            impulse = select(creeps, -(scale * lost) / (Real(2.0) * frequency), impulse);
        }
        response<Real> result{one - fma(damping, impulse, even), impulse};
        const Real reach = abs(s) * fma(Real(2.0), damping, one);
        const mask_of<Real> is_short = reach < Real(0.0625);
        if (any(is_short)) {  // the step response cancels: huge thrust for a tiny time needs its
                              // digits
            const response<Real> series = series_at(s);
            result.step = select_form(is_short, series.step, result.step);
            result.impulse = select_form(is_short, series.impulse, result.impulse);
        }
        return result;
    }

    /// 1 / n, to half an ulp also where double is too short for it.
    HOPSCOTCH_DEVICE static Real reciprocal(int n) {
        if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
            return Real(1.0 / static_cast<double>(n));
        } else {
            return Real(1.0) / Real(static_cast<double>(n));
        }
    }

    /// Taylor series for |s| (1 + 2 zeta) <= 1/16.
    HOPSCOTCH_DEVICE response<Real> series_at(const Real& s) const {
        constexpr int terms = lane_traits<Real>::rounding > 0x1p-60    ? 12
                              : lane_traits<Real>::rounding > 0x1p-110 ? 20
                                                                       : 36;
        Real before(0.0);  // n-th and (n+1)-th derivatives of the impulse response at 0
        Real current(1.0);
        Real power = s;  // s^n / n!
        Real step(0.0);
        Real impulse(0.0);
        for (int n = 1; n < terms; ++n) {
            impulse = fma(current, power, impulse);
            power = power * s * reciprocal(n + 1);
            step = fma(current, power, step);
            const Real next = -fma(Real(2.0) * damping, current, before);
            before = current;
            current = next;
        }
        return {step, impulse};
    }
};

/// A solution of the oscillator, from its initial values. `value` changes by increments, so that
/// small times keep their digits whatever the distance to the resting point.
template <bool AnyDamping, class Real>
struct solution {
    oscillator<AnyDamping, Real> spring;
    Real value;
    Real rate;
    Real resting;

    HOPSCOTCH_DEVICE Real distance() const { return value - resting; }
    HOPSCOTCH_DEVICE Real acceleration() const {
        return -fma(Real(2.0) * spring.damping, rate, distance());
    }
    HOPSCOTCH_DEVICE value_and_slope<Real> at(const Real& s) const {
        const response<Real> r = spring.at(s);
        return {value + fma(rate, r.impulse, -(distance() * r.step)),
                fma(-rate, r.step, rate) + acceleration() * r.impulse};
    }
};

template <bool AnyDamping, class Real>
HOPSCOTCH_DEVICE inline solution<AnyDamping, primal_of<Real>> primal_of_solution(
    const solution<AnyDamping, Real>& x) {
    return {{primal(x.spring.damping), primal(x.spring.frequency), primal(x.spring.decay)},
            primal(x.value),
            primal(x.rate),
            primal(x.resting)};
}

/// First time > 0 at which the rate vanishes; +infinity where it never does.
template <bool AnyDamping, class Real>
HOPSCOTCH_DEVICE inline Real first_turning_time(const solution<AnyDamping, Real>& x) {
    const Real zero(0.0);
    const Real frequency = x.spring.frequency;
    const Real slip = frequency * x.rate;
    const Real pull = fma(x.spring.damping, x.rate, x.distance());
    // a falling body turns half a turn after its phase, which is that of the opposite point
    const Real phase = atan2(abs(slip), select(slip < zero, -pull, pull));
    const Real turn = select((phase > zero) & !(slip == zero), phase, pi<Real>());
    Real time = turn / frequency;
    if constexpr (AnyDamping) {
        const Real ratio = slip / pull;
        const mask_of<Real> turns = (ratio > zero) & (ratio < Real(1.0));
        const Real creeping =
            select(turns, atanh(select(turns, ratio, zero)) / frequency, infinity<Real>());
        time = select(x.spring.damping < Real(1.0), time, creeping);
    }
    return time;
}

template <class Real>
struct crossing {
    mask_of<Real> found;
    Real time;
};

/// First time in (0, horizon] at which the solution rises through zero.
///
/// \param x        value <= 0 at time 0
/// \param horizon  time up to which the flow holds
/// \param wanted   lanes to search
/// \return         found and the time, lane-wise; touching zero from below is no crossing
/// \error          none; a non-finite solution gives found = false
/// Either the resting point is below zero, then maxima decrease and only the first can cross; or it
/// is above, then the first maximum crosses. So one monotone piece decides, without any scan
/// (page, 3.1).
template <bool AnyDamping, class Real>
HOPSCOTCH_DEVICE inline crossing<Real> first_rise(const solution<AnyDamping, Real>& x,
                                                  const primal_of<Real>& horizon,
                                                  const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const plain zero(0.0);
    const auto value = primal_of_solution(x);
    const plain turning = first_turning_time(value);
    const mask_of<Real> sinks =
        (value.rate < zero) | ((value.rate == zero) & (value.acceleration() <= zero));
    plain half_turn = pi<plain>() / value.spring.frequency;
    if constexpr (AnyDamping) {
        half_turn = select(value.spring.damping < plain(1.0), half_turn, infinity<plain>());
    }
    const plain low = select(sinks, turning, zero);
    const plain high = smaller(select(sinks, turning + half_turn, turning), horizon);
    // Halley's method: the oscillator's equation gives the second derivative for nothing. Stopped
    // like Newton's, because next to a graze it is as slow.
    const auto acceleration = [&](const value_and_slope<plain>& there) {
        return -fma(plain(2.0) * value.spring.damping, there.slope, there.value - value.resting);
    };
    const auto rising = [&](const plain& s) {
        const value_and_slope<plain> there = value.at(s);
        const plain slope = there.slope;
        const plain under = fma(plain(-0.5) * there.value, acceleration(there), slope * slope);
        return value_and_step<plain>{there.value, there.value * slope / under};
    };
    const value_and_slope<plain> end = value.at(high);
    const mask_of<Real> found = wanted & (low < horizon) & (end.value > zero);
    plain time = high;
    if (any(found)) {
        // back from the end: the parabola there, and what a damped cosine adds to it
        const plain bend = plain(-2.0) * acceleration(end) * end.value;
        const plain rise = select(end.slope > zero, end.slope, zero);
        const plain back = (end.value + end.value) / (rise + sqrt(fma(rise, rise, bend)));
        const plain longer =
            fma(back, fma(back, plain(1.0 / 24.0), value.spring.damping * plain(-1.0 / 3.0)),
                plain(1.0));
        plain guess = high - back * longer;
        time = bracketed_root<plain>(rising, {low, high}, guess, found);
    }
    if constexpr (without_derivatives<Real>) {
        return {found, time};
    } else {
        return {found, implicit_root(time, x.at(Real(time)).value, value.at(time).slope)};
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::openloop
