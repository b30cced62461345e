// Branches of periodic orbits against published bifurcation values and closed forms.
#include "analysis/continuation/cascade.hpp"
#include "analysis/truth/decimal.hpp"
#include "tests/analysis/branch_runs.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

using testing_maps::map_of;
using testing_maps::special_points;
using testing_maps::study_over;

std::vector<branch> clocked_branches(double thrust, double thrust_time, double lowest,
                                     double highest) {
    const map_point map =
        map_of("openloop_hopper", "strobe", {{"thrust", thrust}, {"thrust_time", thrust_time}});
    return find_branches(
        study_over(map, "stride_period", lowest, highest, {{-0.004, 0.004, 10}, {-0.1, 0.1, 10}}));
}

// models/openloop_hopper.md, section 7; the page's last digit is the tolerance
TEST(continuation, finds_the_folds_of_the_long_thrust_hopper) {
    const auto branches = clocked_branches(1.55, 0.08, 0.2, 0.35);
    ASSERT_EQ(branches.size(), 1U);  // the three orbits at 0.26 s lie on one branch
    const auto folds = special_points(branches, special_kind::fold, 1);
    ASSERT_EQ(folds.size(), 2U);
    EXPECT_NEAR(folds[0].orbit.variable, 0.24865, 5e-6);
    EXPECT_NEAR(folds[1].orbit.variable, 0.27511, 5e-6);
    for (const special_point& fold : folds) {
        // a fold's multiplier differs from 1 by the root of the error of its place
        EXPECT_NEAR(fold.orbit.multipliers[0].real(), 1.0, 1e-7);
    }
    EXPECT_TRUE(special_points(branches, special_kind::flip, 1).empty());
}

TEST(continuation, tells_stable_from_unstable_between_the_folds) {
    const auto branches = clocked_branches(1.55, 0.08, 0.2, 0.35);
    int n_unstable = 0;
    for (const orbit_on_branch& orbit : branches.at(0).orbits) {
        if (orbit.is_stable()) continue;
        ++n_unstable;
        EXPECT_GT(orbit.variable, 0.24864);
        EXPECT_LT(orbit.variable, 0.27512);
    }
    EXPECT_GT(n_unstable, 10);
}

TEST(continuation, follows_the_short_thrust_hopper_through_flips_border_and_fold) {
    const auto branches = clocked_branches(3.8, 0.02, 0.08, 0.45);
    const auto flips = special_points(branches, special_kind::flip, 1);
    ASSERT_GE(flips.size(), 2U);
    EXPECT_NEAR(flips[0].orbit.variable, 0.1235, 5e-5);
    EXPECT_NEAR(flips[1].orbit.variable, 0.1560, 5e-5);
    const auto folds = special_points(branches, special_kind::fold, 1);
    ASSERT_EQ(folds.size(), 1U);
    EXPECT_NEAR(folds[0].orbit.variable, 0.2793, 5e-5);
    const auto borders = special_points(branches, special_kind::border, 1);
    ASSERT_FALSE(borders.empty());
    const special_point& end = borders.back();
    EXPECT_NEAR(end.orbit.variable, 0.3472, 5e-5);
    EXPECT_NE(end.detail.find("becomes 3.76"), std::string::npos) << end.detail;
    // the branch turns back there: both neighbours have shorter periods
    const branch& primary = branches.at(0);
    EXPECT_LT(primary.orbits.at(end.position - 4).variable, end.orbit.variable);
    EXPECT_LT(primary.orbits.at(end.position + 5).variable, end.orbit.variable);
}

