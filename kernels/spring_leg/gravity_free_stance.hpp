// Stance of a spring-mass runner with gravity neglected while the leg touches the ground: a central
// force, so that sweep angle and duration follow from the turning point. Closed form for the air
// spring, a quadrature without end-point singularity for the linear one. Source: models/slip.md
// section 4; Ghigliazza et al. 2005, (2.10), (2.14)-(2.20).
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/implicit_root.hpp"
#include "kernels/spring_leg/legendre_nodes.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// Touchdown with velocity 1 at angle alpha to a leg of length 1.
template <class Real>
struct impact_angle {
    Real sin, cos;
};

/// What the leg does until lift-off.
template <class Real>
struct sweep {
    Real angle;     // turned by the leg; forward positive
    Real duration;  // in leg lengths over touchdown speed
};

/// Air spring, potential ct / (2 r^2).
///
/// \param alpha      cos > 0
/// \param stiffness  ct = c / (m v^2 eta0^2) > 0
/// \error  a few ulp. r^2 = 1 - 2 C t + (1 + ct) t^2 along the motion, hence the duration.
template <class Real>
HOPSCOTCH_DEVICE inline sweep<Real> air_sweep(const impact_angle<Real>& alpha,
                                              const Real& stiffness) {
    const Real frequency = sqrt(fma(alpha.sin, alpha.sin, stiffness));
    const Real two(2.0);
    return {two * (alpha.sin / frequency) * atan2(alpha.cos, frequency),
            two * alpha.cos / (Real(1.0) + stiffness)};
}

/// Shortest leg: length x = 1 - z, both with full relative accuracy.
template <class Real>
struct turning_point {
    Real length;       // x
    Real compression;  // z
};

/// The turning point is the root of z (2 - z) + kt z^2 (1 - z)^2 = C^2, solved for the smaller of z
/// and x; in x it reads x^2 (1 - kt (1 - x)^2) = s^2.
///
/// \param wanted  lanes with sin != 0 or kt > 1 (elsewhere the leg collapses) and cos > 0
template <class Real>
HOPSCOTCH_DEVICE inline turning_point<Real> shortest_leg(const impact_angle<Real>& alpha,
                                                         const Real& stiffness,
                                                         const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const Real sine_square = alpha.sin * alpha.sin;
    const Real cosine_square = alpha.cos * alpha.cos;
    const plain zero(0.0);
    const plain half(0.5);
    const plain one(1.0);
    const plain two(2.0);
    const plain kt = primal(stiffness);
    const plain s2 = primal(sine_square);
    const plain c2 = primal(cosine_square);
    const mask_of<Real> deep =
        fma(kt, plain(0.0625), plain(0.75)) < c2;  // residual at z = 1/2 below 0
    const auto rising = [&](const plain& y) {
        const plain other = one - y;
        const plain product = y * other;
        const plain shallow = fma(kt * product, product, fma(y, two - y, -c2));
        const plain shallow_slope = two * fma(kt * product, other - y, other);
        const plain rest = fma(-kt * other, other, one);
        const plain low = fma(y * y, rest, -s2);
        const plain low_slope = two * y * fma(kt, product, rest);
        return value_and_slope<plain>{select(deep, low, shallow),
                                      select(deep, low_slope, shallow_slope)};
    };
    const plain shallow_guess = c2 / (one + sqrt(fma(kt, c2, s2)));
    const plain excess = larger(one - kt, zero) + sqrt(sqrt(s2));
    const plain deep_guess = larger(sqrt(s2 / excess), one - one / sqrt(kt));
    const plain root = bracketed_root<plain>(rising, {zero, half},
                                             select(deep, deep_guess, shallow_guess), wanted);

    const Real at(root);
    const Real other = Real(1.0) - at;
    const Real product = at * other;
    const Real residual =
        select(deep, fma(at * at, fma(-stiffness * other, other, Real(1.0)), -sine_square),
               fma(stiffness * product, product, fma(at, Real(2.0) - at, -cosine_square)));
    const Real exact = implicit_root(root, residual, rising(root).slope);
    const Real rest = Real(1.0) - exact;
    return {select(deep, exact, rest), select(deep, rest, exact)};
}

/// The integrands of sweep angle (without its factor sin alpha) and duration in the variable u,
/// leg length = shortest cosh(u), 0 <= u <= u_end = 2 asinh sqrt(z / (2 x)).
template <class Real>
struct linear_spring_integrand {
    Real length, compression, sine_square;
    Real strength;   // kt x^2
    Real grown_end;  // e^u - 1 at u_end

    HOPSCOTCH_DEVICE sweep<Real> at(const Real& u) const {
        const Real grown = expm1(u);
        const Real scale = Real(1.0) + grown;
        const Real scale_end = Real(1.0) + grown_end;
        const Real x = length * fma(grown, Real(0.5) * grown / scale, Real(1.0));
        // 1 - x = length (cosh u_end - cosh u) without cancellation
        const Real z = Real(0.5) * length * ((grown_end - grown) / scale) *
                       (fma(grown_end, grown, grown_end + grown) / scale_end);
        const Real stretch = strength * x * (x / (x + length)) * (z + compression);
        const Real weight = length / sqrt(sine_square + stretch);
        return {weight / x, weight * x};
    }
};

