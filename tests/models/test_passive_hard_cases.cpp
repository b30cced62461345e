// The numerically hard inputs of the model page, section 9 (H1 and H10 are in
// test_passive_local_map.cpp).
#include "tests/models/passive_lane.hpp"
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include "analysis/orbit/orbit_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::hop;
using passive_rows::run;
using passive_rows::start;

double just_above(double x) { return std::nextafter(x, 1e300); }
double just_below(double x) { return std::nextafter(x, 0.0); }

/// One hop in 50-digit arithmetic, with df/dalpha.
orbit_answer fifty_digit_hop(const char* alpha, const char* mass_ratio) {
    const std::vector<std::string> columns{alpha};
    const std::vector<std::string> parameters{mass_ratio, "0", "0", "0", "0", "0", "0"};
    const orbit_row row{.variant = passive_rows::plastic,
                        .columns = columns,
                        .parameters = parameters,
                        .derivative = true};
    return find_model("passive_hopper")->orbits().run_mp50(row);
}

TEST(passive_hard_cases, h3_short_hops_keep_their_tiny_loss) {
    for (const double alpha : {1e-1, 1e-3, 1e-6, 1e-12}) {
        for (const double mass_ratio : {0.01, 1.0, 300.0}) {
            const auto one = hop(alpha, mass_ratio);
            const double kappa = mass_ratio / ((1.0 + mass_ratio) * (1.0 + mass_ratio));
            // loss = 2 alpha (32/9) kappa alpha^5, next order alpha^2 relative
            const double expected = 64.0 / 9.0 * kappa * std::pow(alpha, 6);
            EXPECT_NEAR(one.loss / expected, 1.0, 3.0 * alpha * alpha + 1e-13) << alpha;
            EXPECT_LE(one.speed, alpha);
            EXPECT_GE(one.speed, alpha - expected / alpha - 1e-16 * alpha);
        }
    }
}

TEST(passive_hard_cases, h3_second_bounce_left_of_a_lossless_point_is_not_lost) {
    for (int j = 1; j <= 15; ++j) {
        passive_lane::hand_stepped orbit(1, -std::pow(10.0, -j), 1.0);
        orbit.hop();
        EXPECT_EQ(orbit.lane.bounces, 1.0) << j;
    }
}

TEST(passive_hard_cases, h4_grazing_flight_ends_at_the_graze_below_and_later_above) {
    const double grazing = 4.38262552659732;  // V cot V = 1.5
    EXPECT_NEAR(grazing * std::cos(grazing) / std::sin(grazing), 1.5,
                1e-12);  // 15 digits, slope 20
    const auto half_flight_time = [](double speed) {
        const passive::launch<double> from{0.0, 1.0, speed, 0.5};
        return 2.0 * passive::first_contact(from, 0.0, true, true).x;
    };
    const auto any_flight_time = [](double speed) {
        const passive::free_flight<false, double> flow{{1.5, speed, 0.0, 1.0}, 0.0, 0.0};
        return passive::first_contact<false, double>(flow, false, true).time;
    };
    for (const double distance : {1e-6, 1e-9, 1e-12}) {
        for (const double speed : {grazing - distance, grazing + distance}) {
            const simulator hopper({});
            const double truth = to_double(
                hopper.first_contact({1.5, speed, 0.0, 0.0}, passive_truth::launch::rest));
            // below, the time still moves with the square root of the distance: 2 (8
            // distance)^(1/2)
            if (speed < grazing) EXPECT_NEAR(truth, 8.7652, 1e-4 + 6.0 * std::sqrt(distance));
            if (speed > grazing) EXPECT_NEAR(truth, 9.0998, 1e-4 + 100.0 * distance);
            // dx/dV = 1.4 / sqrt(distance) and a residual of 4 ulp of x^2 give 6e-15 /
            // sqrt(distance); ten times that is granted, since Halley's last step is judged against
            // x, not against the double root
            const double allowed = 1e-14 + 6e-14 / std::sqrt(distance);
            EXPECT_NEAR(half_flight_time(speed), truth, allowed) << speed;
            EXPECT_NEAR(any_flight_time(speed), truth, 4.0 * allowed) << speed;
        }
    }
}

TEST(passive_hard_cases, h4_speed_after_a_graze_is_continuous) {
    const double grazing = 4.38262552659732;
    const auto below = start(1.5, grazing - 1e-10, 0.0, 0.0, 1.0);
    const auto above = start(1.5, grazing + 1e-10, 0.0, 0.0, 1.0);
    ASSERT_EQ(below.end, outcome::ok);
    ASSERT_EQ(above.end, outcome::ok);
    // square root of 2e-10 times a slope of order 10
    EXPECT_NEAR(below.speed, above.speed, 2e-4);
    const history truth =
        simulator({}).next_lift_off({1.5, grazing - 1e-10, 0.0, 0.0}, passive_truth::launch::rest);
    EXPECT_NEAR(below.speed, to_double(truth.speed), 1e-9);  // 1e-15 through a slope of 1e5
}