TEST(continuation, locates_a_border_where_its_two_events_coincide) {
    const map_point map =
        map_of("openloop_hopper", "strobe", {{"thrust", 3.8}, {"thrust_time", 0.02}});
    const auto branches = clocked_branches(3.8, 0.02, 0.3, 0.4);
    const auto borders = special_points(branches, special_kind::border, 1);
    ASSERT_FALSE(borders.empty());
    struct take_off_clock final : orbit_observer {
        double at = 0.0;
        void phase(const char*, double, double, const sampler&) override {}
        void event(const char* name, double time, const char*, const char*, const double*,
                   const double*, double) override {
            if (std::string_view(name) == "take-off") at = time;
        }
    };
    for (const special_point& border : borders) {
        map_point there = map;
        there.parameters[4] = border.orbit.variable;
        std::vector<std::string> columns;
        std::vector<std::string> parameters;
        for (const double x : border.orbit.state) columns.push_back(print_real(x));
        for (const double x : there.parameters) parameters.push_back(print_real(x));
        take_off_clock clock;
        there.model->orbits().trace({.section = there.section,
                                     .options = there.options.data(),
                                     .variant = there.variant,
                                     .columns = columns,
                                     .parameters = parameters},
                                    clock);
        EXPECT_NEAR(clock.at, 0.02, 1e-11);  // thrust-off
    }
}

// alpha E exp(-E): the fixed point ln alpha has the multiplier 1 - ln alpha; the further flips are
// those of models/raibert_hopper.md, section 6
TEST(continuation, finds_the_cascade_of_the_pneumatic_map) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy");
    branch_study study = study_over(map, "gain", 1.0, 15.0, {{0.0, 6.0, 12}});
    study.doublings = 2;
    const auto branches = find_branches(study);
    const auto flip = [&](int period) {
        const auto flips = special_points(branches, special_kind::flip, period);
        return flips.empty() ? 0.0 : flips[0].orbit.variable;
    };
    EXPECT_NEAR(flip(1), std::exp(2.0), 1e-12);
    EXPECT_NEAR(flip(2), 12.50924193, 5e-9);
    EXPECT_NEAR(flip(4), 14.24424927, 5e-9);
}

// models/slip.md, section 11
TEST(continuation, continues_runners_over_the_speed_they_conserve) {
    const map_point map =
        map_of("slip", "touchdown",
               {{"leg_length", 0.173}, {"stiffness", 0.01839}, {"touchdown_angle", 0.961}},
               {{"spring", "air"}, {"stance_gravity", "off"}});
    branch_study study = study_over(map, "speed", 1.45, 1.72, {{1.5, 1.5, 1}, {0.0, 0.9, 16}});
    study.doublings = 2;
    const auto branches = find_branches(study);
    const auto folds = special_points(branches, special_kind::fold, 1);
    ASSERT_EQ(folds.size(), 1U);
    EXPECT_NEAR(folds[0].orbit.variable, 1.512797, 5e-7);
    const double flips[] = {1.657765, 1.705457, 1.710989};
    for (int doubling = 0; doubling < 3; ++doubling) {
        const auto found = special_points(branches, special_kind::flip, 1 << doubling);
        ASSERT_EQ(found.size(), 1U) << doubling;
        EXPECT_NEAR(found[0].orbit.variable, flips[doubling], 5e-7);
    }
}

TEST(continuation, finds_the_saddle_nodes_of_runners_with_linear_springs) {
    struct row {
        double stiffness, beta, lowest, highest, fold, last_digit;
        const char* gravity;
    };
    for (const row& known : {row{50.0, 0.8, 7.5, 9.0, 8.13883, 5e-6, "off"},
                             row{100.0, 1.25, 4.0, 4.8, 4.2325, 5e-5, "off"},
                             row{100.0, 1.0, 7.9, 9.0, 8.2687, 5e-5, "off"},
                             row{100.0, 1.0, 6.9, 7.7, 7.1153, 5e-5, "on"}}) {
        const map_point map = map_of(
            "slip", "touchdown", {{"stiffness", known.stiffness}, {"touchdown_angle", known.beta}},
            {{"spring", "linear"}, {"stance_gravity", known.gravity}});
        const auto branches = find_branches(study_over(map, "speed", known.lowest, known.highest,
                                                       {{8.0, 8.0, 1}, {0.02, known.beta, 8}}));
        const auto folds = special_points(branches, special_kind::fold, 1);
        ASSERT_EQ(folds.size(), 1U);
        EXPECT_NEAR(folds[0].orbit.variable, known.fold, known.last_digit);
    }
}