/// Sum of the integrand over a table of nodes.
template <int Size, class Real>
HOPSCOTCH_DEVICE inline sweep<Real> gauss_sum(const linear_spring_integrand<Real>& integrand,
                                              const Real& u_end,
                                              const legendre_node (&nodes)[Size]) {
    sweep<Real> sum{Real(0.0), Real(0.0)};
    for (int i = 0; i < Size; ++i) {
        const sweep<Real> value = integrand.at(u_end * Real(nodes[i].place));
        sum.angle = fma(Real(nodes[i].weight), value.angle, sum.angle);
        sum.duration = fma(Real(nodes[i].weight), value.duration, sum.duration);
    }
    return {sum.angle * u_end, sum.duration * u_end};
}

/// The same integrals by the tanh-sinh rule, halving its spacing until it has converged to the
/// arithmetic's rounding: for types that carry more digits than the table.
template <class Real>
HOPSCOTCH_DEVICE inline sweep<Real> exponential_sum(const linear_spring_integrand<Real>& integrand,
                                                    const Real& u_end) {
    using plain = primal_of<Real>;
    constexpr double span = lane_traits<Real>::rounding > 0x1p-110 ? 4.0 : 4.6;
    const auto term = [&](const plain& t) {
        const plain inner = exp(t);
        const plain outer = half_pi<plain>() * plain(0.5) * (inner - plain(1.0) / inner);
        const plain slope = half_pi<plain>() * plain(0.5) * (inner + plain(1.0) / inner);
        const plain both = cosh(outer);
        const sweep<Real> value = integrand.at(u_end * Real(sinh(outer) / both));
        const Real weight(slope / (both * both));
        return sweep<Real>{weight * value.angle, weight * value.duration};
    };
    double spacing = 0.125;
    sweep<Real> sum = term(plain(0.0));  // even in t: the half-line with half the middle term
    sum = {Real(0.5) * sum.angle, Real(0.5) * sum.duration};
    const auto add = [&](double first, double distance) {
        for (double t = first; t <= span; t += distance) {
            const sweep<Real> value = term(plain(t));
            sum = {sum.angle + value.angle, sum.duration + value.duration};
        }
    };
    add(spacing, spacing);
    sweep<Real> result{sum.angle * Real(spacing), sum.duration * Real(spacing)};
    mask_of<Real> active = primal(u_end) >= plain(0.0);
    const plain close(lane_traits<Real>::root_rounding * 0x1p-10);
    for (int level = 0; level < 9 && any(active); ++level) {
        add(0.5 * spacing, spacing);
        spacing *= 0.5;
        const sweep<Real> finer{sum.angle * Real(spacing), sum.duration * Real(spacing)};
        const plain change = primal(finer.angle) - primal(result.angle);
        const plain late = primal(finer.duration) - primal(result.duration);
        result = {select(active, finer.angle, result.angle),
                  select(active, finer.duration, result.duration)};
        active = active & !((abs(change) <= close * primal(result.angle)) &
                            (abs(late) <= close * primal(result.duration)));
    }
    return {result.angle * u_end, result.duration * u_end};
}

/// Linear spring, potential kt (1 - r)^2 / 2.
///
/// \param alpha      cos > 0
/// \param stiffness  kt = k eta0^2 / (m v^2) > 0
/// \param wanted     lanes with sin != 0 or kt > 1; the others collapse and get NaN
/// \error  in double about 1e-13 for x >= 0.05 and alpha above 1e-3, see tests/models/test_slip.cpp
template <class Real>
HOPSCOTCH_DEVICE inline sweep<Real> linear_sweep(const impact_angle<Real>& alpha,
                                                 const Real& stiffness,
                                                 const mask_of<Real>& wanted) {
    const turning_point<Real> turn = shortest_leg(alpha, stiffness, wanted);
    const Real two(2.0);
    const Real u_end = two * asinh(sqrt(turn.compression / (two * turn.length)));
    const linear_spring_integrand<Real> integrand{
        turn.length, turn.compression, alpha.sin * alpha.sin, stiffness * turn.length * turn.length,
        expm1(u_end)};
    sweep<Real> result;
    if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
        result = gauss_sum(integrand, u_end, legendre_16());
        const mask_of<Real> deep = wanted & (turn.length < Real(0.05));
        if (any(deep)) {
            const sweep<Real> finer = gauss_sum(integrand, u_end, legendre_32());
            result = {select_form(deep, finer.angle, result.angle),
                      select_form(deep, finer.duration, result.duration)};
        }
    } else {
        result = exponential_sum(integrand, u_end);
    }
    return {two * alpha.sin * result.angle, two * result.duration};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
