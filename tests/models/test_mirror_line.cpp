// The line juggler: published map, its one-parameter form, and the numerically hard cases of its
// page.
#include "kernels/models/mirror_line.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch::testing_models {
namespace {

using model = mirror_line;
using settings = std::vector<std::pair<std::string, std::string>>;

orbit_answer juggle(const std::string& apex, const settings& set, std::uint32_t returns = 1,
                    arithmetic kind = arithmetic::plain, bool derivative = false) {
    return run_row<model>({"apex", {apex}, set, {}, returns, derivative}, kind);
}
double apex_of(const orbit_answer& answer) { return number(answer.columns[0]); }

/// Restitution 0, gravity 1, kappa1 = 1, kappa0 = 0: then b is the page's y and the target height
/// its a.
settings reduced(const std::string& a) {
    return {{"restitution", "0"},
            {"gravity", "1"},
            {"gain_offset", "0"},
            {"energy_gain", "1"},
            {"target_height", a}};
}
double y_after(const std::string& y, const std::string& a, std::uint32_t returns) {
    return apex_of(juggle(y, reduced(a), returns));
}

TEST(MirrorLine, apex_map_is_equation_9) {
    // v' = v [1 - beta (v^2 - v*^2)], beta = (1 + alpha) kappa1 / 2, with kappa0 tuned by default
    std::mt19937_64 bits(2);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 100; ++i) {
        const double alpha = uniform(bits);
        const double kappa1 = 0.1 * uniform(bits);
        const double target = 0.2 + uniform(bits);
        const double apex = 2.0 * uniform(bits);
        const settings set{{"restitution", print_real(alpha)},
                           {"energy_gain", print_real(kappa1)},
                           {"target_height", print_real(target)}};
        const double beta = 0.5 * (1.0 + alpha) * kappa1;
        const double v = std::sqrt(2.0 * 9.81 * apex);
        const double next = v * (1.0 - beta * (v * v - 2.0 * 9.81 * target));
        // a few ulp of the terms of m, squared
        EXPECT_NEAR(apex_of(juggle(print_real(apex), set)), next * next / (2.0 * 9.81),
                    2e-15 * apex * (1.0 + 100.0 * beta));
    }
}

TEST(MirrorLine, tuned_offset_is_the_default_for_every_restitution) {
    for (const char* alpha : {"0", "0.25", "0.5", "0.9"}) {
        const double tuned = (1.0 - number(alpha)) / (1.0 + number(alpha));
        const auto implicit = juggle("0.4", {{"restitution", alpha}}, 3);
        const auto given =
            juggle("0.4", {{"restitution", alpha}, {"gain_offset", print_real(tuned)}}, 3);
        EXPECT_NEAR(apex_of(implicit), apex_of(given), 1e-15);
        EXPECT_NEAR(apex_of(juggle("0.5", {{"restitution", alpha}})), 0.5, 1e-16);  // the target
    }
}

TEST(MirrorLine, multiplier_at_the_target_is_one_minus_2_b) {
    const auto answer = juggle("0.5", {{"restitution", "0.75"}, {"energy_gain", "0.05"}}, 1,
                               arithmetic::plain, true);
    const double servo = 1.75 * 0.05 * 9.81 * 0.5;  // B
    EXPECT_NEAR(number(answer.derivative[0]), 1.0 - 2.0 * servo, 1e-15);
}

TEST(MirrorLine, untuned_offset_moves_the_fixed_point) {
    const double alpha = 0.6;
    const double kappa0 = 0.4;
    const double m0 = alpha + (1.0 + alpha) * kappa0;
    const double slope = (1.0 + alpha) * 0.05 * 9.81;
    const double fixed = 0.5 + (m0 - 1.0) / slope;
    const settings set{{"restitution", "0.6"}, {"gain_offset", "0.4"}};
    EXPECT_NEAR(apex_of(juggle(print_real(fixed), set)), fixed, 1e-15);
    EXPECT_NEAR(apex_of(juggle("0.3", set, 500)), fixed, 1e-14);
}