TEST(continuation, refuses_a_column_that_the_map_changes) {
    const map_point map = map_of("slip", "touchdown", {}, {{"stance_gravity", "off"}});
    EXPECT_THROW(study_over(map, "angle", 0.1, 0.4, {{5.0, 5.0, 1}, {0.1, 0.4, 4}}),
                 std::invalid_argument);
}

// models/passive_hopper.md, section 5
TEST(continuation, finds_the_onset_of_period_two_under_injection) {
    const map_point map = map_of("passive_hopper", "liftoff", {{"mass_ratio", 1.0}});
    branch_study study = study_over(map, "speed_increment", 0.02, 0.1, {{4.4, 4.7, 16}});
    study.doublings = 0;
    const auto flips = special_points(find_branches(study), special_kind::flip, 1);
    ASSERT_EQ(flips.size(), 1U);
    EXPECT_NEAR(flips[0].orbit.variable, 0.0715873841, 5e-11);
    EXPECT_NEAR(flips[0].orbit.state[0], 4.5417632729, 5e-11);
}

// Period-1 juggling every m paddle periods: w = pi m (1 - e)/(1 + e); saddle-node at Gamma = w,
// flip at Gamma^2 = w^2 + (2 (1 + e^2)/(1 + e)^2)^2 (models/paddle_juggler.md, section 4)
TEST(continuation, finds_the_paddle_jugglers_stability_limits) {
    for (const double e : {0.3, 0.5, 0.8}) {
        const double w = std::numbers::pi * (1.0 - e) / (1.0 + e);
        const double steep = 2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e));
        const double flip = std::sqrt(w * w + steep * steep);
        const map_point map = map_of("paddle_juggler", "impact", {{"restitution", e}});
        const double speed = std::numbers::pi - w;
        branch_study study = study_over(map, "amplitude", 0.9 * w, 1.1 * flip,
                                        {{0.0, 1.5, 6}, {0.9 * speed, 1.1 * speed, 3}});
        study.doublings = 0;
        const auto branches = find_branches(study);
        const auto folds = special_points(branches, special_kind::fold, 1);
        const auto flips = special_points(branches, special_kind::flip, 1);
        ASSERT_FALSE(folds.empty());
        ASSERT_FALSE(flips.empty());
        EXPECT_NEAR(folds[0].orbit.variable, w, 1e-10);
        EXPECT_NEAR(flips[0].orbit.variable, flip, 1e-10);
    }
}

// With restitution 0 and D < 1 the ball is caught: bouncing lives from Gamma = sqrt(pi^2 + 1),
// where catch and release end, to the flip at sqrt(pi^2 + 4); period 2 up to 3.85685 (section 7)
TEST(continuation, finds_where_the_shannon_juggler_bounces) {
    const double pi = std::numbers::pi;
    const map_point map = map_of("paddle_juggler", "impact", {{"restitution", 0.0}});
    const auto branches =
        find_branches(study_over(map, "amplitude", 3.1, 4.0, {{0.0, 6.28, 8}, {0.0, 4.0, 3}}));
    const auto borders = special_points(branches, special_kind::border, 1);
    const auto flips = special_points(branches, special_kind::flip, 1);
    ASSERT_EQ(borders.size(), 1U);
    ASSERT_EQ(flips.size(), 1U);
    EXPECT_NEAR(borders[0].orbit.variable, std::sqrt(pi * pi + 1.0), 1e-10);
    EXPECT_NEAR(flips[0].orbit.variable, std::sqrt(pi * pi + 4.0), 1e-10);
    const auto catches = special_points(branches, special_kind::border, 2);
    ASSERT_EQ(catches.size(), 1U);
    EXPECT_NEAR(catches[0].orbit.variable, 3.85685, 5e-6);
}

