// Raibert's vertical hopper with a pneumatic leg and thrust of fixed force and time: one impact
// speed maps to the next. Without friction a hop is one scalar root and closed forms; with friction
// two integrated arcs. Source: models/raibert_hopper.md; Koditschek, Buehler, Int. J. Robotics
// Research 10(6), 1991, (7), (8).
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/pneumatic/flow.hpp"
#include "kernels/pneumatic/frictionless_arc.hpp"
#include "kernels/pneumatic/thrust.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct raibert_pneumatic {
    static constexpr parameter_info parameters[] = {
        {"liftoff_height", "chi_l", "m", 0.5, positive, "height of touchdown and lift-off"},
        {"stiffness", "eta1", "m^2/s^2", 5.81, positive,
         "spring: force eta1 / height while it compresses"},
        {"thrust", "tau", "m/s^2", 41.86, positive, "force of thrust"},
        {"thrust_time", "delta", "s", 0.01, non_negative, "duration of thrust"},
        {"friction", "gamma", "1/s", 2.33, non_negative, "viscous friction in stance"},
        {"stance_gravity", "g", "m/s^2", 10.0, non_negative, "gravity in stance"},
        {"flight_gravity", "g_f", "m/s^2", 10.0, positive, "gravity in flight"},
        {"leg_mass_ratio", "mu'", "1", 0.0, non_negative, "leg mass / body mass"}};
    enum parameter_index {
        liftoff_height,
        stiffness,
        thrust,
        thrust_time,
        friction,
        stance_gravity,
        flight_gravity,
        leg_mass_ratio
    };

    static constexpr column_info touchdown_columns[] = {
        {"touchdown_speed", "m/s", positive, "downward speed at touchdown"}};
    static constexpr column_info apex_columns[] = {
        {"apex_height", "m", positive, "height of the apex, above lift-off height"}};
    static constexpr column_info bottom_columns[] = {
        {"bottom_height", "m", positive,
         "height at the bottom, below lift-off height; thrust begins"}};
    static constexpr section_info sections[] = {
        {"touchdown", touchdown_columns, 0, "the foot touches the ground"},
        {"apex", apex_columns, 1, "top of the flight"},
        {"bottom", bottom_columns, 2, "the leg is shortest"}};
    static constexpr extra_info extras[] = {
        {"thrust_cut", "1", "1 once a lift-off cut thrust short"}};
    static constexpr outcome outcomes[] = {outcome::ok,    outcome::no_liftoff,
                                           outcome::sinks, outcome::crash,
                                           outcome::creep, outcome::unresolved_event};
    static constexpr column_info trace_columns[] = {
        {"height", "m", any_finite, "height of the body"},
        {"velocity", "m/s", any_finite, "upward velocity"}};
    static constexpr model_info info{
        .name = "raibert_pneumatic",
        .title = "Vertical hopper with a pneumatic leg and fixed thrust",
        .reference = "Koditschek, Buehler, Int. J. Robotics Research 10(6), 1991",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = {},
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = trace_columns};

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s", "foot above the ground"};
    static contact_gap gap(const double* columns, const double* parameters, const int*) {
        return {columns[0] - parameters[liftoff_height], columns[1]};
    }

    // 0: friction, integrated; 1: none, exact; 2: none, without times
    static constexpr int n_variants = 3;
    static int variant(const variant_query& scene) {
        return scene.highest[friction] > 0.0 ? 0 : scene.wants_time ? 1 : 2;
    }
    static constexpr int full_variant(int variant) { return variant == 2 ? 1 : variant; }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }

    template <class Real>
    struct lane {
        Real lift_height, stiffness, thrust, thrust_time, friction, gravity, flight_gravity,
            leg_factor;
        Real section;                  // index
        Real speed;                    // of the last touchdown
        Real bottom;                   // height of the last bottom
        Real length, depth, velocity;  // stance: chi, chi_l - chi, chi'
        Real spring;                   // eta2 while the leg extends
        Real extending;                // 1 in decompression
        Real fresh;                    // 1 at the beginning of an arc
        Real arc_time, arc_steps;
        Real was_cut;
        Real tolerance;  // of a step of the integrator
        Real
            owed;  // time from the section state to where `time` must begin: the fall from the apex
        Real time, events;
    };

    template <int Variant, class Real>
    requires(Variant == 0) HOPSCOTCH_DEVICE
        static void set_tolerance(lane<Real>& lane, double tolerance) {
        lane.tolerance = Real(taylor::tolerance_for<Real>(tolerance));
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        lane.lift_height = parameter[liftoff_height];
        lane.stiffness = parameter[stiffness];
        lane.thrust = parameter[thrust];
        lane.thrust_time = parameter[thrust_time];
        lane.friction = parameter[friction];
        lane.gravity = parameter[stance_gravity];
        lane.flight_gravity = parameter[flight_gravity];
        lane.leg_factor = one + parameter[leg_mass_ratio];
        lane.section = Real(static_cast<double>(section));
        lane.bottom = lane.length = lane.lift_height;
        lane.depth = lane.velocity = lane.extending = lane.arc_time = lane.arc_steps =
            lane.was_cut = zero;
        lane.spring = lane.thrust * lane.lift_height;
        lane.time = lane.events = lane.owed = zero;
        lane.speed = lane.fresh = one;
        if constexpr (Variant != 0)
            lane.tolerance = Real(taylor::default_tolerance<Real>);  // of a trace

        mask_of<Real> valid = (columns[0] > zero) & (columns[0] - columns[0] == zero);
        if (section == 0) {
            lane.speed = select(valid, columns[0], one);
            touch_down(lane, valid);
        } else if (section == 1) {
            const Real fall = columns[0] - lane.lift_height;
            valid = valid & (fall > zero);
            lane.speed = sqrt(Real(2.0) * lane.flight_gravity * select(valid, fall, one));
            lane.owed = lane.speed / lane.flight_gravity;
            touch_down(lane, valid);
        } else {
            valid = valid & (columns[0] < lane.lift_height);
            const Real height = select(valid, columns[0], Real(0.5) * lane.lift_height);
            lane.length = height;
            lane.depth = lane.lift_height - height;
            reach_bottom(lane, valid);
            lane.events = zero;
        }
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        // a trace needs the motion in time, which exact hops skip
        if constexpr (Variant == 0 || Watch::is_active) {
            return step_with_friction(lane, active, watch);
        } else {
            return step_without_friction<Variant == 1>(lane, active);
        }
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int section, Real* columns) {
        if (section == 0) columns[0] = lane.speed;
        if (section == 1)
            columns[0] =
                lane.lift_height + lane.speed * lane.speed / (Real(2.0) * lane.flight_gravity);
        if (section == 2) columns[0] = lane.bottom;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.was_cut;
    }

