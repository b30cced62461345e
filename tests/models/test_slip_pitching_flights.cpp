// The pitching spring-mass runner: touchdowns of bodies that spin (models/slip.md, section 6 and
// case 12), outcomes and what is reported.
#include "tests/models/pitching_gaits.hpp"

#include "kernels/models/slip.hpp"
#include "kernels/models/slip_pitching.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::pitching_gaits;
using model = slip_pitching;

constexpr double pi_double = 3.14159265358979323846;

/// Height of the foot held ready by a body that turns evenly, scanned finely: first downward zero
/// after it was above. The truth for flights that turn many times.
double scanned_touchdown(double height, double climb, double pitch, double rate, double hip,
                         double beta, double leg, double end) {
    const auto foot = [&](double t) {
        const double turned = pitch + rate * t;
        return height + climb * t - 0.5 * weight * t * t + hip * std::cos(turned) -
               leg * std::sin(beta - turned);
    };
    const double step = 1e-3 / std::abs(rate);
    bool above = foot(0.0) > 0.0;
    for (double t = 0.0; t < end; t += step) {
        const double value = foot(t + step);
        if (above && value <= 0.0) {
            double low = t, high = t + step;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (foot(middle) > 0.0 ? low : high) = middle;
            }
            return 0.5 * (low + high);
        }
        above = above || value > 0.0;
    }
    return -1.0;
}

TEST(slip_pitching, finds_the_first_touchdown_of_a_body_that_spins) {
    // page, case 12; the search is asked directly, in units where gravity and the leg are 1
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int found = 0;
    int missed = 0;
    for (int i = 0; i < 60; ++i) {
        const double beta = 0.7 + 0.6 * unit(random);
        const double hip = 0.3 * (unit(random) - 0.3);
        const double height = 0.3 + 1.2 * unit(random);
        const double climb = 2.0 * (unit(random) - 0.4);
        const double pitch = 6.0 * unit(random);
        const double rate = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, 0.5 + 2.0 * unit(random));
        const spring_leg::foot_height<double> foot{
            height, climb, pitch, rate, hip - std::sin(beta), std::cos(beta), 0.0};
        const auto search = spring_leg::first_touchdown(foot, true);
        ASSERT_FALSE(search.unresolved) << i;
        // the scan has g = 9.81: lengths stay, times shrink by sqrt(g)
        const double root = std::sqrt(weight);
        const double end = spring_leg::fall_time(height, climb) / root;
        const double truth =
            scanned_touchdown(height, climb * root, pitch, rate * root, hip, beta, 1.0, end);
        ASSERT_EQ(search.found, truth >= 0.0) << i;
        if (truth >= 0.0) {
            EXPECT_NEAR(search.time, truth * root, 1e-12) << i;
        }
        ++(search.found ? found : missed);
    }
    EXPECT_GT(found, 20);
    EXPECT_GE(missed, 1);
}

TEST(slip_pitching, resolves_flights_with_hundreds_of_turns_in_both_protocols) {
    for (const char* rate : {"300", "-300", "3000"}) {
        for (const names& options : {inertial, body}) {
            const model_row row{"touchdown",
                                {"7.93", "0.15", "0", rate},
                                {{"touchdown_angle", "1"}, {"hip_offset", "0.015"}},
                                options};
            const orbit_answer plain = run_row<model>(row);
            EXPECT_NE(plain.end, outcome::unresolved_event) << rate;
            EXPECT_NE(plain.end, outcome::budget) << rate;
            EXPECT_NE(plain.end, outcome::not_finite) << rate;
        }
    }
}

TEST(slip_pitching, ignores_a_foot_below_the_ground_until_it_has_risen) {
    // foot at -0.2, rising through 0 and falling again: y + w t - t^2/2 - 1 from y = 0.8, w = 1
    const spring_leg::foot_height<double> foot{0.8, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    const auto search = spring_leg::first_touchdown(foot, true);
    ASSERT_TRUE(search.found);
    EXPECT_NEAR(search.time, 1.0 + std::sqrt(0.6), 1e-14);
    // never rises: w = 0.5 lifts it by 0.125 only
    const auto never = spring_leg::first_touchdown(
        spring_leg::foot_height<double>{0.8, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0}, true);
    EXPECT_FALSE(never.found);
    EXPECT_FALSE(never.unresolved);
    // launched from the ground itself: the zero at t = 0 is no touchdown
    const auto launched = spring_leg::first_touchdown(
        spring_leg::foot_height<double>{1.0, 0.7, 0.0, 0.0, 0.0, 0.0, 1.0}, true);
    ASSERT_TRUE(launched.found);
    EXPECT_NEAR(launched.time, 1.4, 1e-15);
}

TEST(slip_pitching, reaches_every_outcome) {
    const names leg{{"touchdown_angle", "1"}};
    const auto end_of = [](const model_row& row) { return run_row<model>(row).end; };
    for (const names& options : {inertial, body}) {
        // moving away from the foot; the hip's own velocity counts: d theta' alone undoes the
        // closing
        EXPECT_EQ(end_of({"touchdown", {"8", "-0.6", "0", "0"}, leg, options}),
                  outcome::no_contact);
        EXPECT_EQ(end_of({"touchdown",
                          {"1", "0.2", "0", "100"},
                          {{"touchdown_angle", "1"}, {"hip_offset", "0.15"}},
                          options}),
                  outcome::no_contact);
        EXPECT_EQ(end_of({"touchdown",
                          {"11", "0.79", "0", "0"},
                          {{"touchdown_angle", "0.8"}, {"stiffness", "50"}},
                          options}),
                  outcome::ground);
        EXPECT_EQ(end_of({"touchdown", {"0", "0.1", "0", "0"}, leg, options}),
                  outcome::invalid_start);
        EXPECT_EQ(end_of({"touchdown", {"8", "nan", "0", "0"}, leg, options}),
                  outcome::invalid_start);
        EXPECT_EQ(end_of({"touchdown", {"8", "0.1", "0", "inf"}, leg, options}),
                  outcome::invalid_start);
    }
    EXPECT_EQ(end_of({"touchdown",
                      {"8", "0.45", "0", "0"},
                      {{"touchdown_angle", "1"}, {"hip_offset", "0"}},
                      inertial}),
              run_row<slip>({"touchdown", {"8", "0.45"}, leg, {}}).end);
    EXPECT_EQ(end_of({"touchdown", {"10", "0.35", "0", "0"}, leg, inertial}), outcome::stumble);
}

TEST(slip_pitching, reports_the_new_touchdown_of_a_reversal) {
    const model_row row{
        "touchdown", {"8", "0.98", "0", "0"}, {{"touchdown_angle", "1"}, {"stiffness", "500"}}, {}};
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::reverse);
    EXPECT_EQ(answer.returns, 0u);
    EXPECT_GE(number(answer.columns[1]), pi_double / 2);
}

TEST(slip_pitching, keeps_the_last_touchdown_where_a_stride_fails) {
    const model_row row{"touchdown", {"10", "0.35", "0.01", "0.5"}, {{"touchdown_angle", "1"}}, {}};
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::stumble);
    EXPECT_EQ(number(answer.columns[1]), 0.35);
    EXPECT_EQ(number(answer.columns[3]), 0.5);
}

}  // namespace
}  // namespace hopscotch
