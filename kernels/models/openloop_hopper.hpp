// The clock-driven (open-loop) vertical hopper: a point mass on a massless leg with spring and
// damper, pushed by a thrust that a clock turns on and off, whatever the body does. Source:
// models/openloop_hopper.md; Cham and Cutkosky 2007.
#pragma once

#include "kernels/openloop/clocked_hop.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct openloop_hopper {
    static constexpr parameter_info parameters[] = {
        {"natural_frequency", "w", "rad/s", 30.0, positive, "undamped natural frequency sqrt(k/m)"},
        {"damping_ratio", "zeta", "1", 0.2, non_negative, "b / (2 m w)"},
        {"thrust", "Tn", "1", 1.55, non_negative, "thrust over body weight"},
        {"thrust_time", "t_on", "s", 0.08, positive, "duration of the thrust, below stride_period"},
        {"stride_period", "tau", "s", 0.26, positive, "period of the clock"}};
    enum parameter_index { natural_frequency, damping_ratio, thrust, thrust_time, stride_period };

    static constexpr column_info strobe_columns[] = {
        {"height", "s^2", any_finite,
         "y = h/g over leg-rest contact, at t = 0+; on the ground where <= 0"},
        {"velocity", "s", any_finite, "v = dy/dt"}};
    static constexpr column_info landing_columns[] = {
        {"clock_phase", "s", non_negative, "time since thrust activation, below stride_period"},
        {"velocity", "s", {-unbounded, 0.0, false, false}, "v = dy/dt, downward"}};
    static constexpr column_info takeoff_columns[] = {
        {"clock_phase", "s", non_negative, "time since thrust activation, below stride_period"},
        {"velocity", "s", positive, "v = dy/dt, upward"}};
    static constexpr section_info sections[] = {
        {"strobe", strobe_columns, openloop::strobe, "every thrust activation, t = 0+"},
        {"landing", landing_columns, openloop::landing, "the leg touches down"},
        {"takeoff", takeoff_columns, openloop::takeoff, "the leg leaves the ground"}};

    static constexpr std::string_view guards[] = {"length", "force"};
    static constexpr option_info options[] = {
        {"takeoff_guard", guards,
         "take-off at the leg's rest length, or already at zero ground force"}};
    static constexpr event_letter letters[] = {
        {"take-off", 'T'}, {"landing", 'L'}, {"thrust off", '-'}, {"thrust on", '+'}};
    static constexpr extra_info extras[] = {
        {"event_word", "", "letters of take-off, landing, thrust off and thrust on", letters},
        {"hops", "1", "take-offs, summed over returns"},
        {"work", "s^2", "work of the thrust over weight and g, summed over returns"}};
    static constexpr outcome outcomes[] = {outcome::ok, outcome::no_hop};
    static constexpr column_info trace_columns[] = {
        {"height", "s^2", any_finite, "y = h/g over leg-rest contact"},
        {"velocity", "s", any_finite, "v = dy/dt"},
        {"clock_phase", "s", any_finite, "time since thrust activation"},
        {"ground_force", "1", any_finite, "ground reaction over weight"}};

    static constexpr model_info info{
        .name = "openloop_hopper",
        .title = "Clock-driven vertical hopper",
        .reference = "Cham, Cutkosky, ASME J. Dyn. Sys. Meas. Control 129, 2007",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = options,
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = trace_columns};

    static constexpr contact_info contact{"air", "landing", "s^2", "s", "foot above the ground"};
    static contact_gap gap(const double* columns, const double*, const int*) {
        return {columns[0], columns[1]};
    }

    /// 0, 1: length guard, damping ratio below 1 everywhere or anywhere; 2, 3: force guard.
    static constexpr int n_variants = 4;
    static int variant(const variant_query& scene) {
        const int creeps = scene.highest[damping_ratio] < 1.0 ? 0 : 1;
        return 2 * scene.options[0] + creeps;
    }
    template <int Variant>
    using terms = openloop::terms<(Variant >= 2), (Variant % 2 == 1)>;

    static constexpr std::string_view refusal(const double* parameter, const int*) {
        if (!(parameter[thrust_time] < parameter[stride_period])) {
            return "thrust_time must be below stride_period";
        }
        return {};
    }
    /// The clock's phase wraps.
    static constexpr double turn(int section, int column, const double* parameter) {
        return section != openloop::strobe && column == 0 ? parameter[stride_period] : 0.0;
    }

    static constexpr int n_parameter_fields = 8;
    template <class Real>
    using lane = openloop::hopper_lane<Real>;

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int section, const Real* columns,
                                                 const Real* parameter, const int*, Watch&) {
        const Real zero(0.0);
        set_parameters(lane, section, parameter);
        mask_of<Real> valid = is_finite(columns[0]) & is_finite(columns[1]) &
                              (lane.off_time > zero) & (lane.on_time > zero);
        if (section != openloop::strobe) {
            const Real direction(section == openloop::landing ? -1.0 : 1.0);
            valid = valid & (columns[0] >= zero) & (columns[0] < parameter[stride_period]) &
                    (columns[1] * direction > zero);
        }
        const mask_of<Real> every = valid | !valid;
        place<Variant>(lane, section, columns, every);
        lane.first_column = columns[0];
        lane.second_column = columns[1];
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        return openloop::advance<terms<Variant>>(lane, active, watch);
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* columns) {
        columns[0] = lane.first_column;
        columns[1] = lane.second_column;
    }

    /// The word is made of the events that a Watch sees; its number is 0 here.
    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = Real(0.0);
        extra[1] = lane.hops;
        extra[2] = lane.work;
    }

