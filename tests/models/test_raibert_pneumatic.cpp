// Raibert's pneumatic hopper: figures and closed forms of its page (models/raibert_hopper.md,
// sections 4 to 9).
#include "tests/models/pneumatic_hopper.hpp"

#include "kernels/models/raibert_pneumatic.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::pneumatic_hopper;

// air0: no friction, no gravity in stance, thrust of no duration
const names simple{{"friction", "0"}, {"stance_gravity", "0"}, {"thrust_time", "0"}};

double settled(const std::string& section, const std::string& start, const names& set,
               std::uint32_t returns = 400) {
    const orbit_answer answer = hop(section, start, set, returns);
    EXPECT_EQ(answer.end, outcome::ok);
    return number(answer.columns[0]);
}

TEST(raibert_pneumatic, settles_as_in_figure_11) {
    const double apex = settled("apex", "1.15", simple);
    EXPECT_NEAR(apex, 1.24461, 6e-6);  // the page's digits, here and below
    EXPECT_NEAR(settled("apex", "1.4", simple), apex, 1e-12);
    EXPECT_NEAR(settled("bottom", "0.1", simple), 0.138796, 6e-7);
    const orbit_answer slope = hop("apex", print_real(apex), simple, 1, arithmetic::plain, true);
    EXPECT_NEAR(number(slope.derivative[0]), -0.2816, 6e-5);
}

TEST(raibert_pneumatic, settles_as_in_figure_12) {
    const double apex = settled("apex", "0.8", {});
    EXPECT_NEAR(apex, 0.838242, 6e-7);
    EXPECT_NEAR(settled("apex", "0.9", {}), apex, 1e-12);
    EXPECT_NEAR(settled("bottom", "0.2", {}), 0.211334, 6e-7);
    const orbit_answer slope = hop("apex", print_real(apex), {}, 1, arithmetic::plain, true);
    EXPECT_NEAR(number(slope.derivative[0]), -0.31496, 6e-6);
}

TEST(raibert_pneumatic, has_the_two_cycle_of_figure_13) {
    const names figure = with(simple, {{"stiffness", "2.33"}});
    const double bottom = settled("bottom", "0.02", figure, 1000);
    const double other = settled("bottom", "0.02", figure, 1001);
    EXPECT_NEAR(std::max(bottom, other), 0.16608, 6e-6);
    EXPECT_NEAR(std::min(bottom, other), 0.018655, 6e-7);
    const double apex = settled("apex", "1.0", figure, 1000);
    const double next = settled("apex", "1.0", figure, 1001);
    EXPECT_NEAR(std::min(apex, next), 0.75680, 6e-6);
    EXPECT_NEAR(std::max(apex, next), 1.26622, 6e-6);
    // with gravity in stance: still a 2-cycle for small g, then falls
    for (const char* g : {"0.5", "1", "2"}) {
        const names heavy = with(figure, {{"stance_gravity", g}});
        const double one = settled("bottom", "0.02", heavy, 1000);
        EXPECT_NEAR(settled("bottom", "0.02", heavy, 1002), one, 1e-9) << g;
        EXPECT_GT(std::abs(settled("bottom", "0.02", heavy, 1001) - one), 1e-3) << g;
    }
    EXPECT_EQ(hop("bottom", "0.02", with(figure, {{"stance_gravity", "5"}}), 50).returns, 2u);
    EXPECT_EQ(hop("bottom", "0.02", with(figure, {{"stance_gravity", "10"}}), 50).returns, 0u);
}

TEST(raibert_pneumatic, is_the_ricker_map_in_the_energy) {
    // (19): E' = alpha E e^{-E}, E = v^2 / (2 eta1), alpha = tau chi_l / eta1
    const double alpha = 41.86 * 0.5 / 5.81;
    for (const double energy : {1e-12, 0.01, 0.5, 1.0, 3.0, 20.0}) {
        const double speed = std::sqrt(2 * 5.81 * energy);
        const orbit_answer answer = hop("touchdown", print_real(speed), simple);
        const double next = number(answer.columns[0]);
        // rounding of the speed and e^{-E} make E + 3 ulp or so
        EXPECT_NEAR(next * next / (2 * 5.81) / (alpha * energy * std::exp(-energy)), 1.0,
                    2e-15 * (2 + energy));
    }
}

