// One stance of Raibert's hopper on a linear spring: compression to the bottom, thrust,
// decompression up to lift-off, as closed-form arcs. Variants: 0 every stance underdamped, 1 any
// damping, 2 any damping and a spring that the thrust has preloaded. Source: Koditschek and Buehler
// 1991, Eq (10) and section 3.2; models/raibert_hopper.md, sections 3-5.
#pragma once

#include "kernels/raibert/damped_spring.hpp"
#include "kernels/raibert/thrust.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::raibert {

/// The leg's shortening since touchdown is the state of a stance, so that small impacts keep their
/// digits.
template <class Real>
struct linear_lane {
    Real height;  // chi_l
    Real stiffness;
    Real friction;
    Real gravity;  // in stance
    Real slack;    // chi_0 - chi_l
    Real thrust;
    Real lift;  // acceleration of the thrust, tau less gravity
    Real thrust_time;
    Real flight_gravity;
    Real leg_share;    // 1 / (1 + mu')
    Real speed;        // at touchdown
    Real depth;        // of the next bottom below lift-off height
    Real square;       // of the speed at which that bottom's energy would lift off
    Real compression;  // time from touchdown to that bottom
    Real pending;      // outcome of the stance ahead, where it has no bottom
    Real section;
    Real thrust_cut;
    Real time;
    Real events;
};

/// Where compression ends; without a bottom the leg sinks.
template <class Real>
struct stance_bottom {
    mask_of<Real> exists;
    Real time, depth;
};

/// Where thrust and decompression end.
template <class Real>
struct linear_lift_off {
    mask_of<Real> exists, is_cut;
    Real thrust_time, rise_time;
    Real speed;                // of the body just before lift-off
    Real remaining, velocity;  // shortening and velocity at the end of the thrust
    Real stiffness, pull;      // of the decompression
};

template <int Variant, class Real>
using linear_spring = damped_spring<Variant == 0, Real>;

/// Minus the acceleration of the spring and gravity at lift-off height.
template <class Real>
HOPSCOTCH_DEVICE inline Real pull_at_liftoff(const linear_lane<Real>& lane) {
    return fma(-lane.stiffness, lane.slack, lane.gravity);
}

/// From touchdown to the bottom.
template <int Variant, class Real>
HOPSCOTCH_DEVICE inline stance_bottom<Real> compress(const linear_lane<Real>& lane,
                                                     const Real& speed) {
    const auto spring =
        linear_spring<Variant, Real>::with(lane.stiffness, lane.friction * Real(0.5));
    const Real pull = pull_at_liftoff(lane);
    const auto bottom = spring.turn(pull, -speed, false);
    const Real time = select(bottom.exists, bottom.time, Real(0.0));
    return {bottom.exists, time, -spring.after(time, pull, -speed).displacement};
}

/// Without friction the lift-off speed is the touchdown speed, changed by the work of the
/// thrust: a weak thrust keeps the digits that the stance's larger energies would cost.
template <class Real>
HOPSCOTCH_DEVICE inline void conserve_energy(const linear_lane<Real>& lane,
                                             linear_lift_off<Real>& end, const Real& moved) {
    const Real zero(0.0);
    const Real pull = fma(-lane.stiffness, lane.depth, pull_at_liftoff(lane));  // at the bottom
    const Real gained =
        fma(moved, fma(lane.stiffness, moved, Real(2.0) * pull), end.velocity * end.velocity);
    const Real square = lane.square + gained;
    const mask_of<Real> known = end.exists & (lane.friction == zero) & (square > zero);
    end.speed = select(known, sqrt(select(known, square, Real(1.0))), end.speed);
}

