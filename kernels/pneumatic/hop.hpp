// What every hop on a pneumatic leg has, with friction or without: thrust, the energy that lift-off
// takes, flight, and hops so small that their arcs merge. Source: models/raibert_hopper.md sections
// 3, 4 and 8; Koditschek, Buehler 1991, (7), (8).
#pragma once

#include "kernels/pneumatic/hopper_lane.hpp"
#include "kernels/pneumatic/thrust.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

/// Below this speed a hop obeys v' = P'(0) v (page, sections 4.6 and 8.10).
inline constexpr double slowest_impact = 1e-8;

/// Thrust from the bottom on; lanes whose thrust is cut are at lift-off (depth 0) afterwards.
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline thrust_end<Real> push_off(hopper_lane<Real>& lane,
                                                  const mask_of<Real>& wanted, Watch& watch) {
    const Real zero(0.0);
    const Real one(1.0);
    const auto end = thrust(lane.depth, lane.length, lane.thrust - lane.gravity, lane.friction,
                            lane.thrust_time, wanted);
    if constexpr (Watch::is_active) {
        const Real net = lane.thrust - lane.gravity;
        watch.phase("thrust", lane.time, end.duration, [&](Real t, Real* columns) {
            const auto there = push(t, lane.friction);
            columns[0] = fma(net, there.displacement, lane.length);
            columns[1] = net * there.velocity;
        });
    }
    const mask_of<Real> full = wanted & !end.cut;
    lane.length =
        select(full, lane.length + end.rise, select(end.cut, lane.lift_height, lane.length));
    lane.depth = select(full, lane.depth - end.rise, select(end.cut, zero, lane.depth));
    lane.velocity = select(wanted, end.velocity, lane.velocity);
    lane.time = select(wanted, lane.time + end.duration, lane.time);
    lane.spring = select(full, lane.thrust * lane.length, lane.spring);
    lane.was_cut = select(end.cut, one, lane.was_cut);
    lane.events = select(full, lane.events + one, lane.events);
    lane.fresh = select(wanted, zero, lane.fresh);
    if constexpr (Watch::is_active) {
        if (full)
            report(watch, "thrust end", lane, "thrust", "decompression", lane.velocity,
                   lane.velocity);
    }
    return end;
}

/// ln(lift-off height / length), from whichever of depth and length is the more accurate.
template <class Real>
HOPSCOTCH_DEVICE inline Real logarithmic_depth(const hopper_lane<Real>& lane) {
    const mask_of<Real> shallow = lane.depth < Real(0.5) * lane.lift_height;
    const Real share = select(shallow, lane.depth / lane.lift_height, Real(0.0));
    const Real length = select(shallow, lane.lift_height, lane.length);
    return select(shallow, -log1p(-share), log(lane.lift_height / length));
}

/// Square of the speed at which decompression would reach lift-off without friction; <= 0: it
/// does not, with friction neither (page, section 4.9).
template <class Real>
HOPSCOTCH_DEVICE inline Real liftoff_square(const hopper_lane<Real>& lane, const Real& log_depth) {
    const Real gained = fma(lane.spring, log_depth, -(lane.gravity * lane.depth));
    return fma(Real(2.0), gained, lane.velocity * lane.velocity);
}

/// Does the energy reach to lift-off? For most lanes the bound ln(l / chi) > 2 (l - chi) /
/// (l + chi) says so.
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> can_lift_off(const hopper_lane<Real>& lane,
                                                   const mask_of<Real>& wanted) {
    const Real zero(0.0);
    const Real spring = Real(2.0) * lane.spring * lane.depth;
    const Real excess = fma(Real(0.5) * lane.velocity, lane.velocity, -(lane.gravity * lane.depth));
    const mask_of<Real> surely =
        fma(excess, lane.lift_height + lane.length, spring) > spring * Real(0x1p-40);
    const mask_of<Real> pushes = lane.thrust > lane.gravity;
    if (!any(wanted & pushes & !surely)) return pushes;
    const Real square = liftoff_square(lane, logarithmic_depth(lane));
    return pushes & (surely | (square > zero));
}

/// Lift-off at `speed`, the leg's inertia, and the flight to the next touchdown. Returns the
/// lanes whose return this completes; those counted at the apex owe the fall to their next one.
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline mask_of<Real> fly(hopper_lane<Real>& lane, const Real& speed,
                                          const mask_of<Real>& wanted, Watch& watch) {
    const Real one(1.0);
    const Real next = speed / lane.leg_factor;
    const Real rise = next / lane.flight_gravity;
    if constexpr (Watch::is_active) {
        if (wanted) {
            report(watch, "lift-off", lane, lane.depth == Real(0.0) ? "thrust" : "decompression",
                   "flight", speed, next);
            watch.phase("flight", lane.time, rise + rise, [&](Real t, Real* columns) {
                columns[0] = lane.lift_height + t * fma(Real(-0.5) * lane.flight_gravity, t, next);
                columns[1] = fma(-lane.flight_gravity, t, next);
            });
        }
    }
    const mask_of<Real> to_apex = wanted & (lane.section == one);
    lane.speed = select(wanted, next, lane.speed);
    lane.time = select(wanted, lane.time + select(to_apex, rise, rise + rise), lane.time);
    lane.owed = select(to_apex, rise, lane.owed);
    lane.events = select(wanted, lane.events + Real(2.0), lane.events);
    touch_down(lane, wanted);
    return wanted & !(lane.section == Real(2.0));
}

/// Hops so small that their arcs merge: v' = P'(0) v, P'(0)^2 = (tau - g) / (eta1 / chi_l - g).
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline mask_of<Real> hop_tiny(hopper_lane<Real>& lane, const mask_of<Real>& wanted,
                                               Watch& watch) {
    const Real zero(0.0);
    const Real net = lane.thrust - lane.gravity;
    const Real braking = lane.stiffness / lane.lift_height - lane.gravity;
    const mask_of<Real> tiny = wanted & (lane.speed < Real(slowest_impact)) & (net > zero) &
                               (braking > zero) & !(lane.section == Real(2.0));
    if (!any(tiny)) return tiny;
    const Real push = select(tiny, net, Real(1.0));
    const Real brake = select(tiny, braking, Real(1.0));
    const Real launched = sqrt(push / brake) * lane.speed;
    lane.time = select(tiny, lane.time + lane.speed / brake + launched / push, lane.time);
    lane.was_cut = select(tiny & (lane.thrust_time > zero), Real(1.0), lane.was_cut);
    lane.bottom = select(tiny, lane.lift_height, lane.bottom);
    lane.events = select(tiny, lane.events + Real(1.0), lane.events);
    return fly(lane, launched, tiny, watch);
}

template <class Real>
HOPSCOTCH_DEVICE inline void pay(hopper_lane<Real>& lane, const mask_of<Real>& active) {
    lane.time = select(active, lane.time + lane.owed, lane.time);
    lane.owed = select(active, Real(0.0), lane.owed);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
