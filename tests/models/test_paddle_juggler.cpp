// The paddle juggler: period one, catches and releases, Shannon's juggler: facts of its page
// (models/paddle_juggler.md, sections 3, 4 and 7).
#include "tests/models/paddle_rows.hpp"

#include "kernels/models/paddle_juggler.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch::testing_models {
namespace {

using namespace testing_models::paddle_rows;

TEST(PaddleJuggler, illustrative_impact_of_the_page) {
    const auto answer = paddle{"2", "0.5"}.from("1", "2");
    // the page prints 15 digits
    EXPECT_NEAR(number(answer.time), 6.19431845799992, 1e-14);
    EXPECT_NEAR(phase_of(answer), 0.911133150820342, 1e-14);
    EXPECT_NEAR(speed_of(answer), 2.16970765196763, 1e-14);
    EXPECT_EQ(answer.events, 1u);
    EXPECT_EQ(sticks_of(answer), 0.0);
}

TEST(PaddleJuggler, period_one_has_the_published_point_and_multipliers) {
    const auto answer = paddle{"1.2", "0.5"}.from("0.510163608543305", "2.09439510239320", 1,
                                                  arithmetic::plain, true);
    // the input's digits end at 5e-15, times dphase/dU = 2.1
    EXPECT_NEAR(phase_of(answer), 0.510163608543305, 1.1e-14);
    EXPECT_NEAR(speed_of(answer), 2.09439510239320, 2e-14);
    EXPECT_NEAR(number(answer.time), 2.0 * pi_double, 2e-14);
    const double trace = number(answer.derivative[0]) + number(answer.derivative[3]);
    const double det = number(answer.derivative[0]) * number(answer.derivative[3]) -
                       number(answer.derivative[1]) * number(answer.derivative[2]);
    EXPECT_NEAR(trace, 2.0 * -0.0342320388882877, 2e-14);
    EXPECT_NEAR(det,
                0.0342320388882877 * 0.0342320388882877 + 0.498826791094414 * 0.498826791094414,
                2e-14);
}

TEST(PaddleJuggler, equation_1_decides_the_stability_of_period_one) {
    std::mt19937_64 bits(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
        const double e = 0.9 * uniform(bits);
        const double limit = 2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e));
        const double lowest = e < 0.05 ? 1.05 : 0.05;  // restitution 0 would catch below D = 1
        const double fall = lowest + (1.3 * limit - lowest) * uniform(bits);  // D
        const double w = pi_double * (1.0 - e) / (1.0 + e);
        const double amplitude = std::hypot(fall, w);
        const double phase = std::atan2(fall, w);
        const double speed = pi_double - w;
        const auto answer =
            with(amplitude, e)
                .from(print_real(phase), print_real(speed), 1, arithmetic::plain, true);
        if (std::abs(phase_of(answer) - phase) > 1e-9)
            continue;  // an earlier contact: not admissible
        const double trace = number(answer.derivative[0]) + number(answer.derivative[3]);
        EXPECT_NEAR(trace, 1.0 + e * e - (1.0 + e) * (1.0 + e) * fall, 1e-12);
        const bool is_stable = std::abs(trace) < 1.0 + e * e && e * e < 1.0;
        EXPECT_EQ(is_stable, fall > 0.0 && fall < limit);
    }
}

TEST(PaddleJuggler, jacobian_is_that_of_section_4) {
    std::mt19937_64 bits(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 50; ++i) {
        const double gamma = 0.3 + 3.0 * uniform(bits);
        const double e = 0.1 + 0.8 * uniform(bits);
        const double theta = 2.0 * pi_double * uniform(bits);
        const double speed = 1.0 + 5.0 * uniform(bits);
        const auto answer =
            with(gamma, e).from(print_real(theta), print_real(speed), 1, arithmetic::mp50, true);
        if (sticks_of(answer) > 0.0 || answer.end != outcome::ok) continue;
        const double t = number(answer.time);
        const double d = -speed_of(answer) / e;
        const double c = std::cos(theta);
        const double c2 = std::cos(theta + t);
        const double fall = gamma * std::sin(theta + t);
        const double a = gamma * (c2 - c) / d;
        const double b = -t / d;
        // columns (theta, V) of the page to (theta, U): dV = dU - Gamma sin(theta) dtheta, both
        // ends
        const double start = gamma * std::sin(theta);
        const double j11 = 1.0 + a;
        const double j21 = e * a - (1.0 + e) * fall * j11;
        const double j22 = -e + e * b - (1.0 + e) * fall * b;
        const double scale =
            1e-11 * (1.0 + std::abs(1.0 / d)) * (1.0 + gamma * (1.0 + t)) * (1.0 + gamma);
        EXPECT_NEAR(number(answer.derivative[0]), j11 - b * start, scale);
        EXPECT_NEAR(number(answer.derivative[1]), b, scale);
        EXPECT_NEAR(number(answer.derivative[2]), j21 + fall * j11 - start * (j22 + fall * b),
                    scale);
        EXPECT_NEAR(number(answer.derivative[3]), j22 + fall * b, scale);
        const double det = number(answer.derivative[0]) * number(answer.derivative[3]) -
                           number(answer.derivative[1]) * number(answer.derivative[2]);
        EXPECT_NEAR(det, e * e * speed / speed_of(answer),
                    scale * (1.0 + speed / speed_of(answer)));
    }
}

