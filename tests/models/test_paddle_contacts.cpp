// The paddle juggler: contacts and chatter, hard cases of its page (models/paddle_juggler.md,
// section 8), 50 digits.
#include "tests/models/paddle_rows.hpp"

#include "kernels/models/paddle_juggler.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch::testing_models {
namespace {

using namespace testing_models::paddle_rows;

/// Gap by the plain formula of ball and paddle, an independent yardstick for signs.
double plain_gap(double amplitude, double phase, double speed, double t) {
    const double velocity = speed + amplitude * std::cos(phase);
    return amplitude * std::sin(phase) + velocity * t - 0.5 * t * t -
           amplitude * std::sin(phase + t);
}

TEST(PaddleJuggler, derivatives_agree_with_50_digit_differences) {
    const real50 h(0x1p-70);
    const paddle p{"2.3", "0.45"};
    const auto exact = p.from("0.75", "2.5", 3, arithmetic::mp50, true);
    for (int column = 0; column < 2; ++column) {
        const auto moved = [&](const real50& by) {
            const real50 phase = real50(0.75) + (column == 0 ? by : real50(0.0));
            const real50 speed = real50(2.5) + (column == 1 ? by : real50(0.0));
            return p.from(to_string(phase, 64), to_string(speed, 64), 3, arithmetic::mp50);
        };
        const auto high = moved(h);
        const auto low = moved(-h);
        for (std::size_t row = 0; row < 2; ++row) {
            const real50 slope =
                (parse_real<real50>(high.columns[row]) - parse_real<real50>(low.columns[row])) /
                (h + h);
            // differences of 50 printed digits over 2e-21 leave 29 digits; truncation is 1e-42
            EXPECT_NEAR(number(exact.derivative[row * 2 + static_cast<std::size_t>(column)]),
                        to_double(slope), 1e-14 * (1.0 + std::abs(to_double(slope))));
        }
    }
}

TEST(PaddleJuggler, no_contact_is_missed) {
    std::mt19937_64 bits(17);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 400; ++i) {
        const double gamma = 0.2 + 8.0 * uniform(bits);
        const double theta = 2.0 * pi_double * uniform(bits);
        const double speed = (2.0 * gamma + 4.0) * uniform(bits);
        const auto answer = with(gamma, 0.5).from(print_real(theta), print_real(speed));
        if (answer.end != outcome::ok || sticks_of(answer) > 0.0)
            continue;  // the time holds a ride as well
        const double t = number(answer.time);
        // rounding of the plain formula: a few ulp of t^2 + Gamma
        const double noise = 1e-14 * (t * t + speed * t + gamma);
        EXPECT_NEAR(plain_gap(gamma, theta, speed, t), 0.0, noise);
        for (int k = 1; k < 3000; ++k) {
            ASSERT_GT(plain_gap(gamma, theta, speed, t * k / 3000.0), -noise)
                << gamma << " " << theta << " " << speed;
        }
    }
}

TEST(PaddleJuggler, agrees_with_50_digits_after_one_impact) {
    std::mt19937_64 bits(23);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const paddle p = with(0.3 + 5.0 * uniform(bits), 0.1 + 0.8 * uniform(bits));
        const std::string theta = print_real(2.0 * pi_double * uniform(bits));
        const std::string speed = print_real(0.01 + 8.0 * uniform(bits));
        const auto plain = p.from(theta, speed);
        const auto truth = p.from(theta, speed, 1, arithmetic::mp50);
        ASSERT_EQ(plain.end, truth.end);
        if (truth.end != outcome::ok) continue;
        ASSERT_EQ(sticks_of(plain), sticks_of(truth))
            << theta << " " << speed << " " << p.amplitude;
        const double t = number(truth.time);
        const double approach = std::max(1e-3, speed_of(truth));
        // gap errors of a few ulp of t^2 + Gamma become phase errors by 1 / approach speed
        const double tolerance = 1e-15 * (t * t + 30.0) * (1.0 + 1.0 / approach);
        EXPECT_NEAR(number(plain.time), t, tolerance);
        const double turn = std::abs(phase_of(plain) - phase_of(truth));
        EXPECT_LT(std::min(turn, 2.0 * pi_double - turn), tolerance);
        EXPECT_NEAR(speed_of(plain), speed_of(truth), tolerance * (2.0 + number(p.amplitude)));
    }
}

TEST(PaddleJuggler, near_grazing_is_decided_on_both_sides) {
    const paddle p{"2.5", "0.5"};
    for (const arithmetic kind : {arithmetic::plain, arithmetic::wide, arithmetic::mp50}) {
        const auto touches = p.from("4", "4.749697012725277", 1, kind);
        const auto misses = p.from("4", "4.749697012725278", 1, kind);
        // at h' = -8e-8 an ulp of t^2 moves the contact by 1e-7
        EXPECT_NEAR(number(touches.time), 4.3879315, 3e-7);
        EXPECT_NEAR(speed_of(touches), 0.5 * 8e-8, 3e-8);
        EXPECT_NEAR(number(misses.time), 6.1634276, 1e-7);
        EXPECT_NEAR(speed_of(misses), 0.5 * 1.199, 5e-4);
    }
}

