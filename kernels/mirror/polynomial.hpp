// The real roots of a polynomial on an interval, found through its derivatives: between
// neighbouring roots of the derivative a polynomial is monotone, so signs decide and no root is
// missed. Used to split a mirror law's contact function into monotone pieces. Source:
// models/mirror_juggler.md, sections 4 and 5.
#pragma once

#include "kernels/events/bracketed_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::mirror {

/// Points of an interval, in order.
template <int N, class Real>
struct break_points {
    Real at[N];
};

/// c[0] + c[1] t + ... and its derivative.
template <int Degree, class Real>
HOPSCOTCH_DEVICE inline value_and_slope<Real> evaluate(const Real (&c)[Degree + 1], const Real& t) {
    Real value = c[Degree];
    Real slope(0.0);
    for (int i = Degree - 1; i >= 0; --i) {
        slope = fma(slope, t, value);
        value = fma(value, t, c[i]);
    }
    return {value, slope};
}

/// Points in [0, to] that contain every sign change of the polynomial there; those that are no
/// roots are harmless extra points.
///
/// \param c       coefficients, lowest first; leading ones may vanish
/// \param to      end of the interval, finite
/// \param wanted  lanes to solve
/// \error         none; idle lanes give nonsense in finite time
template <int Degree, class Real>
HOPSCOTCH_DEVICE inline break_points<Degree, Real> sign_changes(const Real (&c)[Degree + 1],
                                                                const Real& to,
                                                                const mask_of<Real>& wanted) {
    const Real zero(0.0);
    break_points<Degree, Real> result;
    if constexpr (Degree == 1) {
        const Real root = -(c[0] / c[1]);
        const mask_of<Real> inside = (root > zero) & (root < to);
        result.at[0] = select(inside, root, to);
    } else {
        Real derivative[Degree];
        for (int i = 0; i < Degree; ++i) derivative[i] = c[i + 1] * Real(i + 1);
        const auto turning = sign_changes<Degree - 1>(derivative, to, wanted);
        Real from = zero;
        Real at_from = c[0];
#pragma GCC unroll 1
        for (int i = 0; i < Degree; ++i) {
            const Real end = i + 1 < Degree ? turning.at[i < Degree - 1 ? i : 0] : to;
            const Real at_end = evaluate<Degree>(c, end).value;
            const mask_of<Real> rises = at_end > zero;
            const mask_of<Real> changes =
                wanted & (((at_from < zero) & rises) | ((at_from > zero) & (at_end < zero)));
            Real root = end;
            if (any(changes)) {
                const auto rising = [&](const Real& t) {
                    const auto p = evaluate<Degree>(c, t);
                    return value_and_slope<Real>{negate_where(!rises, p.value),
                                                 negate_where(!rises, p.slope)};
                };
                const Real found =
                    bracketed_root<Real>(rising, {from, end}, (from + end) * Real(0.5), changes);
                root = select(changes, found, end);
            }
            result.at[i] = root;
            from = end;
            at_from = at_end;
        }
    }
    return result;
}

template <class Real>
struct first_fall {
    mask_of<Real> found;
    Real time;
};

/// First time in (0, to] at which a function that is positive at 0 falls through zero, given points
/// between which it is monotone.
///
/// \param falling  t -> value_and_slope
template <int N, class Real, class Function>
HOPSCOTCH_DEVICE inline first_fall<Real> first_fall_between(Function&& falling,
                                                            const break_points<N, Real>& points,
                                                            const Real& to,
                                                            const mask_of<Real>& wanted) {
    const Real zero(0.0);
    Real low = zero;
    Real high = to;
    mask_of<Real> searching = wanted;
#pragma GCC unroll 1
    for (int i = 0; i <= N; ++i) {
        const Real end = i < N ? points.at[i < N ? i : 0] : to;
        const mask_of<Real> down = falling(end).value <= zero;
        high = select(searching & down, end, high);
        low = select(searching & !down, end, low);
        searching = searching & !down;
    }
    const mask_of<Real> found = wanted & !searching;
    const auto rising = [&](const Real& t) {
        const value_and_slope<Real> f = falling(t);
        return value_and_slope<Real>{-f.value, -f.slope};
    };
    const Real time = bracketed_root<Real>(rising, {low, high}, (low + high) * Real(0.5), found);
    return {found, time};
}

/// The same, given a polynomial whose sign changes split the function into monotone pieces.
///
/// \param bends  lanes that need the split; the others fall monotonically
template <int Degree, class Real, class Function>
HOPSCOTCH_DEVICE inline first_fall<Real> first_fall_of(Function&& falling,
                                                       const Real (&polynomial)[Degree + 1],
                                                       const Real& to, const mask_of<Real>& bends,
                                                       const mask_of<Real>& wanted) {
    // over a whole set of starts pieces come and go; such an arithmetic isolates the fall itself
    if constexpr (requires { bracket_of_first_fall(falling, to, wanted); }) {
        const bracket<Real> within = bracket_of_first_fall(falling, to, wanted);
        const auto rising = [&](const Real& t) {
            const value_and_slope<Real> f = falling(t);
            return value_and_slope<Real>{-f.value, -f.slope};
        };
        return {wanted, bracketed_root<Real>(rising, within, within.low, wanted)};
    } else {
        break_points<Degree, Real> points;
        for (int i = 0; i < Degree; ++i) points.at[i] = to;
        if (any(bends)) {
            const auto changes = sign_changes<Degree>(polynomial, to, bends);
            for (int i = 0; i < Degree; ++i) points.at[i] = select(bends, changes.at[i], to);
        }
        return first_fall_between(falling, points, to, wanted);
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::mirror