TEST(passive_hard_cases, h5_kind_of_landing_changes_exactly_between_the_doubles_around_m_pi) {
    for (int m = 1; m <= 60; ++m) {
        const real50 edge = pi50() * static_cast<double>(m);
        double below = to_double(edge);
        if (real50(below) > edge) below = just_below(below);
        for (const double mass_ratio : {0.05, 0.5, 1.0, 2.0, 20.0}) {
            EXPECT_EQ(hop(below, mass_ratio).bounces, 0.0) << m << " " << mass_ratio;
            EXPECT_GE(hop(just_above(below), mass_ratio).bounces, 1.0) << m << " " << mass_ratio;
        }
    }
}

TEST(passive_hard_cases, h5_speed_at_m_pi_is_the_one_sided_limit) {
    for (int m = 1; m <= 6; ++m) {
        const real50 edge = pi50() * static_cast<double>(m);
        double below = to_double(edge);
        if (real50(below) > edge) below = just_below(below);
        for (const double mass_ratio : {1.7, 2.5, 20.0}) {
            // sustained landing with y1 = 1 and V = m pi (M - 1) / (M + 1) > 0: lift-off at V at
            // once
            const real50 v = edge * (mass_ratio - 1.0) / (mass_ratio + 1.0);
            const auto left = hop(below, mass_ratio);
            EXPECT_NEAR(left.speed, to_double(v), 1e-14 * m) << m << " " << mass_ratio;
            const history again = simulator({.mass_ratio = mass_ratio}).from_lift_off(v);
            const auto right = hop(just_above(below), mass_ratio);
            ASSERT_EQ(right.end == outcome::ok, again.lifts);
            if (!again.lifts) continue;
            // eta of an ulp, through the square root of the second flight's slope
            EXPECT_NEAR(right.speed, to_double(again.speed), 1e-6) << m << " " << mass_ratio;
        }
        for (const double mass_ratio : {0.05, 0.5}) {
            const auto left = hop(below, mass_ratio);
            const auto right = hop(just_above(below), mass_ratio);
            // V < 0 there: contact either way, alpha^2 = V^2
            const double v = m * M_PI * (1.0 - mass_ratio) / (1.0 + mass_ratio);
            EXPECT_NEAR(left.speed, v, 1e-14 * m);
            EXPECT_NEAR(right.speed, v, 1e-14 * m);
        }
        const auto dead = hop(below, 1.0);  // M = 1: V = 0, and sqrt(2 alpha ulp) next to it
        EXPECT_TRUE(dead.end == outcome::stuck || dead.speed < 1e-6) << m;
    }
}

TEST(passive_hard_cases, h6_speed_next_to_the_stuck_edge_follows_the_square_root) {
    const auto left_over = [](const real50& x) {
        const half_flight there(x);
        return there.alpha() * there.alpha() - there.toll() * 0.25;
    };
    const real50 edge = half_flight(bisect(left_over, real50(0.5), pi50())).alpha();
    EXPECT_NEAR(to_double(edge), 1.4241972, 1e-7);
    for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const double alpha = to_double(edge) - distance;
        const history truth = simulator({}).from_lift_off(alpha);
        const auto one = hop(alpha, 1.0);
        ASSERT_EQ(one.end, outcome::ok);
        ASSERT_TRUE(truth.lifts);
        // f^2 is a difference of 2 with a few ulp; f carries them divided by 2 f
        const double f = to_double(truth.speed);
        EXPECT_NEAR(one.speed, f, 4e-15 / f + 1e-15) << distance;
    }
    EXPECT_EQ(hop(just_below(M_PI), 1.0).end, outcome::stuck);
    EXPECT_GE(hop(just_above(M_PI), 1.0).bounces, 1.0);
}

TEST(passive_hard_cases, h7_eight_bounces_have_the_derivative_that_no_double_survives) {
    // the doubles next to the page's decimals: the decimals themselves bounce 7 times
    const double speed = 318.1081542203347;
    const double mass_ratio = 3.725552469316884;
    const orbit_answer exact = fifty_digit_hop(to_string(real50(speed), 60).c_str(),
                                               to_string(real50(mass_ratio), 60).c_str());
    EXPECT_EQ(exact.end, outcome::ok);
    EXPECT_EQ(exact.extras[0].substr(0, 1), "8");
    const double slope = std::stod(exact.derivative[0]);
    EXPECT_NEAR(std::abs(slope) / 8.8e14, 1.0, 0.006);  // two digits printed
    // the simulator of the tests, moved by 1e-30
    const simulator hopper({.mass_ratio = mass_ratio});
    const real50 alpha(speed);
    const history truth = hopper.from_lift_off(alpha);
    EXPECT_EQ(truth.impacts, 9);
    EXPECT_LT(abs(truth.speed - real50(exact.columns[0])), real50(1e-30));
    const real50 moved = hopper.from_lift_off(alpha + 1e-30).speed;
    EXPECT_NEAR(to_double((moved - truth.speed) * 1e30) / slope, 1.0, 1e-9);
    // in double only the frame holds
    const auto rounded = hop(speed, mass_ratio);
    EXPECT_TRUE(rounded.end == outcome::ok || rounded.end == outcome::stuck);
    EXPECT_LE(rounded.speed, speed);
}

