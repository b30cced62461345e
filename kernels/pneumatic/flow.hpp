// One integrator step of a pneumatic stance with friction, in the time s with dt = chi ds, where
// the right-hand side is polynomial and a leg pressed to nothing is no singularity:
//   chi' = chi v,  depth' = -chi v,  v' = eta - gamma chi v - g chi,  t' = chi.
// Both the length chi and the depth below lift-off are carried, so that each keeps its relative
// accuracy. Source: models/raibert_hopper.md section 3; Koditschek, Buehler 1991, (8).
#pragma once

#include "kernels/integrators/first_zero.hpp"
#include "kernels/integrators/taylor.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

/// State of an arc.
template <class Real>
struct arc_state {
    Real length, depth, velocity;
};

/// The depth's series is the length's, but for sign and value at 0.
template <class Real>
struct arc_series {
    taylor::series<Real> length, velocity, time;
    Real depth;  // at 0

    HOPSCOTCH_DEVICE arc_state<Real> at(const Real& s) const {
        const Real rate = taylor::mean_rate(length, s);
        return {fma(rate, s, length.c[0]), fma(-rate, s, depth), taylor::evaluate(velocity, s)};
    }
    /// The state a time t after the step's beginning, for `trace`.
    arc_state<Real> at_time(const Real& t, const Real& end) const {
        const auto rising = [&](const Real& s) {
            auto at = taylor::value_slope(time, s);
            at.value = at.value - t;
            return at;
        };
        return at(bracketed_root<Real>(rising, {Real(0.0), end}, end * Real(0.5), end > Real(0.0)));
    }
};

template <class Real>
HOPSCOTCH_DEVICE inline void expand(arc_series<Real>& a, const arc_state<Real>& from,
                                    const Real& stiffness, const Real& friction,
                                    const Real& gravity) {
    using taylor::over;
    a.length.c[0] = from.length;
    a.velocity.c[0] = from.velocity;
    a.time.c[0] = Real(0.0);
    a.depth = from.depth;
    const auto next = [&](int n, const Real& drift) {
        const Real drag = fma(friction, drift, gravity * a.length.c[n]);
        a.length.c[n + 1] = over(drift, n + 1);
        a.velocity.c[n + 1] = over(n == 0 ? stiffness - drag : -drag, n + 1);
        a.time.c[n + 1] = over(a.length.c[n], n + 1);
    };
    static_assert(taylor::order<Real> % 2 == 0);
    for (int n = 0; n < taylor::order<Real>; n += 2) {
        const auto drift = taylor::products(a.length, a.velocity, n);
        next(n, drift.first);
        next(n + 1, taylor::completed(drift.rest, a.length, a.velocity, n + 1));
    }
}

template <class Real>
HOPSCOTCH_DEVICE inline primal_of<Real> step_of(const arc_series<Real>& a, const Real& tolerance) {
    using plain = primal_of<Real>;
    taylor::step_length<Real> size;
    size.watch(a.length, 0.0);  // relative, however short the leg
    size.watch(a.velocity);
    return size.length(primal(tolerance), plain(1e6));
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