TEST(MirrorLine, multiplier_of_the_fixed_point_is_3_minus_2_a) {
    for (const double a : {1.2, 1.5, 1.9, 2.3}) {
        const auto answer =
            juggle(print_real(a - 1.0), reduced(print_real(a)), 1, arithmetic::plain, true);
        EXPECT_NEAR(apex_of(answer), a - 1.0, 1e-15);
        EXPECT_NEAR(number(answer.derivative[0]), 3.0 - 2.0 * a, 4e-15);
    }
}

TEST(MirrorLine, period_two_has_product_1_and_sum_a) {
    for (const double a : {2.05, 2.1213203435596424, 2.2}) {
        const double one = y_after("0.9", print_real(a), 20000);
        const double other = y_after("0.9", print_real(a), 20001);
        EXPECT_NEAR(one * other, 1.0, 1e-13);
        EXPECT_NEAR(one + other, a, 1e-13);
        const auto cycle =
            juggle(print_real(one), reduced(print_real(a)), 2, arithmetic::plain, true);
        EXPECT_NEAR(number(cycle.derivative[0]), 9.0 - 2.0 * a * a, 1e-12);
    }
}

TEST(MirrorLine, superstable_parameters_of_the_page_close_the_critical_orbit) {
    // y = a / 3 is critical; the page's parameters have eight digits
    const std::vector<std::pair<const char*, std::uint32_t>> table{
        {"1.5", 1}, {"2.1213203", 2}, {"2.2629897", 4}, {"2.2938433", 8}};
    for (const auto& [a, period] : table) {
        const real50 critical = real50(std::string(a)) / real50(3.0);
        const auto answer =
            juggle(to_string(critical, 40), reduced(a), period, arithmetic::mp50, true);
        EXPECT_NEAR(apex_of(answer), to_double(critical), 4e-6) << a;
        EXPECT_NEAR(number(answer.derivative[0]), 0.0, 1e-30) << a;
    }
}

TEST(MirrorLine, a_equal_3_is_the_chebyshev_cubic) {
    // y = 2 - 2 cos(phi) is mapped to 2 - 2 cos(3 phi)
    for (const double phi : {0.1, 0.7, 1.3, 2.0, 2.9}) {
        const double y = 2.0 - 2.0 * std::cos(phi);
        EXPECT_NEAR(y_after(print_real(y), "3", 1), 2.0 - 2.0 * std::cos(3.0 * phi), 1e-14);
    }
}

TEST(MirrorLine, a_equal_2_converges_algebraically) {
    // around y = 1: second-iterate cubic coefficient -2 (9 - 2 a^2 has slope -8): d ~ 1 / sqrt(4 n)
    const double distance = std::abs(y_after("0.9", "2", 1000000) - 1.0);
    EXPECT_GT(distance, 2e-4);
    EXPECT_LT(distance, 2e-3);
}

int label_of(const std::string& y, const settings& set) {
    const std::vector<std::string> parameters = all_parameters<model>({"apex", {y}, set, {}});
    const std::vector<std::string> columns{y};
    orbit_row row{.variant = 1, .columns = columns, .parameters = parameters, .returns = 1000};
    row.decided_by = decision::certificate;
    row.died_label = 1;
    return orbits_of<model>().run_double(row).label;
}

TEST(MirrorLine, labels_follow_the_cascade) {
    EXPECT_EQ(label_of("0.5", reduced("0.9")), 1);
    EXPECT_EQ(label_of("0.5", reduced("1")), 1);
    EXPECT_EQ(label_of("0.5", reduced("1.5")), 2);
    EXPECT_EQ(label_of("0.5", reduced("2")), 2);
    EXPECT_EQ(label_of("0.5", reduced("2.1")), 3);
    EXPECT_EQ(label_of("0.5", reduced("2.2361")), 4);
    EXPECT_EQ(label_of("0.5", reduced("2.295")), 5);
    EXPECT_EQ(label_of("0.5", reduced("2.302284")), last_cascade_label);  // a_inf = 2.3022834627
    EXPECT_EQ(label_of("3.2", reduced("2.1")), 0);                        // y > a + 1 escapes
    EXPECT_EQ(label_of("0", reduced("2.1")), 1);
    EXPECT_EQ(label_of("0.5", reduced("1e-3")), 1);
}