TEST(passive_hard_cases, h7_many_bounces_agree_with_fifty_digits_as_far_as_the_derivative_allows) {
    std::vector<double> alphas;
    for (int i = 0; i < 16; ++i) alphas.push_back(5.0 + 11.871 * i);
    for (const double alpha : alphas) {
        const std::string text = std::to_string(alpha);
        const orbit_answer exact = fifty_digit_hop(text.c_str(), "3.75");
        const auto one = hop(std::stod(text), 3.75);
        if (exact.end != outcome::ok) continue;
        const double slope = std::abs(std::stod(exact.derivative[0]));
        const double allowed = 1e-15 * alpha * (4.0 + 8.0 * slope);
        if (allowed > 1e-3) continue;
        ASSERT_EQ(one.end, outcome::ok) << text;
        EXPECT_NEAR(one.speed, std::stod(exact.columns[0]), allowed) << text;
    }
}

TEST(passive_hard_cases, h8_a_hundred_bounces_agree_with_fifty_digits) {
    // period-one and period-two bouncing are stable: errors die out along the way
    for (const char* alpha : {"3.17", "3.4", "3.7"}) {
        const orbit_answer exact = fifty_digit_hop(alpha, "1e3");
        const auto one = hop(std::stod(alpha), 1e3);
        ASSERT_EQ(exact.end, outcome::ok);
        ASSERT_EQ(one.end, outcome::ok);
        EXPECT_EQ(one.bounces, std::stod(exact.extras[0])) << alpha;
        const double slope = std::abs(std::stod(exact.derivative[0]));
        EXPECT_NEAR(one.speed, std::stod(exact.columns[0]), 1e-13 * (10.0 + slope)) << alpha;
    }
}

TEST(passive_hard_cases, h8_light_and_heavy_feet_have_the_speed_and_time_of_the_truth) {
    for (const double mass_ratio : {1e-5, 1e-3, 0.03, 30.0, 200.0}) {
        for (const double alpha : {0.5, 2.0, 4.3, 4.8, 6.0, 8.1}) {
            const history truth = simulator({.mass_ratio = mass_ratio}).from_lift_off(alpha);
            const auto one = hop(alpha, mass_ratio);
            ASSERT_EQ(one.end == outcome::ok, truth.lifts);
            if (!truth.lifts) continue;
            EXPECT_EQ(one.bounces, truth.impacts - 1.0) << alpha << " " << mass_ratio;
            // up to a dozen bounces of slope below 4 each
            EXPECT_NEAR(one.speed, to_double(truth.speed), truth.impacts > 2 ? 1e-10 : 2e-13)
                << alpha << " " << mass_ratio;
            EXPECT_NEAR(one.time / to_double(truth.time), 1.0, truth.impacts > 2 ? 1e-10 : 1e-13)
                << alpha << " " << mass_ratio;
        }
    }
}

TEST(passive_hard_cases, h11_rounded_lossless_speed_gets_the_class_of_the_side_it_fell_on) {
    for (int k = 1; k <= 30; ++k) {
        const double rounded = to_double(lossless(k));
        const bool is_right = real50(rounded) >= lossless(k);
        const auto found = run({.columns = {{rounded}},
                                .mass_ratio = {1.0},
                                .returns = 20000,
                                .decided_by = decision::certificate,
                                .died_label = 1});
        ASSERT_EQ(found.end[0], outcome::attracted);
        if (is_right) {
            EXPECT_EQ(found.label[0], k + 1) << k;
        } else {
            EXPECT_LE(found.label[0], k) << k;
        }
    }
}

TEST(passive_hard_cases, h11_exact_lossless_point_is_its_own_image_and_belongs_to_its_class) {
    for (int k = 1; k <= 80; ++k) {  // beyond the table too
        passive_lane::hand_stepped orbit(k, 0.0, 1.0);
        for (int i = 0; i < 5; ++i) ASSERT_TRUE(orbit.hop());
        EXPECT_EQ(orbit.lane.beta, 0.0);
        EXPECT_EQ(orbit.lane.cell, k);
        EXPECT_EQ(orbit.lane.total_loss, 0.0);
        EXPECT_EQ(orbit.lane.bounces, 0.0);
        EXPECT_EQ(orbit.lane.trapped, k + 1.0);
    }
}

}  // namespace
}  // namespace hopscotch
