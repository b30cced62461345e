// The ball on the sinusoidal paddle: published stability limits, Shannon's juggler, and the
// numerically hard cases of its page.
#include "kernels/models/paddle_juggler.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hopscotch::testing_models {
namespace {

using model = paddle_juggler;
constexpr double pi_double = std::numbers::pi;

struct paddle {
    std::string amplitude, restitution;
    orbit_answer from(const std::string& phase, const std::string& speed, std::uint32_t returns = 1,
                      arithmetic kind = arithmetic::plain, bool derivative = false) const {
        return run_row<model>({"impact",
                               {phase, speed},
                               {{"amplitude", amplitude}, {"restitution", restitution}},
                               {},
                               returns,
                               derivative},
                              kind);
    }
    /// From the release after sustained contact.
    orbit_answer released(std::uint32_t returns, arithmetic kind = arithmetic::plain) const {
        return from(print_real(std::asin(1.0 / number(amplitude))), "0", returns, kind);
    }
};

paddle with(double amplitude, double restitution) {
    return {print_real(amplitude), print_real(restitution)};
}
double phase_of(const orbit_answer& answer) { return number(answer.columns[0]); }
double speed_of(const orbit_answer& answer) { return number(answer.columns[1]); }
double sticks_of(const orbit_answer& answer) { return number(answer.extras[0]); }

/// Gap by the plain formula of ball and paddle, an independent yardstick for signs.
double plain_gap(double amplitude, double phase, double speed, double t) {
    const double velocity = speed + amplitude * std::cos(phase);
    return amplitude * std::sin(phase) + velocity * t - 0.5 * t * t -
           amplitude * std::sin(phase + t);
}

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
    return orbit_table<model>.run_double(row).label;
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