private:
    template <class Real>
    HOPSCOTCH_DEVICE static mask_of<Real> is_finite(const Real& x) {
        return x - x == Real(0.0);
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void set_parameters(lane<Real>& lane, int section,
                                                const Real* parameter) {
        const Real zero(0.0);
        const Real w = parameter[natural_frequency];
        lane.angular_frequency = w;
        lane.damping = parameter[damping_ratio];
        lane.thrust = parameter[thrust];
        lane.on_time = parameter[thrust_time] * w;
        lane.off_time = (parameter[stride_period] - parameter[thrust_time]) * w;
        lane.thrust_seconds = parameter[thrust_time];
        lane.period_seconds = parameter[stride_period];
        lane.section = Real(static_cast<double>(section));
        lane.height = lane.velocity = lane.leg = lane.airborne = zero;
        lane.flight_left = lane.landing_speed = zero;
        lane.settled_height = lane.settled_velocity = lane.settled = zero;
        lane.cycle_start = lane.time = lane.events = lane.hops = lane.work = zero;
    }

    /// Puts the body on its start and decides its mode (page, sections 3 and 3.2). A landing starts
    /// at rest length; a take-off under the force guard where its ground force vanishes, or at rest
    /// length.
    template <int Variant, class Real>
    HOPSCOTCH_DEVICE static void place(lane<Real>& lane, int section, const Real* columns,
                                       const mask_of<Real>& every) {
        const Real zero(0.0);
        const Real one(1.0);
        const Real w = lane.angular_frequency;
        lane.velocity = columns[1] * w;
        lane.thrust_on = one;
        lane.until_edge = lane.on_time;
        mask_of<Real> flies = every & !every;
        if (section == openloop::strobe) {
            lane.height = columns[0] * w * w;
            flies = (lane.height > zero) | ((lane.height == zero) & (lane.velocity > zero));
        } else {
            const mask_of<Real> is_on = columns[0] <= lane.thrust_seconds;
            lane.thrust_on = select(is_on, one, zero);
            const Real end = select(is_on, lane.thrust_seconds, lane.period_seconds);
            lane.until_edge = (end - columns[0]) * w;
            lane.cycle_start = -columns[0];
            if (section == openloop::takeoff) {
                flies = every;
                if constexpr (terms<Variant>::has_force_guard) {
                    const Real force = openloop::active_thrust(lane);
                    const Real released = force - Real(2.0) * lane.damping * lane.velocity;
                    lane.height = lane.leg = smaller(released, zero);
                }
            }
        }
        if constexpr (terms<Variant>::has_force_guard) {
            lane.airborne = select(flies, one, zero);
        } else {
            openloop::launch(lane, flies);
        }
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