private:
    /// Below this speed a hop obeys v' = P'(0) v (page, sections 4.6 and 8.10).
    static constexpr double slowest_impact = 1e-8;
    /// A decompression longer than this, in steps or seconds, is reported as `creep`.
    static constexpr double most_arc_steps = 3000.0;
    static constexpr double longest_arc = 1e6;

    template <class Real>
    HOPSCOTCH_DEVICE static void begin_arc(lane<Real>& lane, const Real& extending,
                                           const mask_of<Real>& wanted) {
        const Real zero(0.0);
        lane.extending = select(wanted, extending, lane.extending);
        lane.fresh = select(wanted, Real(1.0), lane.fresh);
        lane.arc_time = select(wanted, zero, lane.arc_time);
        lane.arc_steps = select(wanted, zero, lane.arc_steps);
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void touch_down(lane<Real>& lane, const mask_of<Real>& wanted) {
        const Real zero(0.0);
        lane.length = select(wanted, lane.lift_height, lane.length);
        lane.depth = select(wanted, zero, lane.depth);
        lane.velocity = select(wanted, -lane.speed, lane.velocity);
        begin_arc(lane, zero, wanted);
    }
    /// At the bottom, thrust about to begin; length and depth are set.
    template <class Real>
    HOPSCOTCH_DEVICE static void reach_bottom(lane<Real>& lane, const mask_of<Real>& wanted) {
        lane.bottom = select(wanted, lane.length, lane.bottom);
        lane.velocity = select(wanted, Real(0.0), lane.velocity);
        lane.events = select(wanted, lane.events + Real(1.0), lane.events);
        begin_arc(lane, Real(1.0), wanted);
    }

    /// Reports an event that leaves height and, but for the leg's inertia, velocity as they are.
    template <class Real, class Watch>
    static void report(Watch& watch, const char* name, const lane<Real>& lane, const char* left,
                       const char* entered, const Real& velocity, const Real& after_velocity) {
        const Real before[] = {lane.length, velocity};
        const Real after[] = {lane.length, after_velocity};
        watch.event(name, lane.time, left, entered, before, after,
                    Real(0.5) * (velocity * velocity - after_velocity * after_velocity));
    }

    /// Thrust from the bottom on; lanes whose thrust is cut are at lift-off (depth 0) afterwards.
    template <class Real, class Watch>
    HOPSCOTCH_DEVICE static pneumatic::thrust_end<Real> push_off(lane<Real>& lane,
                                                                 const mask_of<Real>& wanted,
                                                                 Watch& watch) {
        const Real zero(0.0);
        const Real one(1.0);
        const auto end = pneumatic::thrust(lane.depth, lane.length, lane.thrust - lane.gravity,
                                           lane.friction, lane.thrust_time, wanted);
        if constexpr (Watch::is_active) {
            const Real net = lane.thrust - lane.gravity;
            watch.phase("thrust", lane.time, end.duration, [&](Real t, Real* columns) {
                const auto there = pneumatic::push(t, lane.friction);
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
    HOPSCOTCH_DEVICE static Real logarithmic_depth(const lane<Real>& lane) {
        const mask_of<Real> shallow = lane.depth < Real(0.5) * lane.lift_height;
        const Real share = select(shallow, lane.depth / lane.lift_height, Real(0.0));
        const Real length = select(shallow, lane.lift_height, lane.length);
        return select(shallow, -log1p(-share), log(lane.lift_height / length));
    }

    /// Square of the speed at which decompression would reach lift-off without friction; <= 0: it
    /// does not, with friction neither (page, section 4.9).
    template <class Real>
    HOPSCOTCH_DEVICE static Real liftoff_square(const lane<Real>& lane, const Real& log_depth) {
        const Real gained = fma(lane.spring, log_depth, -(lane.gravity * lane.depth));
        return fma(Real(2.0), gained, lane.velocity * lane.velocity);
    }

    /// Lift-off at `speed`, the leg's inertia, and the flight to the next touchdown. Returns the
    /// lanes whose return this completes; those counted at the apex owe the fall to their next one.
    template <class Real, class Watch>
    HOPSCOTCH_DEVICE static mask_of<Real> fly(lane<Real>& lane, const Real& speed,
                                              const mask_of<Real>& wanted, Watch& watch) {
        const Real one(1.0);
        const Real next = speed / lane.leg_factor;
        const Real rise = next / lane.flight_gravity;
        if constexpr (Watch::is_active) {
            if (wanted) {
                report(watch, "lift-off", lane,
                       lane.depth == Real(0.0) ? "thrust" : "decompression", "flight", speed, next);
                watch.phase("flight", lane.time, rise + rise, [&](Real t, Real* columns) {
                    columns[0] =
                        lane.lift_height + t * fma(Real(-0.5) * lane.flight_gravity, t, next);
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
    HOPSCOTCH_DEVICE static mask_of<Real> hop_tiny(lane<Real>& lane, const mask_of<Real>& wanted,
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
    HOPSCOTCH_DEVICE static void pay(lane<Real>& lane, const mask_of<Real>& active) {
        lane.time = select(active, lane.time + lane.owed, lane.time);
        lane.owed = select(active, Real(0.0), lane.owed);
    }

    /// A compression, or a thrust with its decompression and flight; both where the section allows.
    template <bool IsTimed, class Real>
    HOPSCOTCH_DEVICE static progress<Real> step_without_friction(lane<Real>& lane,
                                                                 const mask_of<Real>& active) {
        const Real zero(0.0);
        unwatched watch;
        pay(lane, active);
        const mask_of<Real> compresses = active & !(lane.extending > zero);
        mask_of<Real> returned = hop_tiny(lane, compresses, watch);
        const mask_of<Real> falls = compresses & !returned;
        if (any(falls)) {
            const Real x = pneumatic::bottom_depth(lane.stiffness, lane.gravity * lane.lift_height,
                                                   lane.speed, falls);
            lane.length = select(falls, lane.lift_height * exp(-x), lane.length);
            lane.depth = select(falls, -(lane.lift_height * expm1(-x)), lane.depth);
            if constexpr (IsTimed) {
                const Real duration = pneumatic::arc_duration(x, zero, lane.stiffness, lane.gravity,
                                                              lane.lift_height);
                lane.time = select(falls, lane.time + duration, lane.time);
            }
            reach_bottom(lane, falls);
        }
        const mask_of<Real> at_bottom = falls & (lane.section == Real(2.0));
        const mask_of<Real> pushes = active & !returned & !at_bottom;
        const auto end = push_off(lane, pushes, watch);
        const Real log_depth = logarithmic_depth(lane);
        const Real square = liftoff_square(lane, log_depth);
        const mask_of<Real> lifts =
            pushes & !end.crashes & (end.cut | ((square > zero) & (lane.thrust > lane.gravity)));
        if constexpr (IsTimed) {
            const Real duration =
                pneumatic::arc_duration(log_depth, lane.velocity * lane.velocity, lane.spring,
                                        lane.gravity, lane.lift_height);
            lane.time = select(lifts & !end.cut, lane.time + duration, lane.time);
        }
        const Real speed = select(end.cut, lane.velocity, sqrt(select(lifts, square, Real(1.0))));
        Real ended = select(pushes & !lifts, code_of<Real>(outcome::no_liftoff), zero);
        ended = select(pushes & end.crashes, code_of<Real>(outcome::crash), ended);
        const mask_of<Real> lost = pushes & !end.crashes & !(square == square);
        ended = select(lost, code_of<Real>(outcome::not_finite), ended);
        returned = returned | at_bottom | fly(lane, speed, lifts & !lost, watch);
        return {returned, ended};
    }

    /// Slow impacts on an overdamped leg creep towards the equilibrium and have no bottom
    /// (section 4.10).
    template <class Real>
    HOPSCOTCH_DEVICE static mask_of<Real> sinks(const lane<Real>& lane,
                                                const mask_of<Real>& compresses) {
        const Real zero(0.0);
        const mask_of<Real> soft = compresses & (lane.stiffness < lane.gravity * lane.lift_height);
        const Real root = fma(lane.friction, lane.friction,
                              -(Real(4.0) * lane.gravity * lane.gravity / lane.stiffness));
        const mask_of<Real> overdamped = soft & (root >= zero);
        const Real above = lane.length - lane.stiffness / select(soft, lane.gravity, Real(1.0));
        const Real slope = Real(0.5) * (lane.friction + sqrt(select(overdamped, root, zero)));
        return overdamped & (above > zero) & (-lane.velocity <= slope * above);
    }

    /// One integrator step of an arc; thrust is taken at the beginning of decompression.
    template <class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step_with_friction(lane<Real>& lane,
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
        const mask_of<Real> fails =
            extends & !((liftoff_square(lane, logarithmic_depth(lane)) > zero) &
                        (lane.thrust > lane.gravity));
        const mask_of<Real> stays = sinks(lane, compresses);
        const mask_of<Real> flows = (extends & !fails) | (compresses & !stays);

        const pneumatic::arc_state<Real> from{lane.length, lane.depth, lane.velocity};
        const auto a =
            pneumatic::expand(from, select(lane.extending > zero, lane.spring, lane.stiffness),
                              lane.friction, lane.gravity);
        const plain horizon = pneumatic::step_of(a, lane.tolerance);
        const Real still = select(extends & (lane.velocity == zero), one, zero);
        // each arc ends at its own guard: the bottom, or lift-off; an extension may also turn first
        taylor::series<Real> ending;
        for (int n = 0; n <= taylor::order<Real>; ++n)
            ending.c[n] = select(extends, a.depth.c[n], -a.velocity.c[n]);
        const auto end = taylor::first_zero(ending, horizon, flows);
        const auto falls_back =
            taylor::first_zero(taylor::without_zeros(a.velocity, still), horizon, flows & extends);
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
                report(watch, "touchdown", lane, "flight", "compression", lane.velocity,
                       lane.velocity);
            }
            if (flows) {
                watch.phase(compresses ? "compression" : "decompression", lane.time, passed,
                            [&](Real t, Real* columns) {
                                const auto there = a.at_time(t, s);
                                columns[0] = there.length;
                                columns[1] = there.velocity;
                            });
            }
        }
        lane.length = select(flows, taylor::evaluate(a.length, s), lane.length);
        lane.depth = select(flows, taylor::evaluate(a.depth, s), lane.depth);
        lane.velocity = select(flows, taylor::evaluate(a.velocity, s), lane.velocity);
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
        returned = returned | fly(lane, lane.velocity, lifts, watch) |
                   (bottoms & (lane.section == Real(2.0)));
        Real ended = select(fails | (turns & extends), code_of<Real>(outcome::no_liftoff), zero);
        ended = select(stays, code_of<Real>(outcome::sinks), ended);
        ended = select(crashes, code_of<Real>(outcome::crash), ended);
        ended = select(creeps, code_of<Real>(outcome::creep), ended);
        ended = select(lost, code_of<Real>(outcome::unresolved_event), ended);
        ended = select(broken, code_of<Real>(outcome::not_finite), ended);
        returned = returned & (ended == zero);
        return {returned, ended};
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