// Planar mirror law (15): horizontal block with trace 2 - T G k10 - G k11, determinant
// 1 + T G k10 - G k11, G = 2 V / b_x*, T = V / gamma, V = sqrt(2 gamma b_z*)
// (models/mirror_juggler.md, section 4)
TEST(continuation, finds_the_planar_jugglers_limits_of_the_velocity_gain) {
    const map_point map =
        map_of("mirror_planar", "apex", {{"position_gain", 0.05}}, {{"law", "solvable"}});
    const double fall = std::sqrt(2.0 * 9.81 * 0.5);
    const double flight = fall / 9.81;
    branch_study study = study_over(map, "velocity_gain", 0.005, 0.3,
                                    {{0.4, 0.6, 2}, {0.4, 0.6, 2}, {-0.1, 0.1, 2}});
    study.doublings = 0;
    const auto branches = find_branches(study);
    const auto pairs = special_points(branches, special_kind::neimark_sacker, 1);
    const auto flips = special_points(branches, special_kind::flip, 1);
    ASSERT_EQ(pairs.size(), 1U);
    ASSERT_EQ(flips.size(), 1U);
    EXPECT_NEAR(pairs[0].orbit.variable, flight * 0.05, 1e-10);
    EXPECT_NEAR(flips[0].orbit.variable, 0.5 / fall, 1e-10);  // 2 / G
}

// y' = y (a - y)^2 with a = 1 + (1 + alpha) kappa1 gamma b*: flips at a = 2 and, of the 2-cycle, at
// sqrt 5; cascade to 2.3022834627007 (sections 3 and 6)
TEST(continuation, finds_the_line_jugglers_cascade) {
    const map_point map = map_of("mirror_line", "apex");
    const double per_gain = 1.75 * 9.81 * 0.5;
    branch_study study =
        study_over(map, "energy_gain", 0.5 / per_gain, 1.31 / per_gain, {{0.3, 0.7, 6}});
    study.doublings = 6;
    const auto branches = find_branches(study);
    const auto first = special_points(branches, special_kind::flip, 1);
    const auto second = special_points(branches, special_kind::flip, 2);
    ASSERT_EQ(first.size(), 1U);
    ASSERT_FALSE(second.empty());
    EXPECT_NEAR(1.0 + per_gain * first[0].orbit.variable, 2.0, 1e-11);
    EXPECT_NEAR(1.0 + per_gain * second[0].orbit.variable, std::sqrt(5.0), 1e-11);
    const auto cascades = cascades_of(branches);
    ASSERT_FALSE(cascades.empty());
    const double limit = 1.0 + per_gain * cascades[0].limit;
    const double error = per_gain * cascades[0].error;
    EXPECT_LT(error, 1e-6);
    EXPECT_NEAR(limit, 2.3022834627007, error + 1e-12);
}

// For beta > pi/6 the upper gait ends at kt = 1, v = eta0 sqrt(k/m) (models/slip.md, section 4)
TEST(continuation, ends_the_runners_upper_gait_where_the_leg_collapses) {
    const map_point map =
        map_of("slip", "touchdown", {{"stiffness", 50.0}, {"touchdown_angle", 0.8}},
               {{"stance_gravity", "off"}});
    const auto branches =
        find_branches(study_over(map, "speed", 7.0, 11.0, {{8.0, 8.0, 1}, {0.0, 0.75, 12}}));
    double end = 0.0;
    double doubled_end = 0.0;
    for (const branch& branch : branches) {
        for (const end_of_branch& one : {branch.first, branch.last}) {
            if (!one.place) continue;
            EXPECT_LT(one.place->errors[0], 1e-10);
            (branch.period == 1 ? end : doubled_end) = one.place->numbers[0];
        }
    }
    EXPECT_NEAR(end, 1.5 * std::sqrt(50.0), 1e-10);
    // where P(0) = x and D(x) = 0 (page, section 4), by 40-digit arithmetic
    EXPECT_NEAR(doubled_end, 10.01868484871300556, 1e-10);
}

