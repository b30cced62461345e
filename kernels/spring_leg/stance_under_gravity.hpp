// Stance of a spring-mass runner under gravity, one Taylor step at a time. Units: leg length and
// touchdown speed. Coordinates about the foothold, the body's velocity, and a function of the leg's
// length that makes the right-hand side polynomial. Source: models/slip.md sections 2, 5, 10;
// Ghigliazza et al. 2005, (2.6).
#pragma once

#include "kernels/integrators/first_zero.hpp"
#include "kernels/integrators/taylor.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// The motion over one step as polynomials in s.
template <class Real>
struct stance_series {
    taylor::series<Real> x, y, x_rate, y_rate;
    taylor::series<Real> length;  // r (linear spring) or 1 / r^2 (air spring)
    taylor::series<Real> guard;   // positive while the leg is compressed
    taylor::series<Real> time;    // elapsed since the step's beginning
};

/// Coefficient n of x u, r u and (1 - r) x, and of the same in the other coordinate.
template <class Real>
struct leg_products {
    Real outward, drift_x, drift_y, pull_x, pull_y;
};

/// The pairs i, n - i of six Cauchy products together: independent chains hide the latency of the
/// fused operations, and every coefficient of a pair serves four of them.
template <class Real>
HOPSCOTCH_DEVICE inline leg_products<Real> products_of(const stance_series<Real>& a, int n) {
    const Real x0 = a.x.c[0];
    const Real y0 = a.y.c[0];
    const Real u0 = a.x_rate.c[0];
    const Real w0 = a.y_rate.c[0];
    const Real r0 = a.length.c[0];
    const Real compression = a.guard.c[0];
    if (n == 0) return {fma(x0, u0, y0 * w0), r0 * u0, r0 * w0, compression * x0, compression * y0};
    Real along_x = fma(a.x.c[n], u0, x0 * a.x_rate.c[n]);
    Real along_y = fma(a.y.c[n], w0, y0 * a.y_rate.c[n]);
    Real drift_x = fma(a.length.c[n], u0, r0 * a.x_rate.c[n]);
    Real drift_y = fma(a.length.c[n], w0, r0 * a.y_rate.c[n]);
    Real stretch_x = a.length.c[n] * x0;  // of (r - r_0) x
    Real stretch_y = a.length.c[n] * y0;
    int i = 1;
    int j = n - 1;
    for (; i < j; ++i, --j) {
        const Real xi = a.x.c[i];
        const Real xj = a.x.c[j];
        const Real yi = a.y.c[i];
        const Real yj = a.y.c[j];
        const Real ui = a.x_rate.c[i];
        const Real uj = a.x_rate.c[j];
        const Real wi = a.y_rate.c[i];
        const Real wj = a.y_rate.c[j];
        const Real ri = a.length.c[i];
        const Real rj = a.length.c[j];
        along_x = fma(xj, ui, fma(xi, uj, along_x));
        along_y = fma(yj, wi, fma(yi, wj, along_y));
        drift_x = fma(rj, ui, fma(ri, uj, drift_x));
        drift_y = fma(rj, wi, fma(ri, wj, drift_y));
        stretch_x = fma(rj, xi, fma(ri, xj, stretch_x));
        stretch_y = fma(rj, yi, fma(ri, yj, stretch_y));
    }
    if (i == j) {
        const Real ri = a.length.c[i];
        along_x = fma(a.x.c[i], a.x_rate.c[i], along_x);
        along_y = fma(a.y.c[i], a.y_rate.c[i], along_y);
        drift_x = fma(ri, a.x_rate.c[i], drift_x);
        drift_y = fma(ri, a.y_rate.c[i], drift_y);
        stretch_x = fma(ri, a.x.c[i], stretch_x);
        stretch_y = fma(ri, a.y.c[i], stretch_y);
    }
    return {along_x + along_y, drift_x, drift_y, fma(compression, a.x.c[n], -stretch_x),
            fma(compression, a.y.c[n], -stretch_y)};
}

