// Stance of the pitching spring-mass runner, one Taylor step at a time: hip about the foothold,
// velocity of the centre, pitch and its sine and cosine, and a function of the leg's length, so
// that the right-hand side is polynomial. Units: leg length, gravity 1. Source: models/slip.md
// section 6; Ghigliazza et al. 2005, (2.1)-(2.5).
#pragma once

#include "kernels/integrators/first_zero.hpp"
#include "kernels/integrators/taylor.hpp"
#include "kernels/spring_leg/pitching_lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// The motion over one step as polynomials in s.
template <class Real>
struct pitching_series {
    taylor::series<Real> x, y, x_rate, y_rate, turn, turn_rate, cos, sin;
    taylor::series<Real> length;  // eta (linear spring) or 1 / eta^2 (air spring)
    taylor::series<Real> time;    // elapsed since the step's beginning
};

/// The present state as the coefficients of s^0.
template <class Real>
HOPSCOTCH_DEVICE inline void begin_step(pitching_series<Real>& a,
                                        const pitching_runner<Real>& lane) {
    const auto turned = sin_cos(lane.turn);
    a.x.c[0] = lane.x;
    a.y.c[0] = lane.y;
    a.x_rate.c[0] = lane.x_rate;
    a.y_rate.c[0] = lane.y_rate;
    a.turn.c[0] = lane.turn;
    a.turn_rate.c[0] = lane.turn_rate;
    a.cos.c[0] = turned.cos;
    a.sin.c[0] = turned.sin;
    a.length.c[0] = lane.length;
    a.time.c[0] = Real(0.0);
}

/// Linear spring in the time s with dt = eta ds, so that a pass close to the foothold takes no
/// shorter steps. With the hip's velocity (U, V) = (u - d theta' cos, w - d theta' sin) and g = 1 -
/// eta: x' = eta U, y' = eta V, eta' = x U + y V, u' = k g x, w' = k g y - eta, theta' = eta omega,
/// omega' = -(d / I) k g (x cos + y sin).
template <class Real>
HOPSCOTCH_DEVICE inline void expand_linear(pitching_series<Real>& a,
                                           const pitching_runner<Real>& lane) {
    using taylor::over;
    taylor::series<Real> hip_x, hip_y, pull_x, pull_y, turns, slack;
    const Real torque_scale = -(lane.hip / lane.inertia) * lane.stiffness;
    slack.c[0] = Real(1.0) - a.length.c[0];
    for (int n = 0; n < taylor::order<Real>; ++n) {
        const int m = n + 1;
        Real swing_x = a.turn_rate.c[0] * a.cos.c[n];
        Real swing_y = a.turn_rate.c[0] * a.sin.c[n];
        Real forward = slack.c[0] * a.x.c[n];
        Real upward = slack.c[0] * a.y.c[n];
        Real turned = a.length.c[0] * a.turn_rate.c[n];
        for (int i = 1; i <= n; ++i) {
            swing_x = fma(a.turn_rate.c[i], a.cos.c[n - i], swing_x);
            swing_y = fma(a.turn_rate.c[i], a.sin.c[n - i], swing_y);
            forward = fma(slack.c[i], a.x.c[n - i], forward);
            upward = fma(slack.c[i], a.y.c[n - i], upward);
            turned = fma(a.length.c[i], a.turn_rate.c[n - i], turned);
        }
        hip_x.c[n] = fma(-lane.hip, swing_x, a.x_rate.c[n]);
        hip_y.c[n] = fma(-lane.hip, swing_y, a.y_rate.c[n]);
        pull_x.c[n] = forward;
        pull_y.c[n] = upward;
        turns.c[n] = turned;
        Real outward = a.x.c[0] * hip_x.c[n];
        Real outward_y = a.y.c[0] * hip_y.c[n];
        Real drift_x = a.length.c[0] * hip_x.c[n];
        Real drift_y = a.length.c[0] * hip_y.c[n];
        Real torque_x = pull_x.c[0] * a.cos.c[n];
        Real torque_y = pull_y.c[0] * a.sin.c[n];
        Real sine_falls = a.sin.c[0] * turns.c[n];
        Real sine_grows = a.cos.c[0] * turns.c[n];
        for (int i = 1; i <= n; ++i) {
            outward = fma(a.x.c[i], hip_x.c[n - i], outward);
            outward_y = fma(a.y.c[i], hip_y.c[n - i], outward_y);
            drift_x = fma(a.length.c[i], hip_x.c[n - i], drift_x);
            drift_y = fma(a.length.c[i], hip_y.c[n - i], drift_y);
            torque_x = fma(pull_x.c[i], a.cos.c[n - i], torque_x);
            torque_y = fma(pull_y.c[i], a.sin.c[n - i], torque_y);
            sine_falls = fma(a.sin.c[i], turns.c[n - i], sine_falls);
            sine_grows = fma(a.cos.c[i], turns.c[n - i], sine_grows);
        }
        a.x.c[m] = over(drift_x, m);
        a.y.c[m] = over(drift_y, m);
        a.x_rate.c[m] = over(lane.stiffness * pull_x.c[n], m);
        a.y_rate.c[m] = over(fma(lane.stiffness, pull_y.c[n], -a.length.c[n]), m);
        a.turn.c[m] = over(turns.c[n], m);
        a.turn_rate.c[m] = over(torque_scale * (torque_x + torque_y), m);
        a.cos.c[m] = over(-sine_falls, m);
        a.sin.c[m] = over(sine_grows, m);
        a.length.c[m] = over(outward + outward_y, m);
        slack.c[m] = -a.length.c[m];
        a.time.c[m] = over(a.length.c[n], m);
    }
}

