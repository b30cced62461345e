// Raibert's hopper on a linear spring with friction and gravity in stance: a one-dimensional map of
// touchdown speeds made of closed-form arcs. Source: Koditschek and Buehler 1991, Eq (10) and
// section 3.2; models/raibert_hopper.md, sections 3-5, 8.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/raibert/damped_spring.hpp"
#include "kernels/raibert/parameters.hpp"
#include "kernels/raibert/thrust.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// The leg's shortening since touchdown is the state of a stance, so that small impacts keep their
/// digits.
struct raibert_linear {
    static constexpr parameter_info parameters[] = {
        {"liftoff_height", "chi_l", "m", 0.5, any_finite,
         "height of the body at touchdown and lift-off"},
        {"stiffness", "eta_1", "1/s^2", 46.5, positive, "spring of the stance over body mass"},
        raibert::row::thrust,
        raibert::row::thrust_time,
        raibert::row::friction,
        raibert::row::stance_gravity,
        raibert::row::flight_gravity,
        raibert::row::leg_mass_ratio,
        {"rest_height", "chi_0", "m", 0.215, any_finite, "height at which the spring is relaxed"},
        {"thrust_gravity", "", "m/s^2", __builtin_nan(""), any_finite,
         "gravity during the thrust; where not given, stance_gravity"},
    };
    enum parameter_index {
        liftoff_height,
        stiffness,
        thrust,
        thrust_time,
        friction,
        stance_gravity,
        flight_gravity,
        leg_mass_ratio,
        rest_height,
        thrust_gravity
    };
    static constexpr column_info touchdown_columns[] = {{"touchdown_speed",
                                                         "m/s",
                                                         {0.0, unbounded, false, false},
                                                         "speed of the body at touchdown"}};
    static constexpr column_info apex_columns[] = {
        {"apex_height", "m", any_finite, "height of the body at the apex, above liftoff_height"}};
    static constexpr column_info bottom_columns[] = {
        {"bottom_height", "m", any_finite,
         "height of the body at the bottom, below liftoff_height"}};
    static constexpr section_info sections[] = {
        {"touchdown", touchdown_columns, 0, "the foot touches the ground"},
        {"apex", apex_columns, 1, "highest point of the flight"},
        {"bottom", bottom_columns, 2, "lowest point of the stance, where the thrust begins"}};
    enum section_index { at_touchdown, at_apex, at_bottom };
    static constexpr std::string_view springs[] = {"same", "preloaded"};
    static constexpr option_info options[] = {
        {"spring_after_thrust", springs,
         "spring of the decompression: the same, or one that continues the thrust's force"}};
    static constexpr extra_info extras[] = {
        {"thrust_cut", "1", "flag: a lift-off came before the end of the thrust"}};
    static constexpr outcome outcomes[] = {outcome::ok, outcome::sinks, outcome::no_liftoff,
                                           outcome::unresolved_event};
    static constexpr column_info state[] = {
        {"height", "m", any_finite, "height of the body"},
        {"velocity", "m/s", any_finite, "velocity of the body"}};
    static constexpr model_info info{
        .name = "raibert_linear",
        .title = "Vertical hopper on a linear spring",
        .reference = "Koditschek, Buehler, Int. J. Robotics Research 10(6), 1991, Eq (10)",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = options,
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = state};

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s",
                                          "foot above the ground"};
    static contact_gap gap(const double* columns, const double* parameters, const int*) {
        return {columns[0] - parameters[liftoff_height], columns[1]};
    }

    /// 0: every stance underdamped; 1: any damping; 2: any damping, spring preloaded by the thrust.
    static constexpr int n_variants = 3;
    static int variant(const variant_query& scene) {
        if (scene.options[0] == 1) return 2;
        const double gamma = scene.highest[friction];
        return gamma * gamma < 3.9 * scene.lowest[stiffness] ? 0 : 1;
    }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }

    static constexpr int n_parameter_fields = 10;
    template <class Real>
    struct lane {
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

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        lane.height = parameter[liftoff_height];
        lane.stiffness = parameter[stiffness];
        lane.friction = parameter[friction];
        lane.gravity = parameter[stance_gravity];
        lane.slack = parameter[rest_height] - parameter[liftoff_height];
        lane.thrust = parameter[thrust];
        const Real given = parameter[thrust_gravity];
        lane.lift = parameter[thrust] - select(given == given, given, lane.gravity);
        lane.thrust_time = parameter[thrust_time];
        lane.flight_gravity = parameter[flight_gravity];
        lane.leg_share = one / (one + parameter[leg_mass_ratio]);
        lane.section = Real(static_cast<double>(section));
        lane.thrust_cut = lane.time = lane.events = lane.compression = lane.pending = zero;

        const Real x = columns[0];
        const Real extent = section == at_touchdown ? x
                            : section == at_apex    ? x - lane.height
                                                    : lane.height - x;
        const mask_of<Real> valid = (extent > zero) & (extent < infinity<Real>());
        const Real safe = select(valid, extent, one);
        if (section == at_bottom) {
            lane.depth = safe;
            lane.speed = one;
            lane.square = safe * fma(lane.stiffness, safe, Real(-2.0) * pull_at_liftoff(lane));
        } else {
            lane.speed =
                section == at_touchdown ? safe : sqrt(Real(2.0) * lane.flight_gravity * safe);
            const stance_bottom<Real> bottom = compress<Variant>(lane, lane.speed);
            lane.depth = bottom.depth;
            lane.square = lane.speed * lane.speed;
            lane.compression = bottom.time;
            lane.pending = select(bottom.exists, zero, code_of<Real>(outcome::sinks));
        }
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    /// One hop. The compression after it is computed ahead: it ends a return to the bottom, and
    /// begins the next one of the other sections.
    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        const Real zero(0.0);
        const Real one(1.0);
        const bool_lane<Real> from_bottom{lane.section == Real(static_cast<double>(at_bottom))};
        const mask_of<Real> sinks = active & !(lane.pending == zero);
        const mask_of<Real> hops = active & !sinks;

        const lift_off<Real> end = push_off<Variant>(lane, hops);
        const mask_of<Real> flies = hops & end.exists;
        const Real touchdown = end.speed * lane.leg_share;
        const stance_bottom<Real> bottom = compress<Variant>(lane, touchdown);
        const mask_of<Real> sinks_next = flies & from_bottom.mask & !bottom.exists;
        const mask_of<Real> returned = flies & !sinks_next;

        if constexpr (Watch::is_active) {
            if (active)
                report_hop<Variant>(lane, end, touchdown, bottom, sinks, from_bottom.mask, watch);
        }
        const mask_of<Real> at_top = lane.section == Real(static_cast<double>(at_apex));
        const Real fall = select(at_top, lane.speed, touchdown) / lane.flight_gravity;
        const Real flight = fall + touchdown / lane.flight_gravity;
        const Real before = select(from_bottom.mask, zero, lane.compression);
        const Real after = select(from_bottom.mask & bottom.exists, bottom.time, zero);
        Real spent = before + (end.thrust_time + end.rise_time);
        spent = select(flies, spent + (flight + after), spent);
        lane.time = select(hops, lane.time + spent, lane.time);
        // bottom, end of the thrust, lift-off, touchdown
        const mask_of<Real> has_end = (lane.thrust_time > zero) & !end.is_cut;
        const Real stance_events = select(has_end, Real(2.0), one);
        const Real flight_events = select(flies, Real(2.0), zero);
        const Real happened =
            select(sinks_next, stance_events + flight_events - one, stance_events + flight_events);
        lane.events = select(hops, lane.events + happened, lane.events);
        lane.thrust_cut = select(hops & end.is_cut, one, lane.thrust_cut);

        Real ended = select(sinks | sinks_next, code_of<Real>(outcome::sinks), zero);
        ended = select(hops & !end.exists, code_of<Real>(outcome::no_liftoff), ended);
        // the apex needs the square over the gravity
        const mask_of<Real> lost =
            flies & !(touchdown * touchdown < lane.flight_gravity * Real(1e300));
        ended = select(lost, code_of<Real>(outcome::not_finite), ended);
        const mask_of<Real> moves = returned & !lost;
        lane.speed = select(moves, touchdown, lane.speed);
        lane.square = select(moves, touchdown * touchdown, lane.square);
        lane.depth = select(moves, bottom.depth, lane.depth);
        lane.compression = select(moves, bottom.time, lane.compression);
        lane.pending = select(moves & !bottom.exists, code_of<Real>(outcome::sinks), lane.pending);
        return {moves, ended};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int section, Real* columns) {
        if (section == at_touchdown)
            columns[0] = lane.speed;
        else if (section == at_apex)
            columns[0] = fma(lane.speed / (lane.flight_gravity + lane.flight_gravity), lane.speed,
                             lane.height);
        else
            columns[0] = lane.height - lane.depth;
    }
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.thrust_cut;
    }

    /// Touchdown speeds up to the fall edge; the search for traps ends there by itself.
    static bool branch(int index, const double*, map_branch& result) {
        result = {1e-6, 30.0};
        return index == 0;
    }

