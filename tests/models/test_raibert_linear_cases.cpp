// Raibert's hopper on the linear spring: degenerate and hard cases of its page
// (models/raibert_hopper.md, sections 4 and 8), outcomes, traces.
#include "tests/models/linear_hopper.hpp"

#include "kernels/models/raibert_linear.hpp"
#include "kernels/models/raibert_linear_simple.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace hopscotch::testing_models {
namespace {

using namespace testing_models::linear_hopper;

TEST(RaibertLinear, small_impacts_obey_the_slope_at_zero) {
    // F0 = eta (chi_0 - chi_l) - g; the thrust is cut: P'(0) = sqrt((tau - g) / F0) / (1 + mu')
    hopper h{.height = 0.5, .delta = 0.05, .leg = 0.25, .rest = 1.0};
    const double force = 46.5 * 0.5 - 10.0;
    const double slope = std::sqrt(31.86 / force) / 1.25;
    for (const double v : {1e-3, 1e-6, 1e-8, 1e-12}) {
        const auto plain = h.from("touchdown", print_real(v));
        const auto truth = h.from("touchdown", print_real(v), 1, arithmetic::mp50);
        EXPECT_EQ(plain.end, outcome::ok);
        EXPECT_EQ(cut_of(plain), 1.0);
        EXPECT_NEAR(state_of(plain) / v, slope, v + 4e-15);
        EXPECT_NEAR(state_of(plain) / state_of(truth), 1.0, 4e-15);
    }
    // without thrust time the preloaded spring does the same
    h.delta = 0.0;
    h.preloaded = true;
    for (const double v : {1e-6, 1e-8, 1e-12}) {
        const auto plain = h.from("touchdown", print_real(v));
        EXPECT_NEAR(state_of(plain) / v, slope, 2.0 * v + 1e-14);
        EXPECT_EQ(cut_of(plain), 0.0);
    }
}

TEST(RaibertLinear, weak_springs_still_have_one_bottom) {
    // eta (chi_0 - chi_l) < g: the body first accelerates downward after touchdown (page, 8.10)
    const hopper h{.height = 0.5, .gamma = 0.5, .rest = 0.6};
    for (const double v : {1e-6, 0.01, 1.0}) {
        const auto answer = h.from("touchdown", print_real(v));
        const auto truth = h.from("touchdown", print_real(v), 1, arithmetic::mp50);
        ASSERT_EQ(answer.end, truth.end);
        if (answer.end == outcome::ok) {
            EXPECT_NEAR(state_of(answer), state_of(truth), 1e-13);
        }
    }
}

TEST(RaibertLinear, overdamped_slow_impacts_sink) {
    // gamma^2 > 4 eta and a weak spring: below V (a - W) = eta z0 there is no bottom
    const hopper h{.height = 0.5, .delta = 0.05, .gamma = 20.0, .rest = 0.6};
    const double a = 10.0;
    const double w = std::sqrt(a * a - h.eta);
    const double z = 0.5 - (0.6 - 10.0 / h.eta);
    const double edge = h.eta * z / (a - w);
    EXPECT_EQ(h.from("touchdown", print_real(edge * 0.999)).end, outcome::sinks);
    EXPECT_NE(h.from("touchdown", print_real(edge * 1.001)).end, outcome::sinks);
    EXPECT_EQ(h.from("touchdown", print_real(edge * 0.999)).returns, 0u);
}

TEST(RaibertLinear, weak_thrusts_end_without_lift_off) {
    const hopper h{.height = 0.5, .gamma = 4.0, .rest = 0.515};
    const auto answer = h.from("touchdown", "0.5");
    EXPECT_EQ(answer.end, outcome::no_liftoff);
    EXPECT_EQ(answer.returns, 0u);
    EXPECT_EQ(state_of(answer), 0.5);
    // a thrust below gravity lets the body sink first; the spring may still throw it
    const hopper weak{.tau = 8.0, .delta = 0.05, .gamma = 0.0};
    const auto thrown = weak.from("touchdown", "2");
    // z = chi: the fall by X = -(g - tau) delta^2 / 2 with speed A delta raises the oscillator's
    // energy
    const double bottom = -2.0 / std::sqrt(46.5);
    const double x = bottom - 0.0025;
    const double v = -0.1;
    EXPECT_EQ(thrown.end, outcome::ok);
    EXPECT_NEAR(state_of(thrown), std::sqrt(46.5 * x * x + v * v), 1e-13);
}

TEST(RaibertLinear, thrust_end_and_lift_off_together_raise_no_flag) {
    // gamma = 0, A = 32, delta = 1/8: X = 1/4 exactly, v = 4 (page, 8.7, on the linear spring)
    const hopper h{.height = 0.5, .tau = 42.0, .delta = 0.125, .gamma = 0.0, .rest = 1.0};
    const auto exact = h.from("bottom", "0.25");
    EXPECT_EQ(cut_of(exact), 0.0);
    EXPECT_EQ(exact.end, outcome::ok);
    hopper shorter = h;
    hopper longer = h;
    shorter.delta -= 1e-6;
    longer.delta += 1e-6;
    EXPECT_EQ(cut_of(longer.from("bottom", "0.25")), 1.0);
    EXPECT_EQ(cut_of(shorter.from("bottom", "0.25")), 0.0);
    // v = 4 in all three: bottom after the next compression within 1e-5
    EXPECT_NEAR(state_of(longer.from("bottom", "0.25")), state_of(exact), 1e-5);
    EXPECT_NEAR(state_of(shorter.from("bottom", "0.25")), state_of(exact), 1e-5);
    hopper pre = h;
    pre.preloaded = true;
    EXPECT_EQ(state_of(pre.from("bottom", "0.25")), state_of(exact));
}

TEST(RaibertLinear, thrust_gravity_follows_stance_gravity_where_not_given) {
    const std::vector<std::pair<std::string, std::string>> set{{"stance_gravity", "7"},
                                                               {"rest_height", "1"}};
    auto given = set;
    given.emplace_back("thrust_gravity", "7");
    const auto a = run_row<model>({"touchdown", {"2"}, set, {}, 2});
    const auto b = run_row<model>({"touchdown", {"2"}, given, {}, 2});
    EXPECT_EQ(a.columns, b.columns);
}

TEST(RaibertLinear, traced_phases_join_without_a_gap) {
    for (const auto& [section, start] : std::vector<std::pair<std::string, std::string>>{
             {"touchdown", "2"}, {"apex", "0.9"}, {"bottom", "0.3"}}) {
        for (const char* spring : {"same", "preloaded"}) {
            for (const char* delta : {"0", "0.05", "0.4"}) {
                const model_row row{section,
                                    {start},
                                    {{"rest_height", "1"},
                                     {"thrust_time", delta},
                                     {"leg_mass_ratio", "0.125"},
                                     {"thrust", "60"}},
                                    {{"spring_after_thrust", spring}},
                                    3};
                trace_row<model>(row, 1e-12);
            }
        }
    }
}

TEST(RaibertLinear, starts_outside_the_domain_are_invalid) {
    EXPECT_EQ(figure_8.from("touchdown", "0").end, outcome::invalid_start);
    EXPECT_EQ(figure_8.from("touchdown", "-1").end, outcome::invalid_start);
    EXPECT_EQ(figure_8.from("apex", "0.5").end, outcome::invalid_start);
    EXPECT_EQ(figure_8.from("bottom", "0.6").end, outcome::invalid_start);
    EXPECT_EQ(figure_8.from("touchdown", "nan").end, outcome::invalid_start);
}

}  // namespace
}  // namespace hopscotch::testing_models