TEST(PaddleJuggler, shannon_bounces_between_launch_speeds_pi_and_3_59) {
    // CPRR section 9: stable bouncing for Gamma from sqrt(pi^2 + 1) to sqrt(pi^2 + 4)
    for (const double gamma : {3.30, 3.4, 3.5, 3.6, 3.70}) {
        const auto answer = with(gamma, 0.0).released(4000);
        EXPECT_EQ(sticks_of(answer), 0.0) << gamma;
        // D = sqrt(Gamma^2 - pi^2), V = pi; the multiplier 1 - D reaches -0.95 at 3.70
        EXPECT_NEAR(phase_of(answer), std::acos(pi_double / gamma), 1e-10) << gamma;
        EXPECT_EQ(speed_of(answer), 0.0);
    }
}

TEST(PaddleJuggler, shannon_catches_every_period_below_that_range) {
    const paddle p{"3.2", "0"};
    const auto answer = p.released(10);
    EXPECT_EQ(sticks_of(answer), 10.0);
    EXPECT_NEAR(number(answer.time), 20.0 * pi_double, 1e-13);
    EXPECT_GE(answer.events, 20u);  // an impact and a release each
    EXPECT_NEAR(phase_of(answer), std::asin(1.0 / 3.2), 1e-15);
    EXPECT_EQ(speed_of(answer), 0.0);
}

TEST(PaddleJuggler, shannon_bounces_with_period_two_above_that_range) {
    for (const double gamma : {3.75, 3.8, 3.85}) {
        const paddle p = with(gamma, 0.0);
        const auto one = p.released(6000);
        EXPECT_EQ(sticks_of(one), 0.0) << gamma;
        EXPECT_GT(std::abs(phase_of(p.released(6001)) - phase_of(one)), 1e-2) << gamma;
        EXPECT_NEAR(phase_of(p.released(6002)), phase_of(one), 1e-9) << gamma;
    }
    // PERIODIC(2,2) ends at 3.85685: then a catch every second period
    const auto after = with(3.87, 0.0).released(1000);
    EXPECT_GT(sticks_of(after), 100.0);
}

int label_of(const paddle& p, const std::string& phase, const std::string& speed) {
    const std::vector<std::string> parameters{p.amplitude, p.restitution};
    const std::vector<std::string> columns{phase, speed};
    orbit_row row{.columns = columns, .parameters = parameters, .returns = 5000};
    row.decided_by = decision::certificate;
    row.died_label = 1;
    return orbits_of<model>().run_double(row).label;
}

TEST(PaddleJuggler, labels_name_the_stick_cycles) {
    EXPECT_EQ(label_of({"3.2", "0"}, "1", "0.5"), 2);      // stick 1
    EXPECT_EQ(label_of({"3.87", "0"}, "0.3", "0"), 3);     // stick 2
    EXPECT_EQ(label_of({"0.6", "0.8"}, "0.1", "0.2"), 1);  // rest
    EXPECT_EQ(label_of({"3.5", "0"}, "0.29", "0"), 0);     // bounces for ever: no label
    label_description text;
    ASSERT_TRUE(model::describe_label(3, text));
    EXPECT_EQ(text.kind, "stick");
    EXPECT_EQ(text.index, 2);
}

TEST(PaddleJuggler, a_paddle_that_falls_faster_than_the_ball_bounces_it_despite_restitution_zero) {
    // release at Gamma = 3.5: it lands where D > 1 and leaves at once
    const auto answer = paddle{"3.5", "0"}.released(1);
    EXPECT_EQ(sticks_of(answer), 0.0);
    EXPECT_EQ(speed_of(answer), 0.0);
    EXPECT_GT(3.5 * std::sin(phase_of(answer)), 1.0);
    // with restitution too a start at relative velocity zero is a launch there
    const auto start = paddle{"2", "0.5"}.from("1.2", "0");
    EXPECT_EQ(start.end, outcome::ok);
    EXPECT_GT(number(start.time), 1.0);
}

TEST(PaddleJuggler, gamma_0_9_rests_or_bounces_with_period_one) {
    const paddle p{"0.9", "0.8"};
    EXPECT_EQ(p.from("0.1", "0.2", 5000).end, outcome::rest);
    // period 1 every m: V = pi m, Gamma cos theta = pi m / 9
    for (const double m : {1.0, 2.0}) {
        const double w = pi_double * m / 9.0;
        const auto cycle =
            p.from(print_real(std::acos(w / 0.9) + 0.01), print_real(pi_double * m - w), 4000);
        EXPECT_NEAR(phase_of(cycle), std::acos(w / 0.9), 1e-9);
        EXPECT_NEAR(speed_of(cycle), pi_double * m - w, 1e-9);
    }
}

TEST(PaddleJuggler, long_transients_are_captured_when_the_page_says) {
    const paddle p{"1.71", "0.6"};
    // 50 digits: the first capture comes after 70 impacts
    EXPECT_EQ(sticks_of(p.from("2", "7", 69, arithmetic::mp50)), 0.0);
    EXPECT_EQ(sticks_of(p.from("2", "7", 70, arithmetic::mp50)), 1.0);
    EXPECT_GT(sticks_of(p.from("2", "7", 2000)), 0.0);
}

}  // namespace
}  // namespace hopscotch::testing_models
