// One trajectory of the passive hopper (or juggler: the same numbers in other coordinates), and how
// its lift-off speed is stored: as a cell index and the distance to that cell's lossless point, so
// that the cube-root events next to it keep full relative accuracy (models/passive_hopper.md, H1,
// H2, H5).
#pragma once

#include "kernels/passive/half_flight.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::passive {

/// Leading members of a lane that follow from the parameters alone.
inline constexpr int n_parameter_fields = 7;

template <class Real>
struct hopper_lane {
    // parameters and what follows from them
    Real inverse_mass;   // 1 / M
    Real mu;             // M / (1 + M)
    Real kappa;          // M / (1 + M)^2
    Real inverse_total;  // 1 / (1 + M)
    Real restitution;
    Real damping;
    Real increment;

    // section state: lift-off speed alpha = centre + centre_low + beta, cell k pi < alpha <= (k +
    // 1) pi
    Real cell;
    Real centre;
    Real centre_low;
    Real centre_cosine;
    Real beta;

    // the flight about to be computed: a lift-off from the section state, or a bounce from the
    // ground with y1 = 1 + eta, v1 = velocity and gap rate `rebound` (0 unless restitution lets the
    // foot rebound). A damped spring lifts off at eta = -2 zeta alpha.
    Real is_bounce;
    Real eta;
    Real velocity;
    Real rebound;

    // energy bookkeeping of the current return
    Real energy;       // of a flight start, as alpha^2 of a lift-off
    Real loss;         // what impacts took from it so far
    Real from_flight;  // 1 while the first return of a flight start is under way

    Real trapped;  // label proved by the last return, or 0

    // reported
    Real time;
    Real events;
    Real bounces;
    Real total_loss;
};

/// alpha of the section state.
template <class Real>
HOPSCOTCH_DEVICE inline Real lift_off_speed(const hopper_lane<Real>& lane) {
    return lane.centre + (lane.centre_low + lane.beta);
}

/// Moves the lane's cell data to cell k, for the lanes wanted; beta is left to the caller.
template <class Real>
HOPSCOTCH_DEVICE inline void enter_cell(hopper_lane<Real>& lane, Real k, mask_of<Real> wanted) {
    const lossless<Real> point = lossless_point(k);
    lane.cell = select(wanted, k, lane.cell);
    lane.centre = select(wanted, point.high, lane.centre);
    lane.centre_low = select(wanted, point.low, lane.centre_low);
    lane.centre_cosine = select(wanted, point.cosine, lane.centre_cosine);
}

/// Stores a lift-off speed given as one number.
template <class Real>
HOPSCOTCH_DEVICE inline void set_lift_off_speed(hopper_lane<Real>& lane, Real alpha,
                                                mask_of<Real> wanted) {
    enter_cell(lane, cell_of(alpha), wanted);
    const Real beta = (alpha - lane.centre) - lane.centre_low;
    lane.beta = select(wanted, beta, lane.beta);
}

/// Stores the lift-off speed centre + beta, moving to another cell where beta has left this one.
template <class Real>
HOPSCOTCH_DEVICE inline void set_distance(hopper_lane<Real>& lane, Real beta,
                                          mask_of<Real> wanted) {
    const Real left = fma(lane.cell, pi<Real>(), -lane.centre);
    const mask_of<Real> leaves =
        wanted & !((beta > left) & (beta <= left + pi<Real>())) & !(beta == Real(0.0));
    Real shifted = beta;
    if (any(leaves)) {
        const Real k = cell_of(larger(lane.centre + (lane.centre_low + beta), Real(0.0)));
        const Real high = lane.centre;
        const Real low = lane.centre_low;
        enter_cell(lane, k, leaves);
        shifted = select(leaves, beta + ((high - lane.centre) + (low - lane.centre_low)), beta);
    }
    lane.beta = select(wanted, shifted, lane.beta);
}

/// How the next flight leaves the ground.
template <class Real>
HOPSCOTCH_DEVICE inline launch<Real> launch_of(const hopper_lane<Real>& lane) {
    const mask_of<Real> bounces = lane.is_bounce > Real(0.0);
    return {select(bounces, Real(0.0), lane.centre), select(bounces, Real(1.0), lane.centre_cosine),
            select(bounces, lane.velocity, lane.beta), lane.eta};
}

/// Prepares the flight that follows the section state.
template <bool Damped = true, class Real>
HOPSCOTCH_DEVICE inline void launch_from_section(hopper_lane<Real>& lane, mask_of<Real> wanted) {
    const Real zero(0.0);
    Real eta = zero;
    if constexpr (Damped) eta = zero - Real(2.0) * lane.damping * lift_off_speed(lane);
    lane.is_bounce = select(wanted, zero, lane.is_bounce);
    lane.eta = select(wanted, eta, lane.eta);
    lane.rebound = select(wanted, zero, lane.rebound);
    lane.loss = select(wanted, zero, lane.loss);
    lane.from_flight = select(wanted, zero, lane.from_flight);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::passive