/// Linear spring in the time s with dt = r ds: x' = r u, u' = kt (1 - r) x, w' = kt (1 - r) y - gt
/// r, r' = x u + y w. A pass close to the foothold (r -> 0) takes no shorter steps in s.
template <class Real>
HOPSCOTCH_DEVICE inline void expand_linear(stance_series<Real>& a, const Real& stiffness,
                                           const Real& gravity) {
    using taylor::over;
    a.time.c[0] = Real(0.0);
    a.guard.c[0] = Real(1.0) - a.length.c[0];
    for (int n = 0; n < taylor::order<Real>; ++n) {
        const int m = n + 1;
        const leg_products<Real> sum = products_of(a, n);
        a.x.c[m] = over(sum.drift_x, m);
        a.y.c[m] = over(sum.drift_y, m);
        a.x_rate.c[m] = over(stiffness * sum.pull_x, m);
        a.y_rate.c[m] = over(fma(stiffness, sum.pull_y, -(gravity * a.length.c[n])), m);
        a.length.c[m] = over(sum.outward, m);
        a.guard.c[m] = -a.length.c[m];
        a.time.c[m] = over(a.length.c[n], m);
    }
}

/// Air spring in physical time with q = 1 / r^2: u' = ct q^2 x, w' = ct q^2 y - gt,
/// q' = -2 q^2 (x u + y w).
template <class Real>
HOPSCOTCH_DEVICE inline void expand_air(stance_series<Real>& a, const Real& stiffness,
                                        const Real& gravity) {
    using taylor::over;
    taylor::series<Real> quartic;  // q^2
    taylor::series<Real> outward;  // x u + y w
    a.time.c[0] = Real(0.0);
    a.guard.c[0] = a.length.c[0] - Real(1.0);
    for (int n = 0; n < taylor::order<Real>; ++n) {
        const int m = n + 1;
        quartic.c[n] = taylor::square(a.length, n);
        Real forward = a.x.c[0] * a.x_rate.c[n];
        Real upward = a.y.c[0] * a.y_rate.c[n];
        for (int i = 1; i <= n; ++i) {
            forward = fma(a.x.c[i], a.x_rate.c[n - i], forward);
            upward = fma(a.y.c[i], a.y_rate.c[n - i], upward);
        }
        outward.c[n] = forward + upward;
        Real pull_x = quartic.c[0] * a.x.c[n];
        Real pull_y = quartic.c[0] * a.y.c[n];
        Real stretch = quartic.c[0] * outward.c[n];
        for (int i = 1; i <= n; ++i) {
            pull_x = fma(quartic.c[i], a.x.c[n - i], pull_x);
            pull_y = fma(quartic.c[i], a.y.c[n - i], pull_y);
            stretch = fma(quartic.c[i], outward.c[n - i], stretch);
        }
        pull_y = stiffness * pull_y;
        a.x.c[m] = over(a.x_rate.c[n], m);
        a.y.c[m] = over(a.y_rate.c[n], m);
        a.x_rate.c[m] = over(stiffness * pull_x, m);
        a.y_rate.c[m] = over(n == 0 ? pull_y - gravity : pull_y, m);
        a.length.c[m] = over(Real(-2.0) * stretch, m);
        a.guard.c[m] = a.length.c[m];
        a.time.c[m] = n == 0 ? Real(1.0) : Real(0.0);
    }
}

/// Where a step of stance came to.
template <class Real>
struct stance_step {
    mask_of<Real> lifts, grounds, unresolved, broken;
    Real length_of_step;  // in s
};

/// One step: up to its full length, or to the first of lift-off and ground.
///
/// \param a         expanded
/// \param untouched lanes whose lift-off guard is zero at the start because stance begins here
/// \param closing   rate of the guard there, > 0
/// \param tolerance of the step
template <class Real>
HOPSCOTCH_DEVICE inline stance_step<Real> advance(const stance_series<Real>& a,
                                                  const Real& untouched, const Real& closing,
                                                  const Real& tolerance,
                                                  const mask_of<Real>& active) {
    using plain = primal_of<Real>;
    taylor::step_length<Real> size;
    size.watch(a.x);
    size.watch(a.y);
    size.watch(a.x_rate);
    size.watch(a.y_rate);
    size.watch(a.length);
    const plain horizon = size.length(primal(tolerance), plain(8.0));
    taylor::series<Real> guard;
    guard = a.guard;
    taylor::divide_out_zeros(guard, untouched);
    guard.c[0] = select(untouched > Real(0.0), closing, guard.c[0]);
    const auto off = taylor::first_zero(guard, horizon, active);
    const auto down = taylor::first_zero(a.y, horizon, active);
    const mask_of<Real> grounds = down.found & !(off.found & (off.time < down.time));
    const mask_of<Real> lifts = off.found & !grounds;
    const mask_of<Real> broken = active & !(horizon >= plain(0.0));
    const mask_of<Real> unresolved = (off.unresolved & !grounds) | (down.unresolved & !lifts);
    return {lifts, grounds, unresolved, broken,
            select(lifts, off.time, select(grounds, down.time, Real(horizon)))};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
