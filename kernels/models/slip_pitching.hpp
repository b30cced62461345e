// The spring-mass runner with a body that pitches: the leg is hinged at a hip away from the centre
// of mass and is reset in flight to a fixed angle in space or relative to the body. Four state
// columns; the energy, not the speed, is conserved. Source: models/slip.md section 6; Ghigliazza,
// Altendorfer, Holmes, Koditschek, SIAM Review 47 (2005) 519-549.
#pragma once

#include "kernels/spring_leg/pitching_flight.hpp"
#include "kernels/spring_leg/pitching_lane.hpp"
#include "kernels/spring_leg/pitching_stance.hpp"
#include "kernels/spring_leg/pitching_trace.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct slip_pitching {
    static constexpr parameter_info parameters[] = {
        {"mass", "m", "kg", 1.0, positive, "mass of the body"},
        {"leg_length", "eta0", "m", 1.5, positive, "rest length of the leg"},
        {"stiffness", "k, c", "N/m or N m^3", 100.0, positive,
         "linear: k, force k (eta0 - eta); air: c, force c / eta^3"},
        {"gravity", "g", "m/s^2", 9.81, positive, "gravitational acceleration"},
        {"touchdown_angle",
         "beta",
         "rad",
         1.25,
         {0.0, 0x1.921fb54442d18p+0, false, false},
         "leg above the horizontal at touchdown (of a body at pitch 0), in (0, pi/2)"},
        {"hip_offset", "d", "m", 0.015, any_finite, "height of the hip above the centre of mass"},
        {"inertia", "I", "kg m^2", 0.0225, positive, "moment of inertia about the centre of mass"}};
    enum parameter_index {
        mass,
        leg_length,
        stiffness,
        gravity,
        touchdown_angle,
        hip_offset,
        inertia
    };

    static constexpr column_info touchdown_columns[] = {
        {"speed", "m/s", positive, "v, speed of the centre of mass at touchdown"},
        {"angle",
         "rad",
         {-0x1.921fb54442d18p+1, 0x1.921fb54442d18p+1},
         "delta, its velocity below the horizontal"},
        {"pitch", "rad", any_finite, "theta, the body's angle, counterclockwise, not wrapped"},
        {"pitch_rate", "rad/s", any_finite, "theta'"}};
    static constexpr section_info sections[] = {
        {"touchdown", touchdown_columns, 0, "the foot touches the ground"}};
    static constexpr std::string_view springs[] = {"linear", "air"};
    static constexpr std::string_view placements[] = {"inertial", "body"};
    static constexpr option_info options[] = {{"spring", springs, "force law of the leg"},
                                              {"leg_placement", placements,
                                               "what the leg's touchdown angle is fixed to: the "
                                               "ground (beta) or the body (beta - theta)"}};
    static constexpr outcome outcomes[] = {
        outcome::ok,      outcome::no_contact, outcome::ground,          outcome::no_liftoff,
        outcome::stumble, outcome::reverse,    outcome::unresolved_event};
    static constexpr column_info trace_columns[] = {
        {"x", "m", any_finite, "centre of mass, forward of the foothold of the phase"},
        {"y", "m", any_finite, "height of the centre of mass"},
        {"x_rate", "m/s", any_finite, "forward velocity"},
        {"y_rate", "m/s", any_finite, "upward velocity"},
        {"pitch", "rad", any_finite, "angle of the body, counterclockwise"},
        {"pitch_rate", "rad/s", any_finite, "its rate"}};
    static constexpr model_info info{
        .name = "slip_pitching",
        .title = "Spring-loaded inverted pendulum with a pitching body",
        .reference = "Ghigliazza, Altendorfer, Holmes, Koditschek, SIAM Review 47(3), 2005",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = options,
        .extras = {},
        .outcomes = outcomes,
        .trace_columns = trace_columns};

    static constexpr contact_info contact{"flight", "touchdown", "m", "m/s",
                                          "foot of the leg as it will land, above the ground"};
    static contact_gap gap(const double* columns, const double* parameters, const int* options) {
        const double turns = options[1] == 1 ? 1.0 : 0.0;  // with the body, or stays
        const double pitch = columns[4];
        const double rate = columns[5];
        const auto body = sin_cos(pitch);
        const auto leg = sin_cos(parameters[touchdown_angle] - turns * pitch);
        const double length = parameters[leg_length];
        const double hip = parameters[hip_offset];
        return {columns[1] + hip * body.cos - length * leg.sin,
                columns[3] + rate * (turns * length * leg.cos - hip * body.sin)};
    }

    // The placement of the leg is three numbers in the lane and costs nothing, so it is no variant.
    static constexpr int n_variants = 2;
    static int variant(const variant_query& scene) { return scene.options[0]; }
    static constexpr std::string_view refusal(const double*, const int*) { return {}; }
    template <int Variant>
    static constexpr bool has_air_spring = Variant == 1;

    template <class Real>
    using lane = spring_leg::pitching_runner<Real>;

    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static void set_tolerance(lane<Real>& lane, double tolerance) {
        lane.tolerance = Real(taylor::tolerance_for<Real>(tolerance));
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int, const Real* columns,
                                                 const Real* parameter, const int* options,
                                                 Watch&) {
        const Real zero(0.0);
        const Real one(1.0);
        take_parameters<has_air_spring<Variant>>(lane, parameter, options);
        lane.speed = columns[0];
        lane.angle = columns[1];
        lane.pitch = columns[2];
        lane.pitch_rate = columns[3];
        lane.time = lane.events = zero;
        lane.x = lane.y = lane.x_rate = lane.y_rate = lane.turn = lane.turn_rate = zero;
        lane.in_stance = lane.elapsed = zero;
        lane.untouched = lane.length = one;
        const Real speed = lane.speed / lane.speed_unit;
        lane.energy = fma(
            Real(0.5) * speed, speed,
            spring_leg::energy_beside_speed(lane, lane.pitch, lane.pitch_rate * lane.time_unit));
        const mask_of<Real> finite =
            (lane.energy - lane.energy == zero) & (lane.angle - lane.angle == zero);
        const mask_of<Real> valid = finite & (lane.speed > zero);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        using namespace spring_leg;
        constexpr bool is_air = has_air_spring<Variant>;
        const Real zero(0.0);
        const Real one(1.0);
        const mask_of<Real> starts = active & (lane.in_stance == zero);
        if (any(starts)) touch_down(lane, starts);
        lane.untouched = select(active, select(starts, one, zero), lane.untouched);

        pitching_series<Real> a;
        begin_step(a, lane);
        const Real swing = lane.hip * lane.turn_rate;
        const Real hip_x_rate = fma(-swing, a.cos.c[0], lane.x_rate);
        const Real hip_y_rate = fma(-swing, a.sin.c[0], lane.y_rate);
        const Real closing = -fma(lane.x, hip_x_rate, lane.y * hip_y_rate);
        const mask_of<Real> misses = starts & !(closing > zero);
        const mask_of<Real> moves = active & !misses;
        if constexpr (is_air) {
            expand_air(a, lane);
        } else {
            expand_linear(a, lane);
        }
        const pitching_step<Real> step = advance<is_air>(a, lane, closing, moves);
        const Real s = step.length_of_step;
        const Real passed = is_air ? s : taylor::evaluate(a.time, s);
        if constexpr (Watch::is_active) {
            const Real began = fma(lane.elapsed, lane.time_unit, lane.time);
            if (moves) pitching_reporter<is_air, Watch>{watch}.stance(lane, a, s, began, passed);
        }
        follow(lane, a, s, passed, moves);

        const mask_of<Real> lifts = moves & step.lifts;
        const mask_of<Real> grounds = moves & step.grounds;
        const mask_of<Real> hangs =
            moves & !lifts & !grounds & (lane.elapsed > Real(longest_stance));
        const mask_of<Real> leaves = lifts | grounds | hangs;
        lane.in_stance = select(leaves | misses, zero, select(moves, one, lane.in_stance));
        lane.time = select(leaves, fma(lane.elapsed, lane.time_unit, lane.time), lane.time);
        lane.events = select(lifts | grounds, lane.events + one, lane.events);
        if constexpr (Watch::is_active) {
            pitching_reporter<is_air, Watch> report{watch};
            if (grounds) report.event("ground", lane, lane.time, "stance", "ground");
            if (lifts) report.event("lift-off", lane, lane.time, "stance", "flight");
        }
        Real ended = select(misses, code_of<Real>(outcome::no_contact), zero);
        ended = select(grounds, code_of<Real>(outcome::ground), ended);
        ended = select(hangs, code_of<Real>(outcome::no_liftoff), ended);
        ended = select(moves & step.unresolved, code_of<Real>(outcome::unresolved_event), ended);
        ended = select(moves & step.broken, code_of<Real>(outcome::not_finite), ended);
        const mask_of<Real> flies = lifts & (ended == zero);
        if (any(flies)) ended = ended + fly<is_air>(lane, flies, watch);
        const mask_of<Real> completed = lifts & (ended == zero);
        return {completed, ended};
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* columns) {
        columns[0] = lane.speed;
        columns[1] = lane.angle;
        columns[2] = lane.pitch;
        columns[3] = lane.pitch_rate;
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>&, Real*) {}