private:
    template <class Real>
    struct bool_lane {
        mask_of<Real> mask;
    };
    template <class Real>
    struct stance_bottom {
        mask_of<Real> exists;
        Real time, depth;
    };
    template <class Real>
    struct lift_off {
        mask_of<Real> exists, is_cut;
        Real thrust_time, rise_time;
        Real speed;                // of the body just before lift-off
        Real remaining, velocity;  // shortening and velocity at the end of the thrust
        Real stiffness, pull;      // of the decompression
    };
    template <int Variant, class Real>
    using spring_of = raibert::damped_spring<Variant == 0, Real>;

    /// Minus the acceleration of the spring and gravity at lift-off height.
    template <class Real>
    HOPSCOTCH_DEVICE static Real pull_at_liftoff(const lane<Real>& lane) {
        return fma(-lane.stiffness, lane.slack, lane.gravity);
    }

    /// From touchdown to the bottom.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static stance_bottom<Real> compress(const lane<Real>& lane,
                                                         const Real& speed) {
        const auto spring =
            spring_of<Variant, Real>::with(lane.stiffness, lane.friction * Real(0.5));
        const Real pull = pull_at_liftoff(lane);
        const auto bottom = spring.turn(pull, -speed, false);
        const Real time = select(bottom.exists, bottom.time, Real(0.0));
        return {bottom.exists, time, -spring.after(time, pull, -speed).displacement};
    }

    /// Thrust and decompression, up to lift-off.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static lift_off<Real> push_off(const lane<Real>& lane, mask_of<Real> wanted) {
        const Real zero(0.0);
        const Real delta = lane.thrust_time;
        const auto full = raibert::friction_factors_at(lane.friction * delta);
        const Real moved = lane.lift * delta * delta * full.second;
        lift_off<Real> end;
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
            const Real t =
                raibert::thrust_duration(lane.friction, lane.lift, lane.depth, end.is_cut);
            const Real speed =
                lane.lift * t * raibert::friction_factors_at(lane.friction * t).first;
            end.thrust_time = select(end.is_cut, t, end.thrust_time);
            end.rise_time = select(end.is_cut, zero, end.rise_time);
            end.speed = select(end.is_cut, speed, end.speed);
            end.exists = end.exists | end.is_cut;
        }
        return end;
    }

    /// Without friction the lift-off speed is the touchdown speed, changed by the work of the
    /// thrust: a weak thrust keeps the digits that the stance's larger energies would cost.
    template <class Real>
    HOPSCOTCH_DEVICE static void conserve_energy(const lane<Real>& lane, lift_off<Real>& end,
                                                 const Real& moved) {
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
    HOPSCOTCH_DEVICE static void decompress(const lane<Real>& lane, lift_off<Real>& end,
                                            mask_of<Real> wanted) {
        using plain = primal_of<Real>;
        const plain zero(0.0);
        const auto spring =
            spring_of<Variant, Real>::with(end.stiffness, lane.friction * Real(0.5));
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
        const auto search = spring_of<Variant, plain>::with(primal(end.stiffness),
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
        const plain guess =
            (goal + goal) / (from_velocity + sqrt(select(square > zero, square, zero)));
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

    /// Height and velocity on a spring, t after shortening d, velocity v.
    template <int Variant, class Lane>
    static void stance_state(const Lane& lane, double eta, double pull, double d, double v,
                             double t, double* columns) {
        const auto spring = spring_of<Variant, double>::with(eta, lane.friction * 0.5);
        const auto at = spring.after(t, pull, v);
        columns[0] = lane.height - d + at.displacement;
        columns[1] = at.velocity;
    }
    template <int Variant, class Lane, class Watch>
    static void report_compression(const Lane& lane, double speed, double start, double duration,
                                   Watch& watch) {
        const double at[] = {lane.height, -speed};
        watch.event("touchdown", start, "flight", "compression", at, at, 0.0);
        watch.phase("compression", start, duration, [&](double t, double* columns) {
            stance_state<Variant>(lane, lane.stiffness, pull_at_liftoff(lane), 0.0, -speed, t,
                                  columns);
        });
    }
    template <int Variant, class Lane, class Bottom, class LiftOff, class Watch>
    static void report_hop(const Lane& lane, const LiftOff& end, double touchdown,
                           const Bottom& bottom, bool sinks, bool from_bottom, Watch& watch) {
        double now = lane.time;
        if (!from_bottom) {
            if (lane.section == static_cast<double>(at_apex)) {
                const double fall = lane.speed / lane.flight_gravity;
                const double apex = lane.height + 0.5 * lane.speed * fall;
                watch.phase("flight", now, fall, [&](double t, double* columns) {
                    columns[0] = apex - 0.5 * lane.flight_gravity * t * t;
                    columns[1] = -lane.flight_gravity * t;
                });
                now += fall;
            }
            if (sinks) return;
            report_compression<Variant>(lane, lane.speed, now, lane.compression, watch);
            now += lane.compression;
        }
        const auto pushed = [&](double t, double* columns) {
            const auto at = raibert::friction_factors_at(lane.friction * t);
            columns[0] = lane.height - lane.depth + lane.lift * t * t * at.second;
            columns[1] = lane.lift * t * at.first;
        };
        const bool has_thrust = lane.thrust_time > 0.0;
        double at[2];
        pushed(0.0, at);
        watch.event("bottom", now, "compression", has_thrust ? "thrust" : "decompression", at, at,
                    0.0);
        if (has_thrust) {
            watch.phase("thrust", now, end.thrust_time, pushed);
            now += end.thrust_time;
            pushed(end.thrust_time, at);
        }
        if (!end.is_cut) {
            if (has_thrust) watch.event("thrust end", now, "thrust", "decompression", at, at, 0.0);
            watch.phase("decompression", now, end.rise_time, [&](double t, double* columns) {
                stance_state<Variant>(lane, end.stiffness, end.pull, end.remaining, end.velocity, t,
                                      columns);
            });
            now += end.rise_time;
        }
        if (!end.exists) return;
        const double before[] = {lane.height, end.speed};
        const double after[] = {lane.height, touchdown};
        watch.event("lift-off", now, end.is_cut ? "thrust" : "decompression", "flight", before,
                    after, 0.5 * (end.speed * end.speed - touchdown * touchdown));
        const double rise = touchdown / lane.flight_gravity;
        watch.phase("flight", now, lane.section == static_cast<double>(at_apex) ? rise : 2.0 * rise,
                    [&](double t, double* columns) {
                        columns[0] = lane.height + t * (touchdown - 0.5 * lane.flight_gravity * t);
                        columns[1] = touchdown - lane.flight_gravity * t;
                    });
        now += 2.0 * rise;
        if (from_bottom && bottom.exists)
            report_compression<Variant>(lane, touchdown, now, bottom.time, watch);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