/// Air spring in physical time with q = 1 / eta^2: x' = U, y' = V, u' = c q^2 x, w' = c q^2 y - 1,
/// q' = -2 q^2 (x U + y V), omega' = -(d / I) c q^2 (x cos + y sin).
template <class Real>
HOPSCOTCH_DEVICE inline void expand_air(pitching_series<Real>& a,
                                        const pitching_runner<Real>& lane) {
    using taylor::over;
    taylor::series<Real> hip_x, hip_y, pull_x, pull_y, quartic, outward;
    const Real torque_scale = -(lane.hip / lane.inertia) * lane.stiffness;
    for (int n = 0; n < taylor::order<Real>; ++n) {
        const int m = n + 1;
        quartic.c[n] = taylor::square(a.length, n);
        Real swing_x = a.turn_rate.c[0] * a.cos.c[n];
        Real swing_y = a.turn_rate.c[0] * a.sin.c[n];
        Real forward = quartic.c[0] * a.x.c[n];
        Real upward = quartic.c[0] * a.y.c[n];
        for (int i = 1; i <= n; ++i) {
            swing_x = fma(a.turn_rate.c[i], a.cos.c[n - i], swing_x);
            swing_y = fma(a.turn_rate.c[i], a.sin.c[n - i], swing_y);
            forward = fma(quartic.c[i], a.x.c[n - i], forward);
            upward = fma(quartic.c[i], a.y.c[n - i], upward);
        }
        hip_x.c[n] = fma(-lane.hip, swing_x, a.x_rate.c[n]);
        hip_y.c[n] = fma(-lane.hip, swing_y, a.y_rate.c[n]);
        pull_x.c[n] = forward;
        pull_y.c[n] = upward;
        Real outward_x = a.x.c[0] * hip_x.c[n];
        Real outward_y = a.y.c[0] * hip_y.c[n];
        Real torque_x = pull_x.c[0] * a.cos.c[n];
        Real torque_y = pull_y.c[0] * a.sin.c[n];
        for (int i = 1; i <= n; ++i) {
            outward_x = fma(a.x.c[i], hip_x.c[n - i], outward_x);
            outward_y = fma(a.y.c[i], hip_y.c[n - i], outward_y);
            torque_x = fma(pull_x.c[i], a.cos.c[n - i], torque_x);
            torque_y = fma(pull_y.c[i], a.sin.c[n - i], torque_y);
        }
        outward.c[n] = outward_x + outward_y;
        const Real stretch = taylor::product(quartic, outward, n);
        const Real lift = lane.stiffness * pull_y.c[n];
        a.x.c[m] = over(hip_x.c[n], m);
        a.y.c[m] = over(hip_y.c[n], m);
        a.x_rate.c[m] = over(lane.stiffness * pull_x.c[n], m);
        a.y_rate.c[m] = over(n == 0 ? lift - Real(1.0) : lift, m);
        a.turn.c[m] = over(a.turn_rate.c[n], m);
        a.turn_rate.c[m] = over(torque_scale * (torque_x + torque_y), m);
        a.cos.c[m] = over(-swing_y, m);
        a.sin.c[m] = over(swing_x, m);
        a.length.c[m] = over(Real(-2.0) * stretch, m);
        a.time.c[m] = n == 0 ? Real(1.0) : Real(0.0);
    }
}