TEST(PaddleJuggler, chatter_completes_by_certificate) {
    for (const char* phase : {"0.1", "1", "2.5", "4", "6"}) {
        const auto resting = paddle{"0.6", "0.8"}.from(phase, "3", 5000);
        // page, section 8: median 27 impacts
        if (resting.end == outcome::rest) {
            EXPECT_LT(resting.returns, 400u);
        } else {
            EXPECT_EQ(sticks_of(resting), 0.0);  // one of the coexisting bouncing cycles
        }
    }
    const auto slow = paddle{"1.2", "0.95"}.from("1.5", "0.001", 2000);
    EXPECT_EQ(slow.end, outcome::ok);
}

TEST(PaddleJuggler, amplitudes_next_to_one_release_slowly_or_never) {
    EXPECT_EQ((paddle{"1", "0"}.from("0.3", "0.4").end), outcome::rest);
    EXPECT_EQ((paddle{"1", "0"}.from("1.5707963267948966", "0").end), outcome::rest);
    const auto answer = paddle{"1.000000001", "0"}.from("0.3", "0.4");
    EXPECT_EQ(answer.end, outcome::ok);
    EXPECT_EQ(sticks_of(answer), 1.0);
    // asin(1 / Gamma) = pi/2 - sqrt(2e-9): V_r = Gamma cos(theta_r) = 4.47e-5
    // Gamma - 1 itself is 1e-9 only to 8e-8
    EXPECT_NEAR(std::cos(phase_of(answer)), std::sqrt(2e-9), 4e-12);
    EXPECT_EQ((paddle{"1.000000001", "0"}.from("0.3", "0.4", 50).end), outcome::ok);
}

TEST(PaddleJuggler, returns_that_end_at_rest_are_not_counted) {
    const auto answer = paddle{"0.5", "0"}.from("1", "2");
    EXPECT_EQ(answer.end, outcome::rest);
    EXPECT_EQ(answer.returns, 0u);
    EXPECT_EQ(phase_of(answer), 1.0);
    EXPECT_GT(number(answer.time), 0.0);
}

TEST(PaddleJuggler, traced_phases_join_without_a_gap) {
    for (const char* amplitude : {"0.8", "1.7", "3.2"}) {
        for (const char* restitution : {"0", "0.5"}) {
            const std::vector<std::pair<std::string, std::string>> set{
                {"amplitude", amplitude}, {"restitution", restitution}};
            const auto answer = run_row<model>({"impact", {"1", "2"}, set, {}, 6});
            if (answer.end == outcome::rest) continue;  // its last contact has no end
            trace_row<model>({"impact", {"1", "2"}, set, {}, 6}, 1e-11);
        }
    }
}

TEST(PaddleJuggler, starts_are_normalised) {
    const paddle p{"2", "0.5"};
    const auto negative = p.from("1", "-4");  // an impact comes first: U = 2
    const auto direct = p.from("1", "2");
    EXPECT_EQ(negative.columns, direct.columns);
    EXPECT_EQ(negative.events, direct.events + 1);
    const auto wound = p.from(print_real(1.0 + 2.0 * pi_double), "2");
    EXPECT_NEAR(phase_of(wound), phase_of(direct), 1e-14);
    EXPECT_EQ(p.from("nan", "2").end, outcome::invalid_start);
    EXPECT_EQ(p.from("1", "inf").end, outcome::invalid_start);
}

TEST(PaddleJuggler, high_flights_land_within_rounding) {
    const paddle p{"8", "0.9"};
    const auto plain = p.from("0.5", "400");
    const auto truth = p.from("0.5", "400", 1, arithmetic::mp50);
    EXPECT_NEAR(number(plain.time), number(truth.time), 4e-13);  // eps t with t = 814
    EXPECT_NEAR(speed_of(plain), speed_of(truth), 4e-12);
}

TEST(PaddleJuggler, tiny_bounces_keep_their_relative_accuracy) {
    const paddle p{"0.5", "0.999"};  // the certificate asks for U < 1e-7 here
    for (const char* speed : {"1e-3", "1e-5", "3e-7"}) {
        const auto plain = p.from("0.2", speed);
        const auto truth = p.from("0.2", speed, 1, arithmetic::mp50);
        ASSERT_EQ(plain.end, outcome::ok);
        EXPECT_NEAR(number(plain.time) / number(truth.time), 1.0, 4e-15);
        EXPECT_NEAR(speed_of(plain) / speed_of(truth), 1.0, 4e-15);
    }
}

}  // namespace
}  // namespace hopscotch::testing_models
