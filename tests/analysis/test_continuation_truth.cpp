// The defining conditions of special points, evaluated again in 50 digits at the places found.
#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "tests/analysis/branch_runs.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

using testing_maps::map_of;
using testing_maps::special_points;
using testing_maps::study_over;

/// P^period and its derivative in 50 digits at a special point.
struct truth {
    std::vector<double> gap;         // P(x) - x, relative to x
    std::vector<double> derivative;  // row by row
};

truth truth_at(const branch_family& family, int period, const special_point& point) {
    const branch_equation equation(family, period);
    const map_point map = equation.map_at(point.orbit.unknowns);
    std::vector<std::string> columns;
    std::vector<std::string> parameters;
    for (const double x : point.orbit.state) columns.push_back(print_real(x));
    for (const double x : map.parameters) parameters.push_back(print_real(x));
    const orbit_answer answer =
        map.model->orbits().run_mp50({.section = map.section,
                                      .options = map.options.data(),
                                      .variant = map.variant,
                                      .columns = columns,
                                      .parameters = parameters,
                                      .returns = static_cast<std::uint32_t>(period),
                                      .derivative = true});
    EXPECT_EQ(answer.end, outcome::ok);
    truth result;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const real50 apart = parse_real<real50>(answer.columns[c]) - parse_real<real50>(columns[c]);
        result.gap.push_back(to_double(apart) / std::abs(point.orbit.state[c]));
    }
    for (const std::string& text : answer.derivative)
        result.derivative.push_back(to_double(parse_real<real50>(text)));
    return result;
}

/// det(D + shift) of a 2 x 2 matrix.
double determinant(const std::vector<double>& d, double shift) {
    return (d[0] + shift) * (d[3] + shift) - d[1] * d[2];
}

// the gap's bound is the rounding of one return in double, magnified by the orbit's conditioning
TEST(continuation_truth, folds_of_the_clocked_hopper_hold_in_fifty_digits) {
    const map_point map = map_of("openloop_hopper", "strobe");
    const branch_study study =
        study_over(map, "stride_period", 0.2, 0.35, {{-0.004, 0.001, 10}, {-0.05, 0.05, 10}});
    const auto folds = special_points(find_branches(study), special_kind::fold, 1);
    ASSERT_EQ(folds.size(), 2U);
    for (const special_point& fold : folds) {
        const truth at = truth_at(study.family, 1, fold);
        for (const double gap : at.gap) EXPECT_LT(std::abs(gap), 1e-13);
        // near a fold 1 - mu is the root of the distance in the parameter: 1e-7 here is 1e-14 there
        EXPECT_LT(std::abs(determinant(at.derivative, -1.0)), 1e-7);
    }
}

TEST(continuation_truth, flips_of_the_clocked_hopper_hold_in_fifty_digits) {
    const map_point map =
        map_of("openloop_hopper", "strobe", {{"thrust", 3.8}, {"thrust_time", 0.02}});
    const branch_study study =
        study_over(map, "stride_period", 0.1, 0.2, {{-0.004, 0.004, 8}, {-0.1, 0.1, 8}});
    const auto flips = special_points(find_branches(study), special_kind::flip, 1);
    ASSERT_EQ(flips.size(), 2U);
    for (const special_point& flip : flips) {
        const truth at = truth_at(study.family, 1, flip);
        for (const double gap : at.gap) EXPECT_LT(std::abs(gap), 1e-13);
        EXPECT_LT(std::abs(determinant(at.derivative, 1.0)), 1e-10);
    }
}

TEST(continuation_truth, doublings_of_the_runner_hold_in_fifty_digits) {
    const map_point map =
        map_of("slip", "touchdown",
               {{"leg_length", 0.173}, {"stiffness", 0.01839}, {"touchdown_angle", 0.961}},
               {{"spring", "air"}, {"stance_gravity", "off"}});
    const branch_study study =
        study_over(map, "speed", 1.6, 1.715, {{1.65, 1.65, 1}, {0.0, 0.9, 16}});
    const auto branches = find_branches(study);
    for (const int period : {1, 2}) {
        const auto flips = special_points(branches, special_kind::flip, period);
        ASSERT_EQ(flips.size(), 1U) << period;
        const truth at = truth_at(study.family, period, flips[0]);
        for (const double gap : at.gap) EXPECT_LT(std::abs(gap), 1e-13);
        EXPECT_NEAR(at.derivative[3], -1.0, 1e-10);  // d(angle)/d(angle); the speed is conserved
    }
}

}  // namespace
}  // namespace hopscotch