/// Where a step of stance came to.
template <class Real>
struct pitching_step {
    mask_of<Real> lifts, grounds, unresolved, broken;
    Real length_of_step;  // in s
};

/// The longest step of that tolerance.
template <class Real>
HOPSCOTCH_DEVICE inline primal_of<Real> longest_step(const pitching_series<Real>& a,
                                                     const Real& tolerance) {
    using plain = primal_of<Real>;
    taylor::step_length<Real> size;
    size.watch(a.x);
    size.watch(a.y);
    size.watch(a.x_rate);
    size.watch(a.y_rate);
    size.watch(a.turn);
    size.watch(a.turn_rate);
    size.watch(a.cos, 1.0);
    size.watch(a.sin, 1.0);
    size.watch(a.length);
    return size.length(primal(tolerance), plain(8.0));
}

/// One step: up to its full length, or to the first of lift-off and ground (of hip or centre).
///
/// \param a         expanded
/// \param lane      its hip, tolerance, and whether the lift-off guard is zero because stance
/// begins here \param closing   rate at which the leg shortens there, > 0
template <bool IsAir, class Real>
HOPSCOTCH_DEVICE inline pitching_step<Real> advance(const pitching_series<Real>& a,
                                                    const pitching_runner<Real>& lane,
                                                    const Real& closing,
                                                    const mask_of<Real>& active) {
    using plain = primal_of<Real>;
    const Real& untouched = lane.untouched;
    const plain horizon = longest_step(a, lane.tolerance);
    taylor::series<Real> guard;   // positive while the leg is compressed
    taylor::series<Real> centre;  // height of the body
    for (int n = 0; n <= taylor::order<Real>; ++n) {
        guard.c[n] = IsAir ? a.length.c[n] : -a.length.c[n];
        centre.c[n] = fma(-lane.hip, a.cos.c[n], a.y.c[n]);
    }
    guard.c[0] = IsAir ? a.length.c[0] - Real(1.0) : Real(1.0) - a.length.c[0];
    taylor::divide_out_zeros(guard, untouched);
    guard.c[0] = select(untouched > Real(0.0), IsAir ? closing + closing : closing, guard.c[0]);
    const auto off = taylor::first_zero(guard, horizon, active);
    const auto hip_down = taylor::first_zero(a.y, horizon, active);
    const auto body_down = taylor::first_zero(centre, horizon, active);
    const mask_of<Real> body_first =
        body_down.found & !(hip_down.found & (hip_down.time < body_down.time));
    const mask_of<Real> is_down = hip_down.found | body_down.found;
    const Real down = select(body_first, body_down.time, hip_down.time);
    const mask_of<Real> grounds = is_down & !(off.found & (off.time < down));
    const mask_of<Real> lifts = off.found & !grounds;
    const mask_of<Real> broken = active & !(horizon >= plain(0.0));
    const mask_of<Real> unresolved = off.unresolved | hip_down.unresolved | body_down.unresolved;
    return {lifts, grounds, unresolved, broken,
            select(lifts, off.time, select(grounds, down, Real(horizon)))};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
