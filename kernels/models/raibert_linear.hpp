// Raibert's hopper on a linear spring with friction and gravity in stance: a one-dimensional map of
// touchdown speeds made of closed-form arcs. Source: Koditschek and Buehler 1991, Eq (10) and
// section 3.2; models/raibert_hopper.md, sections 3-5, 8.
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/raibert/linear_stance.hpp"
#include "kernels/raibert/linear_trace.hpp"
#include "kernels/raibert/parameters.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

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
    using lane = raibert::linear_lane<Real>;

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
            lane.square =
                safe * fma(lane.stiffness, safe, Real(-2.0) * raibert::pull_at_liftoff(lane));
        } else {
            lane.speed =
                section == at_touchdown ? safe : sqrt(Real(2.0) * lane.flight_gravity * safe);
            const raibert::stance_bottom<Real> bottom =
                raibert::compress<Variant>(lane, lane.speed);
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
        const mask_of<Real> from_bottom = lane.section == Real(static_cast<double>(at_bottom));
        const mask_of<Real> sinks = active & !(lane.pending == zero);
        const mask_of<Real> hops = active & !sinks;

        const raibert::linear_lift_off<Real> end = raibert::push_off<Variant>(lane, hops);
        const mask_of<Real> flies = hops & end.exists;
        const Real touchdown = end.speed * lane.leg_share;
        const raibert::stance_bottom<Real> bottom = raibert::compress<Variant>(lane, touchdown);
        const mask_of<Real> sinks_next = flies & from_bottom & !bottom.exists;
        const mask_of<Real> returned = flies & !sinks_next;

        if constexpr (Watch::is_active) {
            const bool to_apex = lane.section == Real(static_cast<double>(at_apex));
            if (active) {
                raibert::report_hop<Variant>(lane, end, touchdown, bottom, sinks, from_bottom,
                                             to_apex, watch);
            }
        }
        const mask_of<Real> at_top = lane.section == Real(static_cast<double>(at_apex));
        const Real fall = select(at_top, lane.speed, touchdown) / lane.flight_gravity;
        const Real flight = fall + touchdown / lane.flight_gravity;
        const Real before = select(from_bottom, zero, lane.compression);
        const Real after = select(from_bottom & bottom.exists, bottom.time, zero);
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
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