// p = 1 + s + s^2 with multipliers -1/(s + s^3), p = 2 + s with multipliers s^-1.5: roots at s = 0,
// from orbits no closer than s = 1e-6
TEST(continuation, extrapolates_to_an_end_where_the_multiplier_has_no_bound) {
    std::vector<approach> way;
    std::vector<approach> collapse;
    for (double s = 0.5; s > 1e-6; s *= 0.6) {
        way.push_back({{1.0 + s + s * s, std::exp(s)}, -1.0 / (s + s * s * s)});
        collapse.push_back({{2.0 + s}, std::pow(s, -1.5)});
    }
    const auto root = find_singular_end(way);
    ASSERT_TRUE(root);
    EXPECT_NEAR(root->numbers[0], 1.0, 1e-13);
    EXPECT_NEAR(root->numbers[1], 1.0, 1e-13);
    EXPECT_LT(root->errors[0], 1e-12);
    const auto other = find_singular_end(collapse);
    ASSERT_TRUE(other);
    EXPECT_NEAR(other->numbers[0], 2.0, 1e-13);
    way.resize(8);  // the multiplier has not grown enough
    EXPECT_FALSE(find_singular_end(way));
}

TEST(continuation, finds_longer_periods_from_starts) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy");
    branch_study study = study_over(map, "gain", 13.0, 14.5, {{0.0, 6.0, 16}});
    study.most_period = 4;
    study.doublings = 0;
    const auto branches = find_branches(study);
    const auto flips = special_points(branches, special_kind::flip, 4);
    ASSERT_EQ(flips.size(), 1U);
    EXPECT_NEAR(flips[0].orbit.variable, 14.24424927, 5e-9);
    int n_of_period[5] = {};
    for (const branch& branch : branches) ++n_of_period[branch.period];
    EXPECT_EQ(n_of_period[1], 1);
    EXPECT_EQ(n_of_period[2], 1);
    EXPECT_EQ(n_of_period[3], 0);  // the window of period 3 lies beyond the cascade
    EXPECT_EQ(n_of_period[4], 1);
}

// As fixed points of P^2, the fixed point and the 2-cycle of alpha E exp(-E) cross at e^2
TEST(continuation, locates_a_branch_point) {
    const map_point map = map_of("raibert_pneumatic_simple", "energy");
    const branch_study study = study_over(map, "gain", 6.0, 9.0, {{0.0, 6.0, 8}});
    const branch_equation twice(study.family, 2);
    const double fixed[] = {std::log(6.5)};
    const Eigen::VectorXd start = twice.unknowns_of(fixed, 6.5);
    const Eigen::VectorXd upward = Eigen::VectorXd::Unit(2, 1);
    const branch trivial =
        follow(twice, {start, tangent_of(twice.at(start).jacobian, upward)}, study.limits);
    ASSERT_EQ(trivial.special.size(), 1U);
    EXPECT_EQ(trivial.special[0].kind, special_kind::branch_point);
    EXPECT_NEAR(trivial.special[0].orbit.variable, std::exp(2.0),
                1e-7);  // Newton is singular there
}

// The valve's oscillation dies in a Hopf bifurcation of the equilibrium x (x + d) = ..., where the
// linearisation s^3 + (k + c) s^2 + (1 + k c) s + c + b r, r = sqrt p, c = b x/(2 r), has an
// imaginary pair: (k + c)(1 + k c) = c + b r.
TEST(continuation, ends_the_valves_oscillation_at_its_hopf_point) {
    const double k = 1.25;
    const double d = 10.0;
    const double b = 20.0;
    const auto excess = [&](double x) {
        const double r = std::sqrt(x + d);
        const double c = b * x / (2.0 * r);
        return (k + c) * (1.0 + k * c) - c - b * r;
    };
    double low = 0.0;
    double high = 10.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (excess(middle) < 0.0 ? low : high) = middle;
    }
    const double hopf = low * std::sqrt(low + d);
    const map_point map = map_of("relief_valve", "maximum");
    branch_study study = study_over(map, "flow_rate", 7.7, 9.0, {{4.0, 8.0, 2}, {1.0, 5.0, 2}});
    study.stations = 3;
    study.doublings = 0;
    const auto branches = find_branches(study);
    ASSERT_FALSE(branches.empty());
    double last = 0.0;
    for (const orbit_on_branch& orbit : branches[0].orbits) last = std::max(last, orbit.variable);
    EXPECT_NEAR(last, hopf, 1e-6);  // the amplitude is the root of the distance: 1e-3 at the end
}

}  // namespace
}  // namespace hopscotch
