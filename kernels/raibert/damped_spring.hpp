// The damped linear spring of a stance, for any damping: displacement and velocity without
// cancellation at short times, and the time at which the motion turns. Used by the linear hoppers.
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/lanes/lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::raibert {

template <class Real>
struct moved_state {
    Real displacement, velocity;
};
template <class Real>
struct turning_time {
    mask_of<Real> exists;
    Real time;
};

/// Motion x'' = -2 a x' - pull - eta (x - x0) from x0, where `pull` is minus the spring's
/// acceleration at x0.
///
/// \tparam Oscillates  every lane is underdamped, a^2 < eta: the other cases are not compiled
template <bool Oscillates, class Real>
struct damped_spring {
    Real eta;        // > 0
    Real a;          // half of the friction, >= 0
    Real rate;       // W = sqrt |eta - a^2|
    Real slow_rate;  // overdamped: a - W, without cancellation
    mask_of<Real> oscillates;
    mask_of<Real> is_critical;

    HOPSCOTCH_DEVICE static damped_spring with(const Real& stiffness, const Real& half_friction) {
        const Real square = fma(-half_friction, half_friction, stiffness);
        const Real rate = sqrt(abs(square));
        return {stiffness,          half_friction,      rate, stiffness / (half_friction + rate),
                square > Real(0.0), square == Real(0.0)};
    }

    /// After the time t >= 0, from displacement 0 and velocity v.
    HOPSCOTCH_DEVICE moved_state<Real> after(const Real& t, const Real& pull, const Real& v) const {
        const auto is_short = t * (Real(2.0) * a + sqrt(eta)) <= Real(0.5);
        moved_state<Real> end = far(t, pull, v);
        if (any(is_short)) {
            const moved_state<Real> near = series(t, pull, v);
            end.displacement = select_form(is_short, near.displacement, end.displacement);
            end.velocity = select_form(is_short, near.velocity, end.velocity);
        }
        return end;
    }

    /// The next time > 0 at which the velocity is zero. \param v  its sign says where it comes
    /// from: with `rises` from above zero (v >= 0), else from below.
    HOPSCOTCH_DEVICE turning_time<Real> turn(const Real& pull, const Real& v, bool rises) const {
        const Real zero(0.0);
        const Real speed = rises ? v : -v;
        const Real against = rises ? fma(a, v, pull) : -fma(a, v, pull);
        const Real lateral = rate * speed;
        if constexpr (Oscillates) {
            return {speed >= zero, atan2(lateral, against) / rate};
        } else {
            const Real one(1.0);
            const mask_of<Real> decays = !oscillates & (against > lateral);
            const Real ratio = select(decays & !is_critical, lateral / against, zero);
            const Real divisor = select(is_critical, one, rate);
            Real time = select(oscillates, atan2(lateral, against), atanh(ratio)) / divisor;
            time = select(is_critical, speed / against, time);
            const mask_of<Real> exists = (speed >= zero) & (oscillates | decays);
            return {exists, time};
        }
    }

    /// Upper bound of the time an overdamped motion needs for slow exponentials to fall by e^-1.
    HOPSCOTCH_DEVICE Real slow_time() const { return Real(1.0) / slow_rate; }

private:
    HOPSCOTCH_DEVICE moved_state<Real> far(const Real& t, const Real& pull, const Real& v) const {
        const Real one(1.0);
        const auto circle = sin_cos(rate * t);
        const Real shrink = exp(-(a * t));
        Real even = shrink * circle.cos;
        Real odd = shrink * circle.sin / rate;
        if constexpr (!Oscillates) {
            const Real slow = exp(-(slow_rate * t));
            const Real difference = -expm1(Real(-2.0) * rate * t);  // 1 - exp(-2 W t)
            const Real half_slow = Real(0.5) * slow;
            const Real odd_over = select(is_critical, slow * t, half_slow * difference / rate);
            even = select(oscillates, even, half_slow * (Real(2.0) - difference));
            odd = select(oscillates, odd, odd_over);
        }
        const Real offset = pull / eta;  // from the equilibrium
        return {fma(offset, even - one, fma(a, offset, v) * odd),
                fma(v, even, -(fma(a, v, pull) * odd))};
    }

    /// Taylor's series of the velocity by q_{n+2} = -2 a t q_{n+1} / (n + 2) - eta t^2 q_n / ((n +
    /// 1)(n + 2)).
    HOPSCOTCH_DEVICE moved_state<Real> series(const Real& t, const Real& pull,
                                              const Real& v) const {
        constexpr int terms = lane_traits<Real>::rounding > 0x1p-60    ? 16
                              : lane_traits<Real>::rounding > 0x1p-110 ? 27
                                                                       : 44;
        const Real friction = Real(-2.0) * a * t;
        const Real stiffness = -(eta * t * t);
        Real before = v;
        Real now = t * fma(Real(-2.0) * a, v, -pull);
        Real velocity = before + now;
        Real displacement = fma(now, Real(0.5), before);
        for (int n = 0; n < terms; ++n) {
            const Real second(n + 2.0);
            const Real next =
                friction * now / second + stiffness * before / Real((n + 1.0) * (n + 2.0));
            velocity = velocity + next;
            displacement = displacement + next / Real(n + 3.0);
            before = now;
            now = next;
        }
        return {t * displacement, velocity};
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::raibert
