// The planar mirror-law juggler: a bar that turns about a shoulder and mirrors the ball's angle so
// that it is hit again and again at its set point. Source: models/mirror_juggler.md, section 4;
// Rizzi and Koditschek 1994.
#pragma once

#include "kernels/mirror/planar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct mirror_planar {
    static constexpr range reach{0.0, unbounded, false, true};
    static constexpr parameter_info parameters[] = {
        {"restitution", "alpha", "1", 0.75, {0.0, 1.0, true, false}, "along the bar's normal"},
        {"gravity", "gamma", "m/s^2", 9.81, positive, "in the plane of the bar"},
        {"gain_offset", "kappa0", "1", 1.0 / 7.0, any_finite,
         "mirror gain at the target energy; (1 - alpha)/(1 + alpha) is tuned"},
        {"energy_gain", "kappa1", "s^2/m^2", 0.05824959953, any_finite,
         "gain per missing energy per mass"},
        {"target_x", "bx*", "m", 0.5, positive, "apex set point"},
        {"target_height", "bz*", "m", 0.5, positive, "apex set point"},
        {"position_gain", "kappa10", "1", 0.1, any_finite, "rad/m for the original law"},
        {"velocity_gain", "kappa11", "s", 0.08, any_finite, "rad s/m for the original law"},
        {"shoulder_radius", "r_min", "m", 0.0, non_negative,
         "horizontal distance lost at the shoulder"},
        {"bar_length", "rho_max", "m", 100.0, reach, "above shoulder_radius"},
        {"floor_height",
         "z_floor",
         "m",
         -100.0,
         {-unbounded, 0.0, false, false},
         "the ball is lost below"}};
    enum parameter_index {
        restitution,
        gravity,
        gain_offset,
        energy_gain,
        target_x,
        target_height,
        position_gain,
        velocity_gain,
        shoulder_radius,
        bar_length,
        floor_height
    };

    static constexpr column_info apex_columns[] = {
        {"bx", "m", any_finite, "horizontal distance from the shoulder"},
        {"bz", "m", any_finite, "height over the shoulder"},
        {"vx", "m/s", any_finite, "horizontal velocity"}};
    static constexpr section_info sections[] = {
        {"apex", apex_columns, 0, "highest point of a flight"}};
    static constexpr std::string_view laws[] = {"original", "solvable", "level"};
    static constexpr std::string_view energies[] = {"vertical", "total"};
    static constexpr option_info options[] = {
        {"law", laws, "Eq (12), Eq (15), or the contact heights of Eq (16)"},
        {"energy", energies, "the energy that is regulated, without or with horizontal motion"}};
    static constexpr extra_info extras[] = {
        {"flight_time", "s", "apex to impact, summed over returns"}};
    static constexpr outcome outcomes[] = {
        outcome::ok,   outcome::over_shoulder, outcome::invalid_gain, outcome::apex_below,
        outcome::fell, outcome::off_bar,       outcome::downward};
    static constexpr column_info trace_columns[] = {{"bx", "m", any_finite, "ball"},
                                                    {"bz", "m", any_finite, "ball"},
                                                    {"vx", "m/s", any_finite, "ball"},
                                                    {"vz", "m/s", any_finite, "ball"}};

    static constexpr model_info info{
        .name = "mirror_planar",
        .title = "Planar mirror-law juggler",
        .reference = "Rizzi, Koditschek, IEEE Int. Conf. Robotics and Automation, 1994",
        .time_unit = "s",
        .parameters = parameters,
        .sections = sections,
        .options = options,
        .extras = extras,
        .outcomes = outcomes,
        .trace_columns = trace_columns};

    static constexpr contact_info contact{"flight", "impact", "m", "m/s", "ball above the bar"};
    /// An impulse along the bar's normal changes the velocity by (1 + restitution) times the speed
    /// of the impact.
    static double impact_speed(const double* before, const double* after,
                               const double* parameters) {
        const double x = after[2] - before[2];
        const double z = after[3] - before[3];
        return sqrt(x * x + z * z) / (1.0 + parameters[restitution]);
    }

    /// One per law.
    static constexpr int n_variants = 3;
    static int variant(const variant_query& scene) { return scene.options[0]; }

    static constexpr std::string_view refusal(const double* parameter, const int*) {
        if (!(parameter[shoulder_radius] < parameter[bar_length])) {
            return "bar_length must be above shoulder_radius";
        }
        return {};
    }

    template <class Real>
    using lane = mirror::planar_lane<Real>;

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int, const Real* column,
                                                 const Real* p, const int* option, Watch&) {
        const Real zero(0.0);
        lane = {p[restitution],
                p[gravity],
                p[gain_offset],
                p[energy_gain],
                p[target_x],
                p[target_height],
                p[position_gain],
                p[velocity_gain],
                p[shoulder_radius],
                p[bar_length],
                p[floor_height],
                Real(option[1] == 1 ? 0.5 : 0.0),
                column[0],
                column[1],
                column[2],
                zero,
                zero,
                zero};
        const Real sum = column[0] + column[1] + column[2];
        const mask_of<Real> valid = (sum - sum == zero) & (lane.shoulder_radius < lane.bar_length);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        return mirror::planar_cycle<Variant>(lane, active, watch);
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* column) {
        column[0] = lane.x;
        column[1] = lane.z;
        column[2] = lane.speed;
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.flight_time;
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
