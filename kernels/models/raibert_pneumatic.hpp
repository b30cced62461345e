// Raibert's vertical hopper with a pneumatic leg and thrust of fixed force and time: one impact
// speed maps to the next. Without friction a hop is one scalar root and closed forms; with friction
// two integrated arcs. Source: models/raibert_hopper.md; Koditschek, Buehler, Int. J. Robotics
// Research 10(6), 1991, (7), (8).
#pragma once

#include "kernels/contract/model.hpp"
#include "kernels/pneumatic/exact_hop.hpp"
#include "kernels/pneumatic/integrated_hop.hpp"
#include "kernels/raibert/parameters.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct raibert_pneumatic {
    static constexpr parameter_info parameters[] = {
        {"liftoff_height", "chi_l", "m", 0.5, positive, "height of touchdown and lift-off"},
        {"stiffness", "eta1", "m^2/s^2", 5.81, positive,
         "spring: force eta1 / height while it compresses"},
        raibert::row::thrust,
        raibert::row::thrust_time,
        raibert::row::friction,
        raibert::row::stance_gravity,
        raibert::row::flight_gravity,
        raibert::row::leg_mass_ratio,
    };
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

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s",
                                          "foot above the ground"};
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

    static constexpr int n_parameter_fields = 9;
    template <class Real>
    using lane = pneumatic::hopper_lane<Real>;

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
            pneumatic::touch_down(lane, valid);
        } else if (section == 1) {
            const Real fall = columns[0] - lane.lift_height;
            valid = valid & (fall > zero);
            lane.speed = sqrt(Real(2.0) * lane.flight_gravity * select(valid, fall, one));
            lane.owed = lane.speed / lane.flight_gravity;
            pneumatic::touch_down(lane, valid);
        } else {
            valid = valid & (columns[0] < lane.lift_height);
            const Real height = select(valid, columns[0], Real(0.5) * lane.lift_height);
            lane.length = height;
            lane.depth = lane.lift_height - height;
            pneumatic::reach_bottom(lane, valid);
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
            return pneumatic::step_with_friction(lane, active, watch);
        } else {
            return pneumatic::step_without_friction<Variant == 1>(lane, active);
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
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