/// Fills in rise_time, speed and exists. Without lift-off rise_time ends at the top, where
/// there is one.
template <int Variant, class Real>
HOPSCOTCH_DEVICE inline void decompress(const linear_lane<Real>& lane, linear_lift_off<Real>& end,
                                        mask_of<Real> wanted) {
    using plain = primal_of<Real>;
    const plain zero(0.0);
    const auto spring =
        linear_spring<Variant, Real>::with(end.stiffness, lane.friction * Real(0.5));
    Real pull = end.pull;
    Real velocity = end.velocity;
    Real rise = end.remaining;
    Real sunk(0.0);  // time spent on the way down after a thrust weaker than gravity
    const mask_of<Real> falls = wanted & (velocity < Real(0.0));
    mask_of<Real> alive = wanted;
    if (any(falls)) {
        const auto low = spring.turn(pull, velocity, false);
        const mask_of<Real> turns = falls & low.exists;
        const Real time = select(turns, low.time, Real(0.0));
        const Real down = spring.after(time, pull, velocity).displacement;
        sunk = time;
        rise = select(turns, rise - down, rise);
        pull = select(turns, fma(end.stiffness, down, pull), pull);
        velocity = select(falls, Real(0.0), velocity);
        alive = alive & (!falls | turns);
    }
    const auto search = linear_spring<Variant, plain>::with(primal(end.stiffness),
                                                            primal(lane.friction) * plain(0.5));
    const plain from_pull = primal(pull);
    const plain from_velocity = primal(velocity);
    const plain goal = primal(rise);
    const auto top = search.turn(from_pull, from_velocity, true);
    plain latest = top.time;
    const plain highest =
        search.after(select(top.exists, top.time, zero), from_pull, from_velocity).displacement;
    end.exists = alive & top.exists & (highest > goal);
    if constexpr (Variant != 0) {
        // overdamped without a top: rises for ever towards the equilibrium
        const mask_of<Real> creeps =
            alive & !top.exists & (-from_pull > primal(end.stiffness) * goal);
        plain bound = search.slow_time();
        mask_of<Real> searching = creeps;
        for (int i = 0; i < 60 && any(searching); ++i) {
            const mask_of<Real> short_of =
                searching & (search.after(bound, from_pull, from_velocity).displacement < goal);
            bound = select(short_of, bound + bound, bound);
            searching = short_of;
        }
        latest = select(creeps, bound, latest);
        end.exists = end.exists | (creeps & !searching);
    }
    // together with the end of the thrust: at once
    const mask_of<Real> at_once = alive & (goal <= zero) & (from_velocity > zero);
    end.exists = end.exists | at_once;
    const mask_of<Real> rises = end.exists & !at_once;
    const plain acceleration = -fma(primal(lane.friction), from_velocity, from_pull);
    const plain square = fma(plain(2.0) * acceleration, goal, from_velocity * from_velocity);
    const plain guess = (goal + goal) / (from_velocity + sqrt(select(square > zero, square, zero)));
    const auto risen = [&](const plain& t) {
        const auto at = search.after(t, from_pull, from_velocity);
        return value_and_slope<plain>{at.displacement - goal, at.velocity};
    };
    plain root = bracketed_root<plain>(risen, {zero, latest}, guess, rises);
    root = select(rises, root, zero);
    const plain slope = search.after(root, from_pull, from_velocity).velocity;
    const Real residual = spring.after(Real(root), pull, velocity).displacement - rise;
    const Real time = select(rises, implicit_root(root, residual, slope), Real(0.0));
    end.speed = spring.after(time, pull, velocity).velocity;
    const mask_of<Real> stops = alive & !end.exists & top.exists;
    end.rise_time = sunk + select(stops, Real(top.time), time);
}

/// Thrust and decompression, up to lift-off.
template <int Variant, class Real>
HOPSCOTCH_DEVICE inline linear_lift_off<Real> push_off(const linear_lane<Real>& lane,
                                                       mask_of<Real> wanted) {
    const Real zero(0.0);
    const Real delta = lane.thrust_time;
    const auto full = friction_factors_at(lane.friction * delta);
    const Real moved = lane.lift * delta * delta * full.second;
    linear_lift_off<Real> end;
    end.is_cut = wanted & (moved > lane.depth);  // together: the thrust ends first
    end.remaining = lane.depth - moved;
    end.velocity = lane.lift * delta * full.first;
    end.thrust_time = delta;
    end.stiffness = lane.stiffness;
    end.pull = fma(-lane.stiffness, lane.slack + end.remaining, lane.gravity);
    mask_of<Real> pushes = wanted & !end.is_cut;
    if constexpr (Variant == 2) {
        const Real compressed = lane.slack + end.remaining;
        pushes = pushes & (compressed > zero);
        end.stiffness = lane.thrust / select(compressed > zero, compressed, Real(1.0));
        end.pull = lane.gravity - lane.thrust;
    }
    decompress<Variant>(lane, end, pushes);
    if constexpr (Variant != 2) conserve_energy(lane, end, moved);
    if (any(end.is_cut)) {
        const Real t = thrust_duration(lane.friction, lane.lift, lane.depth, end.is_cut);
        const Real speed = lane.lift * t * friction_factors_at(lane.friction * t).first;
        end.thrust_time = select(end.is_cut, t, end.thrust_time);
        end.rise_time = select(end.is_cut, zero, end.rise_time);
        end.speed = select(end.is_cut, speed, end.speed);
        end.exists = end.exists | end.is_cut;
    }
    return end;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::raibert
