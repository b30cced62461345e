// The spatial mirror-law juggler: a paddle on a three-joint arm that follows the ball's azimuth,
// mirrors its elevation and rolls to steer it. Source: models/mirror_juggler.md, section 5; Rizzi
// and Koditschek 1994.
#pragma once

#include "kernels/mirror/spatial.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

struct mirror_spatial {
    static constexpr range reach{0.0, unbounded, false, true};
    static constexpr parameter_info parameters[] = {
        {"restitution", "alpha", "1", 0.75, {0.0, 1.0, true, false}, "along the paddle's normal"},
        {"gravity", "gamma", "m/s^2", 9.81, positive, ""},
        {"gain_offset", "kappa0", "1", 1.0 / 7.0, any_finite,
         "mirror gain at the target energy; (1 - alpha)/(1 + alpha) is tuned"},
        {"energy_gain", "kappa1", "s^2/m^2", 0.05824959953, any_finite,
         "gain per missing energy per mass"},
        {"target_radius", "r*", "m", 0.5, positive, "apex set point"},
        {"target_azimuth", "phi*", "rad", 0.0, any_finite, "apex set point"},
        {"target_height", "bz*", "m", 0.5, positive, "apex set point"},
        {"radial_gain", "kr0", "1", 0.1, any_finite, "rad/m for the original law"},
        {"radial_rate_gain", "kr1", "s", 0.08, any_finite, "rad s/m for the original law"},
        {"lateral_gain", "kl0", "1", 0.1, any_finite, "roll per azimuth"},
        {"lateral_rate_gain", "kl1", "s", 0.08, any_finite, "roll per azimuth rate"},
        {"shoulder_radius", "r_min", "m", 0.01, positive,
         "horizontal distance lost at the shoulder"},
        {"bar_length", "rho_max", "m", 100.0, reach, "of the arm, above shoulder_radius"},
        {"floor_height",
         "z_floor",
         "m",
         -100.0,
         {-unbounded, 0.0, false, false},
         "the ball is lost below"}};
    enum parameter_index { restitution = 0, shoulder_radius = 11, bar_length = 12 };

    static constexpr column_info apex_columns[] = {
        {"bx", "m", any_finite, "ball, from the shoulder"},
        {"by", "m", any_finite, "ball, from the shoulder"},
        {"bz", "m", any_finite, "height over the shoulder"},
        {"vx", "m/s", any_finite, "horizontal velocity"},
        {"vy", "m/s", any_finite, "horizontal velocity"}};
    static constexpr section_info sections[] = {
        {"apex", apex_columns, 0, "highest point of a flight"}};
    static constexpr std::string_view laws[] = {"original", "solvable", "level"};
    static constexpr std::string_view energies[] = {"vertical", "total"};
    static constexpr option_info options[] = {
        {"law", laws, "Eq (13), the solvable law, or contact at heights fixed at the apex"},
        {"energy", energies, "the energy that is regulated, without or with horizontal motion"}};
    static constexpr extra_info extras[] = {
        {"flight_time", "s", "apex to impact, summed over returns"}};
    static constexpr outcome outcomes[] = {
        outcome::ok,   outcome::over_shoulder, outcome::invalid_gain, outcome::apex_below,
        outcome::fell, outcome::off_bar,       outcome::downward};
    static constexpr column_info trace_columns[] = {
        {"bx", "m", any_finite, "ball"},   {"by", "m", any_finite, "ball"},
        {"bz", "m", any_finite, "ball"},   {"vx", "m/s", any_finite, "ball"},
        {"vy", "m/s", any_finite, "ball"}, {"vz", "m/s", any_finite, "ball"}};

    static constexpr model_info info{
        .name = "mirror_spatial",
        .title = "Spatial mirror-law juggler",
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
        const double x = after[3] - before[3];
        const double y = after[4] - before[4];
        const double z = after[5] - before[5];
        return sqrt(x * x + y * y + z * z) / (1.0 + parameters[restitution]);
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
    using lane = mirror::spatial_lane<Real>;

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> begin(lane<Real>& lane, int, const Real* column,
                                                 const Real* p, const int* option, Watch&) {
        const Real zero(0.0);
        lane = {p[0],      p[1],      p[2],      p[3],      p[4],
                p[5],      p[6],      p[7],      p[8],      p[9],
                p[10],     p[11],     p[12],     p[13],     Real(option[1] == 1 ? 0.5 : 0.0),
                column[0], column[1], column[2], column[3], column[4],
                zero,      zero,      zero};
        const Real sum = column[0] + column[1] + column[2] + column[3] + column[4];
        const mask_of<Real> valid = (sum - sum == zero) & (lane.shoulder_radius < lane.bar_length);
        const mask_of<Real> none = valid & !valid;
        return {none, select(valid, zero, code_of<Real>(outcome::invalid_start))};
    }

    template <int Variant, class Real, class Watch>
    HOPSCOTCH_DEVICE static progress<Real> step(lane<Real>& lane, mask_of<Real> active,
                                                Watch& watch) {
        return mirror::spatial_cycle<Variant>(lane, active, watch);
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_state(const lane<Real>& lane, int, Real* column) {
        column[0] = lane.x;
        column[1] = lane.y;
        column[2] = lane.z;
        column[3] = lane.vx;
        column[4] = lane.vy;
    }

    template <class Real>
    HOPSCOTCH_DEVICE static void read_extras(const lane<Real>& lane, Real* extra) {
        extra[0] = lane.flight_time;
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
