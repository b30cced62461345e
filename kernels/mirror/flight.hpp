// What the planar and the spatial mirror-law juggler share: the energy gain, the ends of a flight,
// and the order in which a cycle's outcomes are tested. Source: models/mirror_juggler.md, sections
// 0-2.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/events/bracketed_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::mirror {

enum law_index { original, solvable, level };

/// The horizontal motion of a flight as seen from the shoulder.
template <class Real>
struct horizontal {
    Real distance;
    Real advance;  // position . velocity
    Real speed_square;
    Real spin;  // position x velocity; 0 in the plane
};

/// First time at which the horizontal distance has fallen to `radius`; +infinity where it never
/// does. Starts outside. The discriminant comes from the spin: for motion through the shoulder it
/// is a square.
template <class Real>
HOPSCOTCH_DEVICE inline Real shoulder_time(const horizontal<Real>& motion, const Real& radius) {
    const Real zero(0.0);
    const Real excess = (motion.distance - radius) * (motion.distance + radius);
    const Real room = fma(motion.speed_square * radius, radius, -(motion.spin * motion.spin));
    const mask_of<Real> passes = (motion.advance < zero) & (room >= zero);
    const Real closing = larger(sqrt(larger(room, zero)) - motion.advance, zero);
    const Real time = excess / closing;
    return select(passes, time, infinity<Real>());
}

/// Time at which the ball, at its apex now, has fallen to the floor; 0 where it is below already.
template <class Real>
HOPSCOTCH_DEVICE inline Real floor_time(const Real& height, const Real& floor_height,
                                        const Real& gravity) {
    return sqrt(Real(2.0) * larger(height - floor_height, Real(0.0)) / gravity);
}

/// Everything a cycle's outcome depends on.
template <class Real>
struct cycle_tests {
    mask_of<Real> starts_at_shoulder;
    mask_of<Real> has_gap;         // the ball is above the contact function at its apex
    mask_of<Real> has_contact;     // a first root up to the end of the flight
    mask_of<Real> shoulder_first;  // the flight ends at the shoulder, not on the floor
    mask_of<Real> on_bar;
    mask_of<Real> rises;  // after the impact
    mask_of<Real> ends_at_shoulder;
};

/// The outcome of a cycle, first match wins (page, section 2).
template <class Real>
HOPSCOTCH_DEVICE inline Real outcome_of(const cycle_tests<Real>& test, const Real& gain) {
    const Real shoulder = code_of<Real>(outcome::over_shoulder);
    Real code = select(test.ends_at_shoulder, shoulder, Real(0.0));
    code = select(test.rises, code, code_of<Real>(outcome::downward));
    code = select(test.on_bar, code, code_of<Real>(outcome::off_bar));
    const Real missed = select(test.shoulder_first, shoulder, code_of<Real>(outcome::fell));
    code = select(test.has_contact, code, missed);
    code = select(test.has_gap, code, code_of<Real>(outcome::apex_below));
    code = select(gain > Real(-1.0), code, code_of<Real>(outcome::invalid_gain));
    return select(test.starts_at_shoulder, shoulder, code);
}

/// Time after which a ball falling from rest relative to a ray of slope s is on it: z(t) = s x(t),
/// with `gap` = z(0) - s x(0) > 0 and `drift` = s v. No cancellation for either sign of the drift
/// (page, 4).
template <class Real>
struct ray_contact {
    Real time;
    Real closing;  // speed at which the gap closes
};
template <class Real>
HOPSCOTCH_DEVICE inline ray_contact<Real> fall_on_ray(const Real& gap, const Real& drift,
                                                      const Real& gravity) {
    const Real closing = sqrt(fma(drift, drift, Real(2.0) * gravity * gap));
    const mask_of<Real> meets = drift >= Real(0.0);
    const Real time =
        select_form(meets, Real(2.0) * gap / (closing + drift), (closing - drift) / gravity);
    return {time, closing};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::mirror