TEST(MirrorLine, labelled_periods_are_those_orbits_settle_on) {
    for (const auto& [a, period] : std::vector<std::pair<const char*, int>>{
             {"1.7", 1}, {"2.12", 2}, {"2.26", 4}, {"2.293", 8}, {"2.3009", 16}}) {
        const double reference = y_after("0.6", a, 30000);
        const auto shift = static_cast<std::uint32_t>(period);
        EXPECT_NEAR(y_after("0.6", a, 30000 + shift), reference, 1e-9) << a;
        if (period > 1) {
            EXPECT_GT(std::abs(y_after("0.6", a, 30000 + shift / 2) - reference), 1e-3) << a;
        }
        label_description text;
        ASSERT_TRUE(model::describe_label(label_of("0.6", reduced(a)), text));
        EXPECT_EQ(text.period, period) << a;
    }
}

TEST(MirrorLine, without_energy_servo_the_gain_alone_decides) {
    const auto set = [](const char* kappa0) {
        return settings{{"restitution", "0.5"}, {"energy_gain", "0"}, {"gain_offset", kappa0}};
    };
    EXPECT_EQ(apex_of(juggle("0.75", set("0.25"), 2)), 0.75 * std::pow(0.875, 4));
    EXPECT_EQ(label_of("0.75", set("0.25")), 1);                        // m0 = 0.875
    EXPECT_EQ(label_of("0.75", set("0.33333333333333331")), 0);         // neutral
    EXPECT_EQ(juggle("0.75", set("0.5"), 2000).end, outcome::escaped);  // m0 = 1.25
}

TEST(MirrorLine, negative_energy_gain_repels) {
    // kappa1 = -1: y = -b, a = kappa-term: target 0.5 gives a = -0.5 + 1 (tuned) = 0.5, |y| = 1 - a
    // = 0.5
    const settings set{
        {"restitution", "0"}, {"gravity", "1"}, {"energy_gain", "-1"}, {"target_height", "0.5"}};
    EXPECT_EQ(label_of("0.49", set), 1);
    EXPECT_EQ(juggle("0.51", set, 2000).end, outcome::escaped);
    EXPECT_LT(apex_of(juggle("0.49", set, 500)), 1e-100);
}

TEST(MirrorLine, flags_are_raised_and_the_orbit_goes_on) {
    const auto flags = [](const char* y, const char* a) {
        const auto answer = juggle(y, reduced(a));
        return std::make_pair(number(answer.extras[0]), number(answer.extras[1]));
    };
    EXPECT_EQ(flags("1.9", "2"), std::make_pair(0.0, 0.0));
    EXPECT_EQ(flags("2.1", "2"), std::make_pair(1.0, 0.0));  // m < 0
    EXPECT_EQ(flags("3", "2"), std::make_pair(1.0, 1.0));    // K = -1 exactly
    EXPECT_EQ(flags("3.1", "2"), std::make_pair(1.0, 1.0));
    EXPECT_EQ(juggle("2.1", reduced("2")).end, outcome::ok);
    EXPECT_EQ(juggle("3.1", reduced("2")).end, outcome::ok);
    EXPECT_EQ(juggle("3.1", reduced("2"), 300).end, outcome::escaped);
}

TEST(MirrorLine, time_is_fall_and_rise_and_impacts_while_falling_are_immediate) {
    // g = 1, b = 2: fall 2 s; a = 2.5: m = 0.5, rise 1 s
    EXPECT_EQ(number(juggle("2", reduced("2.5")).time), 3.0);
    // a = 1.5: m = -0.5: the ball stays low; the next impact comes at once, at height 0.5 with m =
    // 1
    const auto two = juggle("2", reduced("1.5"), 2);
    EXPECT_EQ(number(juggle("2", reduced("1.5")).time), 2.0);
    EXPECT_EQ(number(two.time), 2.0 + 0.0 + 1.0);
    EXPECT_EQ(two.events, 2u);
}

