// The massless leg in the air under the "force" take-off guard: it relaxes towards its thrust,
// stops at its rest length, and touches down where the body's parabola meets it again. Scaled
// units. Source: models/openloop_hopper.md section 3.3.
#pragma once

#include "kernels/elementary/exponential.hpp"
#include "kernels/elementary/logarithm.hpp"
#include "kernels/events/piece_root.hpp"
#include "kernels/lanes/implicit_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::openloop {

/// Time until a parabola from `height` >= 0 with velocity `rise` is back at zero.
template <class Real>
HOPSCOTCH_DEVICE inline Real fall_time(const Real& height, const Real& rise) {
    const Real speed = sqrt(fma(rise, rise, Real(2.0) * height));
    const mask_of<Real> rises = rise >= Real(0.0);
    return select_form(rises, rise + speed, Real(2.0) * height / (speed - rise));
}

/// Body above the relaxing leg. The leg's end is at force - stretch e^{-t / lag} until it reaches
/// 0.
template <class Real>
struct leg_flight {
    Real height;
    Real velocity;
    Real leg;         // end of the leg, <= 0 and <= height
    Real force;       // thrust, >= 0
    Real relaxation;  // 1 / (2 zeta)

    HOPSCOTCH_DEVICE Real stretch() const { return force - leg; }
    HOPSCOTCH_DEVICE Real gap(const Real& t) const {
        const Real body = fma(t, fma(t, Real(-0.5), velocity), height - leg);
        return fma(stretch(), expm1(-(relaxation * t)), body);
    }
    HOPSCOTCH_DEVICE Real gap_rate(const Real& t) const {
        return (velocity - t) - stretch() * relaxation * exp(-(relaxation * t));
    }
    HOPSCOTCH_DEVICE Real gap_curvature(const Real& t) const {
        return fma(stretch() * relaxation, relaxation * exp(-(relaxation * t)), Real(-1.0));
    }
    /// Where the leg's end is, not above its stop.
    HOPSCOTCH_DEVICE Real leg_at(const Real& t) const {
        return smaller(fma(-stretch(), expm1(-(relaxation * t)), leg), Real(0.0));
    }
};

template <class Real>
struct touch_down {
    Real time;
    Real leg;  // its end at contact
};

/// The touch-down of a flight, which always comes.
///
/// \param flight  height = leg right after take-off (contact there does not count)
/// \param wanted  lanes to solve
/// \return        time of the first contact with the leg, also where the thrust changes before
/// \error         none; idle lanes give nonsense
/// The gap is convex up to one inflection and concave after it. Once the leg has reached its stop
/// the parabola alone decides.
template <class Real>
HOPSCOTCH_DEVICE inline touch_down<Real> first_touch(const leg_flight<Real>& flight,
                                                     const mask_of<Real>& wanted) {
    using plain = primal_of<Real>;
    const plain zero(0.0);
    const leg_flight<plain> value{primal(flight.height), primal(flight.velocity),
                                  primal(flight.leg), primal(flight.force),
                                  primal(flight.relaxation)};
    const mask_of<Real> relaxes = wanted & (value.leg < zero);
    const mask_of<Real> is_below = !relaxes & (value.height < zero);  // by rounding
    const plain height = select(is_below, zero, value.height);
    plain time = fall_time(height, value.velocity);
    mask_of<Real> on_leg = relaxes & !relaxes;
    if (any(relaxes)) {
        const plain stretch = value.stretch();
        const mask_of<Real> stops = value.force > zero;
        const plain stop_time =
            select(stops, log(stretch / select(stops, value.force, stretch)) / value.relaxation,
                   infinity<plain>());
        const plain back_time = fall_time(value.height - value.leg, value.velocity);
        const plain to = smaller(stop_time, back_time);
        const plain bend = stretch * value.relaxation * value.relaxation;
        const plain bend_time = log(larger(bend, plain(1.0))) / value.relaxation;
        const plain middle = smaller(bend_time, to);
        const mask_of<Real> parted = relaxes & (value.height > value.leg);
        const mask_of<Real> all = relaxes | !relaxes;
        const auto early = first_root_on_piece<plain>(value, zero, middle, all, middle, parted);
        const auto late =
            first_root_on_piece<plain>(value, middle, to, !all, to, relaxes & !early.found);
        on_leg = early.found | late.found;
        time = select(early.found, early.time, select(late.found, late.time, time));
    }
    const Real met = implicit_root(time, flight.gap(Real(time)), value.gap_rate(time));
    // with the leg at its stop the parabola's root carries the derivatives
    const Real body = fma(Real(time), fma(Real(time), Real(-0.5), flight.velocity), flight.height);
    const Real fallen = implicit_root(time, body, value.velocity - time);
    const Real when = select(on_leg, met, fallen);
    return {when, select(on_leg, flight.leg_at(when), Real(0.0))};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::openloop
