// Hops on a pneumatic leg with friction: two integrated arcs, one step at a time. Source:
// models/raibert_hopper.md sections 3 and 4; Koditschek, Buehler 1991, (8).
#pragma once

#include "kernels/pneumatic/flow.hpp"
#include "kernels/pneumatic/hop.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic {

/// A decompression longer than this, in steps or seconds, is reported as `creep`.
inline constexpr double most_arc_steps = 3000.0;
inline constexpr double longest_arc = 1e6;

/// Slow impacts on an overdamped leg creep towards the equilibrium and have no bottom
/// (section 4.10).
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> sinks(const hopper_lane<Real>& lane,
                                            const mask_of<Real>& compresses) {
    const Real zero(0.0);
    const mask_of<Real> soft = compresses & (lane.stiffness < lane.gravity * lane.lift_height);
    if (!any(soft)) return soft;
    const Real root = fma(lane.friction, lane.friction,
                          -(Real(4.0) * lane.gravity * lane.gravity / lane.stiffness));
    const mask_of<Real> overdamped = soft & (root >= zero);
    const Real above = lane.length - lane.stiffness / select(soft, lane.gravity, Real(1.0));
    const Real slope = Real(0.5) * (lane.friction + sqrt(select(overdamped, root, zero)));
    return overdamped & (above > zero) & (-lane.velocity <= slope * above);
}

/// One integrator step of an arc; thrust is taken at the beginning of decompression.
template <class Real, class Watch>
HOPSCOTCH_DEVICE inline progress<Real> step_with_friction(hopper_lane<Real>& lane,
                                                          const mask_of<Real>& active,
                                                          Watch& watch) {
    using plain = primal_of<Real>;
    const Real zero(0.0);
    const Real one(1.0);
    pay(lane, active);
    const mask_of<Real> fresh = active & (lane.fresh > zero);
    mask_of<Real> returned = hop_tiny(lane, fresh & !(lane.extending > zero), watch);
    const mask_of<Real> moving = active & !returned;
    const mask_of<Real> pushes = fresh & moving & (lane.extending > zero);
    mask_of<Real> cut = pushes & !pushes;
    mask_of<Real> crashes = cut;
    if (any(pushes)) {
        const auto end = push_off(lane, pushes, watch);
        cut = end.cut;
        crashes = end.crashes;
        returned = returned | fly(lane, lane.velocity, cut, watch);
    }
    lane.fresh = select(moving & !cut, zero, lane.fresh);
    const mask_of<Real> extends = moving & !cut & !crashes & (lane.extending > zero);
    const mask_of<Real> compresses = moving & !cut & !(lane.extending > zero);
    const mask_of<Real> fails = extends & !can_lift_off(lane, extends);
    const mask_of<Real> stays = sinks(lane, compresses);
    const mask_of<Real> flows = (extends & !fails) | (compresses & !stays);

    const arc_state<Real> from{lane.length, lane.depth, lane.velocity};
    arc_series<Real> a;
    expand(a, from, select(lane.extending > zero, lane.spring, lane.stiffness), lane.friction,
           lane.gravity);
    const plain horizon = step_of(a, lane.tolerance);
    const Real still = select(extends & (lane.velocity == zero), one, zero);
    // each arc ends at its own guard: the bottom, or lift-off; an extension may also turn first
    taylor::series<Real> ending;
    for (int n = 0; n <= taylor::order<Real>; ++n)
        ending.c[n] = select(extends, -a.length.c[n], -a.velocity.c[n]);
    ending.c[0] = select(extends, a.depth, ending.c[0]);
    const auto end = taylor::first_zero(ending, horizon, flows);
    taylor::series<Real> rising;
    rising = a.velocity;
    taylor::divide_out_zeros(rising, still);
    const auto falls_back = taylor::first_zero(rising, horizon, flows & extends);
    taylor::guard_search<Real> off = end;
    off.found = end.found & extends;
    off.unresolved = end.unresolved & extends;
    taylor::guard_search<Real> turn = falls_back;
    turn.found = falls_back.found | (end.found & compresses);
    turn.unresolved = falls_back.unresolved | (end.unresolved & compresses);
    turn.time = select(compresses, end.time, falls_back.time);
    const mask_of<Real> lifts = flows & off.found & !(turn.found & (turn.time < off.time));
    const mask_of<Real> turns = flows & turn.found & !lifts;
    const Real s = select(lifts, off.time, select(turns, turn.time, Real(horizon)));
    const Real passed = taylor::evaluate(a.time, s);
    if constexpr (Watch::is_active) {
        if (fresh && compresses) {
            report(watch, "touchdown", lane, "flight", "compression", lane.velocity, lane.velocity);
        }
        if (flows) {
            watch.phase(compresses ? "compression" : "decompression", lane.time, passed,
                        [&](Real t, Real* columns) {
                            const auto now = a.at_time(t, s);
                            columns[0] = now.length;
                            columns[1] = now.velocity;
                        });
        }
    }
    const arc_state<Real> there = a.at(s);
    lane.length = select(flows, there.length, lane.length);
    lane.depth = select(flows, there.depth, lane.depth);
    lane.velocity = select(flows, there.velocity, lane.velocity);
    lane.time = select(flows, lane.time + passed, lane.time);
    lane.arc_time = select(flows, lane.arc_time + passed, lane.arc_time);
    lane.arc_steps = select(flows, lane.arc_steps + one, lane.arc_steps);

    const mask_of<Real> bottoms = turns & compresses;
    reach_bottom(lane, bottoms);
    if constexpr (Watch::is_active) {
        if (bottoms) report(watch, "bottom", lane, "compression", "thrust", zero, zero);
    }
    const mask_of<Real> lost = flows & ((turn.unresolved & !lifts) | (off.unresolved & !turns));
    const mask_of<Real> broken = flows & !(horizon >= plain(0.0));
    const mask_of<Real> creeps =
        extends & flows & !lifts & !turns &
        ((lane.arc_steps > Real(most_arc_steps)) | (lane.arc_time > Real(longest_arc)));
    returned =
        returned | fly(lane, lane.velocity, lifts, watch) | (bottoms & (lane.section == Real(2.0)));
    Real ended = select(fails | (turns & extends), code_of<Real>(outcome::no_liftoff), zero);
    ended = select(stays, code_of<Real>(outcome::sinks), ended);
    ended = select(crashes, code_of<Real>(outcome::crash), ended);
    ended = select(creeps, code_of<Real>(outcome::creep), ended);
    ended = select(lost, code_of<Real>(outcome::unresolved_event), ended);
    ended = select(broken, code_of<Real>(outcome::not_finite), ended);
    returned = returned & (ended == zero);
    return {returned, ended};
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::pneumatic
