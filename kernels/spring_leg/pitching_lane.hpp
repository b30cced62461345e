// One trajectory of the runner whose leg is hinged at a distance from the centre of mass, in units
// of the leg length and sqrt(leg length / g); at a section in the section's own units, so that an
// orbit continued from what was read goes on as the same orbit. Source: models/slip.md section 6.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/elementary/elementary.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg {

/// The body is at G, the hip at G + hip (-sin pitch, cos pitch); pitch counts counterclockwise.
template <class Real>
struct pitching_runner {
    // parameters; gravity is 1 in these units
    Real time_unit, speed_unit;
    Real leg;        // leg length in metres
    Real stiffness;  // k eta0 / (m g) or c / (m g eta0^3)
    Real hip;        // d / eta0
    Real inertia;    // I / (m eta0^2)
    Real beta;
    Real body;  // 1 where the leg is placed relative to the body: its angle is beta - pitch
    // hip height - required height = centre's height + swing_cos cos(pitch) + swing_sin sin(pitch)
    // - level
    Real swing_cos, swing_sin, level;
    Real energy;  // over m g eta0, with the touchdown's foothold as origin

    // the last touchdown, in the section's units
    Real speed, angle, pitch, pitch_rate;
    Real time, events;

    // stance: hip about the foothold, velocity of the centre, pitch
    Real x, y, x_rate, y_rate, turn, turn_rate, length;
    Real in_stance;  // 1 while under way
    Real elapsed;    // since touchdown
    Real untouched;  // 1 in the first step of a stance: the lift-off guard starts at zero
    Real tolerance;  // of a step of the integrator
};

/// Energy that the height of the centre at touchdown and the pitching take, over m g eta0.
template <class Real>
HOPSCOTCH_DEVICE inline Real energy_beside_speed(const pitching_runner<Real>& lane,
                                                 const Real& pitch, const Real& pitch_rate) {
    const Real half(0.5);
    const Real required = sin(fma(-lane.body, pitch, lane.beta));
    const Real centre = fma(-lane.hip, cos(pitch), required);
    return fma(half * lane.inertia, pitch_rate * pitch_rate, centre);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::spring_leg
