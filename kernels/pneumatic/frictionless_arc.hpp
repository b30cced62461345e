// Compression and decompression of a pneumatic leg without friction, from energy: depths in closed
// form or by one scalar root, durations by quadrature. The leg's length is written chi = liftoff
// height e^{-depth}, so that neither tiny impacts nor tiny bottoms lose digits. Source:
// models/raibert_hopper.md sections 3, 5 and 8; Koditschek, Buehler 1991, (8), (13).
#pragma once

#include "kernels/elementary/elementary.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/integrators/unit_integral.hpp"
#include "kernels/lanes/implicit_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

/// ln(liftoff height / bottom height) of an impact: the positive root of
/// eta x - weight (1 - e^{-x}) = v^2 / 2, which is the Lambert-W formula of the page without its
/// cancellation.
///
/// \param stiffness  eta > 0
/// \param weight     g times lift-off height, >= 0
/// \param speed      of touchdown, > 0
/// \error  a few ulp times eta / |eta - weight| where the impact is small
template <class Real>
HOPSCOTCH_DEVICE inline Real bottom_depth(const Real& stiffness, const Real& weight,
                                          const Real& speed, const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const Real energy = Real(0.5) * speed * speed;
    const plain eta = primal(stiffness);
    const plain load = primal(weight);
    const plain wanted_energy = primal(energy);
    const auto rising = [&](const plain& x) {
        const plain fallen = expm1(-x);
        return value_and_slope<plain>{fma(load, fallen, fma(eta, x, -wanted_energy)),
                                      eta - load * (plain(1.0) + fallen)};
    };
    const plain low = wanted_energy / eta;
    const plain high = (wanted_energy + load) / eta;
    const plain excess =
        eta - load;  // convex: Newton's method from the right of the root is monotone
    const plain small = wanted_energy / select(excess > plain(0.0), excess, plain(1.0));
    const plain guess = select((excess > plain(0.0)) & (small < high), small, high);
    const plain root = bracketed_root<plain>(rising, {low, high}, guess, wanted);
    const Real at(root);
    return implicit_root(root, fma(weight, expm1(-at), fma(stiffness, at, -energy)),
                         rising(root).slope);
}

/// Duration of an arc between depth `from`, where the velocity squared is `start`, and depth 0.
template <class Real>
HOPSCOTCH_DEVICE inline Real arc_duration(const Real& from, const Real& start,
                                          const Real& stiffness, const Real& gravity,
                                          const Real& height) {
    const Real two(2.0);
    const auto slowness = [&](const Real& passed, const Real& left) {
        const Real length = height * exp(-(from * left));
        const Real gained = from * passed;
        const Real square =
            fma(two, fma(stiffness, gained, gravity * length * expm1(-gained)), start);
        return length / sqrt(square);
    };
    return from * integrals::over_unit_interval<Real>(slowness);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