TEST(raibert_pneumatic, times_compression_by_dawsons_integral) {
    // gamma = g = 0: t = chi sqrt(2/eta) D(v / sqrt(2 eta)); D(1) = 0.53807950691276841914
    const double speed = std::sqrt(2 * 5.81);
    const names set = with(simple, {{"leg_mass_ratio", "0"}});
    const double hop_time = number(hop("touchdown", print_real(speed), set).time);
    // decompression with eta2 = tau chi_b = alpha e^{-1} eta1, from rest: E' is the same with v'
    // and eta2
    const double alpha = 41.86 * 0.5 / 5.81;
    const double eta2 = alpha * std::exp(-1.0) * 5.81;
    const double next = std::sqrt(2 * eta2);  // E = 1 in both arcs
    const double dawson = 0.53807950691276841914;
    const double expected =
        0.5 * std::sqrt(2 / 5.81) * dawson + 0.5 * std::sqrt(2 / eta2) * dawson + 2 * next / 10;
    EXPECT_NEAR(hop_time, expected, 1e-14);
}

TEST(raibert_pneumatic, has_the_slope_at_zero_of_the_page) {
    const double slope = std::sqrt((41.86 - 10) / (5.81 / 0.5 - 10)) / 1.25;
    for (const char* friction : {"0", "2.33"}) {
        const names set{{"friction", friction}, {"leg_mass_ratio", "0.25"}};
        for (const char* speed : {"1e-12", "3e-9"}) {
            const orbit_answer answer = hop("touchdown", speed, set);
            EXPECT_EQ(answer.end, outcome::ok);
            EXPECT_NEAR(number(answer.columns[0]) / number(speed) / slope, 1.0, 1e-14);
        }
        // just above the limit the arcs are integrated: the error of P'(0) v is O(v)
        EXPECT_NEAR(number(hop("touchdown", "2e-8", set).columns[0]) / 2e-8 / slope, 1.0, 1e-6);
    }
}

TEST(raibert_pneumatic, falls_beyond_its_fall_edge) {
    // Fig. 12 settings: v_e = 4.7779, apex 1.6414; maximum of P at 2.06
    EXPECT_EQ(hop("touchdown", "4.7778", {}).end, outcome::ok);
    EXPECT_LT(number(hop("touchdown", "4.7778", {}).columns[0]), 0.1);
    EXPECT_EQ(hop("touchdown", "4.7780", {}).end, outcome::no_liftoff);
    EXPECT_EQ(hop("apex", "1.6413", {}).end, outcome::ok);
    EXPECT_EQ(hop("apex", "1.6415", {}).end, outcome::no_liftoff);
    EXPECT_GT(number(hop("touchdown", "2.055", {}, 1, arithmetic::plain, true).derivative[0]),
              -1e-2);
    EXPECT_LT(number(hop("touchdown", "2.065", {}, 1, arithmetic::plain, true).derivative[0]),
              1e-2);
    EXPECT_GT(number(hop("touchdown", "2.05", {}, 1, arithmetic::plain, true).derivative[0]), 0.0);
    EXPECT_LT(number(hop("touchdown", "2.07", {}, 1, arithmetic::plain, true).derivative[0]), 0.0);
}

TEST(raibert_pneumatic, passes_through_the_bubble) {
    // eta1 decreasing: period 1, 2, 1, then all starts fall (about 1.65)
    const auto differs = [](const char* eta) {
        const names set{{"stiffness", eta}};
        return std::abs(settled("touchdown", "1.2", set, 3000) -
                        settled("touchdown", "1.2", set, 3001));
    };
    EXPECT_LT(differs("3.1"), 1e-9);
    EXPECT_GT(differs("2.3"), 1e-3);
    EXPECT_GT(differs("2.0"), 1e-3);
    EXPECT_LT(differs("1.82"), 1e-6);
    EXPECT_EQ(hop("touchdown", "1.2", {{"stiffness", "1.6"}}, 1000).end, outcome::no_liftoff);
}

TEST(raibert_pneumatic, hops_for_ever_before_the_crisis_and_falls_after_it) {
    const names set{
        {"thrust", "41.875"}, {"friction", "1"}, {"thrust_time", "0"}, {"stance_gravity", "1"}};
    EXPECT_EQ(hop("touchdown", "2", with(set, {{"stiffness", "1.2"}}), 1500).end, outcome::ok);
    const orbit_answer after = hop("touchdown", "2", with(set, {{"stiffness", "1.09375"}}), 1500);
    EXPECT_EQ(after.end, outcome::no_liftoff);
    EXPECT_LT(after.returns, 400u);  // typically 1 to 40 hops
}

TEST(raibert_pneumatic, tends_to_the_exact_map_as_friction_vanishes) {
    for (const char* speed : {"0.3", "1.5", "3"}) {
        const orbit_answer exact = hop("touchdown", speed, {{"friction", "0"}});
        const orbit_answer integrated = hop("touchdown", speed, {{"friction", "1e-15"}});
        EXPECT_NEAR(number(exact.columns[0]), number(integrated.columns[0]), 2e-14);
        EXPECT_NEAR(number(exact.time), number(integrated.time), 1e-14);
    }
}

}  // namespace
}  // namespace hopscotch