TEST(MirrorLine, a_dead_stop_is_absorbed) {
    const auto stop = juggle("2", reduced("2"));  // y = a
    EXPECT_EQ(stop.end, outcome::ok);
    EXPECT_EQ(apex_of(stop), 0.0);
    const auto after = juggle("2", reduced("2"), 2);
    EXPECT_EQ(after.end, outcome::rest);
    EXPECT_EQ(after.returns, 1u);
}

TEST(MirrorLine, heights_near_the_dead_stop_grow_back_instead_of_being_flushed) {
    // a = 2.75: next to y = a the height falls to 1e-28 and grows by a^2 per cycle
    const std::string y = "2.7499999999999";
    const double low = y_after(y, "2.75", 1);
    EXPECT_GT(low, 0.0);
    EXPECT_LT(low, 1e-25);
    const double later = y_after(y, "2.75", 21);
    EXPECT_NEAR(later / (low * std::pow(2.75, 40)), 1.0, 1e-8);
    EXPECT_EQ(juggle(y, reduced("2.75"), 2000).end, outcome::ok);
}

TEST(MirrorLine, sluggish_rest_is_labelled_by_proof) {
    const settings set = reduced("0.999");  // 1 - a = 1e-3: 500 cycles per factor e
    EXPECT_EQ(label_of("0.5", set), 1);
    EXPECT_GT(apex_of(juggle("0.5", set, 100)), 1e-3);
}

TEST(MirrorLine, derivatives_agree_with_50_digit_differences) {
    const real50 h(0x1p-70);
    const settings set{{"restitution", "0.7"}, {"energy_gain", "0.11"}};
    const auto exact = juggle("0.3125", set, 3, arithmetic::mp50, true);
    const auto high = juggle(to_string(real50(0.3125) + h, 64), set, 3, arithmetic::mp50);
    const auto low = juggle(to_string(real50(0.3125) - h, 64), set, 3, arithmetic::mp50);
    const real50 slope =
        (parse_real<real50>(high.columns[0]) - parse_real<real50>(low.columns[0])) / (h + h);
    EXPECT_NEAR(number(exact.derivative[0]), to_double(slope),
                1e-14 * (1.0 + std::abs(to_double(slope))));
}

TEST(MirrorLine, agrees_with_50_digits) {
    std::mt19937_64 bits(9);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const settings set{{"restitution", print_real(uniform(bits) * 0.99)},
                           {"energy_gain", print_real(0.2 * uniform(bits))},
                           {"target_height", print_real(0.2 + uniform(bits))}};
        const std::string apex = print_real(0.01 + uniform(bits));
        const double want = apex_of(juggle(apex, set, 1, arithmetic::mp50));
        // m carries a few ulp of terms up to 1 + B < 6
        EXPECT_NEAR(apex_of(juggle(apex, set)), want, 6e-15 * (std::sqrt(want) + want));
        EXPECT_NEAR(number(juggle(apex, set).time),
                    number(juggle(apex, set, 1, arithmetic::mp50).time), 1e-14);
    }
}

TEST(MirrorLine, traced_phases_join_without_a_gap) {
    trace_row<model>({"apex", {"0.4"}, {}, {}, 5}, 1e-13);
    trace_row<model>({"apex", {"2"}, reduced("1.5"), {}, 3},
                     1e-13);  // with an impact while falling
}

TEST(MirrorLine, starts_below_the_ground_are_invalid) {
    EXPECT_EQ(juggle("-0.1", {}).end, outcome::invalid_start);
    EXPECT_EQ(juggle("nan", {}).end, outcome::invalid_start);
    EXPECT_EQ(juggle("inf", {}).end, outcome::invalid_start);
}

}  // namespace
}  // namespace hopscotch::testing_models