private:
    /// Longest stance, in units of sqrt(leg length / g); beyond it there is `no_liftoff`.
    static constexpr double longest_stance = 1e4;

    template <bool IsAir, class Real>
    HOPSCOTCH_DEVICE static void take_parameters(lane<Real>& lane, const Real* parameter,
                                                 const int* options) {
        const Real zero(0.0);
        const auto leg = sin_cos(parameter[touchdown_angle]);
        const bool is_body = options[1] == 1;
        lane.leg = parameter[leg_length];
        lane.time_unit = sqrt(lane.leg / parameter[gravity]);
        lane.speed_unit = sqrt(lane.leg * parameter[gravity]);
        const Real square = lane.leg * lane.leg;
        const Real weight = parameter[mass] * parameter[gravity];
        if constexpr (IsAir) {
            lane.stiffness = parameter[stiffness] / (weight * (square * lane.leg));
        } else {
            lane.stiffness = parameter[stiffness] * lane.leg / weight;
        }
        lane.hip = parameter[hip_offset] / lane.leg;
        lane.inertia = parameter[inertia] / (parameter[mass] * square);
        lane.beta = parameter[touchdown_angle];
        // required height: sin beta, or sin(beta - pitch)
        lane.body = Real(is_body ? 1.0 : 0.0);
        lane.swing_cos = is_body ? lane.hip - leg.sin : lane.hip;
        lane.swing_sin = is_body ? leg.cos : zero;
        lane.level = is_body ? zero : leg.sin;
    }

    /// Puts a lane from its section state on its new foothold.
    template <class Real>
    HOPSCOTCH_DEVICE static void touch_down(lane<Real>& lane, const mask_of<Real>& starts) {
        const auto leg = sin_cos(fma(-lane.body, lane.pitch, lane.beta));
        const auto velocity = sin_cos(lane.angle);
        const Real speed = lane.speed / lane.speed_unit;
        lane.x = select(starts, -leg.cos, lane.x);
        lane.y = select(starts, leg.sin, lane.y);
        lane.x_rate = select(starts, speed * velocity.cos, lane.x_rate);
        lane.y_rate = select(starts, -(speed * velocity.sin), lane.y_rate);
        lane.turn = select(starts, lane.pitch, lane.turn);
        lane.turn_rate = select(starts, lane.pitch_rate * lane.time_unit, lane.turn_rate);
        lane.length = select(starts, Real(1.0), lane.length);
        lane.elapsed = select(starts, Real(0.0), lane.elapsed);
    }

    /// Moves a lane to the end of its step.
    template <class Real>
    HOPSCOTCH_DEVICE static void follow(lane<Real>& lane,
                                        const spring_leg::pitching_series<Real>& a, const Real& s,
                                        const Real& passed, const mask_of<Real>& moves) {
        lane.x = select(moves, taylor::evaluate(a.x, s), lane.x);
        lane.y = select(moves, taylor::evaluate(a.y, s), lane.y);
        lane.x_rate = select(moves, taylor::evaluate(a.x_rate, s), lane.x_rate);
        lane.y_rate = select(moves, taylor::evaluate(a.y_rate, s), lane.y_rate);
        lane.turn = select(moves, taylor::evaluate(a.turn, s), lane.turn);
        lane.turn_rate = select(moves, taylor::evaluate(a.turn_rate, s), lane.turn_rate);
        lane.length = select(moves, taylor::evaluate(a.length, s), lane.length);
        lane.elapsed = select(moves, lane.elapsed + passed, lane.elapsed);
    }

    /// The flight of lanes that have just lifted off; books the new touchdown and returns the
    /// outcome's code. The new speed is taken from the conserved energy, so that nothing drifts
    /// (page, section 13, case 8).
    template <bool IsAir, class Real, class Watch>
    HOPSCOTCH_DEVICE static Real fly(lane<Real>& lane, const mask_of<Real>& flies, Watch& watch) {
        using namespace spring_leg;
        const Real zero(0.0);
        const Real centre = fma(-lane.hip, cos(lane.turn), lane.y);
        const foot_height<Real> foot{centre,         lane.y_rate,    lane.turn, lane.turn_rate,
                                     lane.swing_cos, lane.swing_sin, lane.level};
        const touchdown_search<Real> contact = first_touchdown(foot, flies);
        const mask_of<Real> lands = flies & contact.found;
        if constexpr (Watch::is_active) {
            if (lands) pitching_reporter<IsAir, Watch>{watch}.flight(lane, lane.time, contact.time);
        }
        const Real fall = lane.y_rate - contact.time;
        const Real pitch = fma(lane.turn_rate, contact.time, lane.turn);
        const Real motion = lane.energy - energy_beside_speed(lane, pitch, lane.turn_rate);
        const Real flown = fma(lane.x_rate, lane.x_rate, fall * fall);
        const Real square = select(motion > zero, motion + motion, flown);
        lane.speed = select(lands, sqrt(square) * lane.speed_unit, lane.speed);
        lane.angle = select(lands, atan2(-fall, lane.x_rate), lane.angle);
        lane.pitch = select(lands, pitch, lane.pitch);
        lane.pitch_rate = select(lands, lane.turn_rate / lane.time_unit, lane.pitch_rate);
        lane.time = select(lands, fma(contact.time, lane.time_unit, lane.time), lane.time);
        lane.events = select(lands, lane.events + Real(1.0), lane.events);
        const mask_of<Real> reverses = lands & (lane.x_rate <= zero);
        const mask_of<Real> stumbles = flies & !contact.found & !contact.unresolved;
        Real ended = select(reverses, code_of<Real>(outcome::reverse), zero);
        ended = select(stumbles, code_of<Real>(outcome::stumble), ended);
        return select(flies & contact.unresolved, code_of<Real>(outcome::unresolved_event), ended);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
