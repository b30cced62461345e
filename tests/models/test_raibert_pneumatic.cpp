// Raibert's pneumatic hopper against its page (models/raibert_hopper.md): figures, hard cases,
// closed forms and 50 digits.
#include "kernels/models/raibert_pneumatic.hpp"

#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;
using names = std::vector<std::pair<std::string, std::string>>;

// air0: no friction, no gravity in stance, thrust of no duration
const names simple{{"friction", "0"}, {"stance_gravity", "0"}, {"thrust_time", "0"}};

names with(names base, const names& more) {
    base.insert(base.end(), more.begin(), more.end());
    return base;
}
orbit_answer hop(const std::string& section, const std::string& start, const names& set,
                 std::uint32_t returns = 1, arithmetic kind = arithmetic::plain,
                 bool derivative = false) {
    return run_row<raibert_pneumatic>({section, {start}, set, {}, returns, derivative}, kind);
}
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

TEST(raibert_pneumatic, keeps_relative_accuracy_for_tiny_impacts) {
    for (const char* friction : {"0", "2.33"}) {
        for (const char* speed : {"1e-2", "1e-4", "1e-6"}) {
            const names set{{"friction", friction}};
            const double plain = number(hop("touchdown", speed, set).columns[0]);
            const double truth =
                number(hop("touchdown", speed, set, 1, arithmetic::mp50).columns[0]);
            EXPECT_NEAR(plain / truth, 1.0, 2e-14)
                << speed;  // the page's chi or ln chi: 1e-4 at v = 1e-6
        }
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

TEST(raibert_pneumatic, treats_thrust_ending_at_lift_off_as_not_cut) {
    const names set{{"stiffness", "42"}, {"thrust", "42"}, {"friction", "0"}};
    const auto from = [&](const char* time) {
        return hop("bottom", "0.25", with(set, {{"thrust_time", time}}));
    };
    const orbit_answer exact = from("0.125");
    const orbit_answer before = from("0.124999");
    const orbit_answer after = from("0.125001");
    EXPECT_EQ(number(exact.extras[0]), 0.0);
    EXPECT_EQ(number(before.extras[0]), 0.0);
    EXPECT_EQ(number(after.extras[0]), 1.0);
    // v = 4, the next bottom from eta1 ln(chi_l/chi) - g (chi_l - chi) = 8; continuous across the
    // switch
    const double bottom = number(exact.columns[0]);
    EXPECT_NEAR(42 * std::log(0.5 / bottom) - 10 * (0.5 - bottom), 8.0, 1e-13);
    EXPECT_NEAR(number(before.columns[0]), bottom, 1e-5);
    EXPECT_NEAR(number(after.columns[0]), bottom, 1e-15);
}

TEST(raibert_pneumatic, sinks_on_an_overdamped_leg) {
    const names set{{"liftoff_height", "1.125"}, {"stiffness", "2.75"}, {"thrust", "51.375"},
                    {"thrust_time", "0.078125"}, {"friction", "3.75"},  {"stance_gravity", "3"},
                    {"leg_mass_ratio", "0.25"}};
    EXPECT_EQ(hop("touchdown", "0.5", set).end, outcome::sinks);
    EXPECT_EQ(hop("touchdown", "1", set).end, outcome::ok);
}

TEST(raibert_pneumatic, reaches_every_other_outcome) {
    for (const char* friction : {"0", "2.33"}) {
        const names set{{"friction", friction}};
        for (const char* thrust : {"10.0625", "10", "5"}) {
            EXPECT_EQ(hop("touchdown", "2", with(set, {{"thrust", thrust}})).end,
                      outcome::no_liftoff)
                << thrust;
        }
        EXPECT_EQ(hop("touchdown", "2", with(set, {{"thrust", "5"}, {"thrust_time", "1"}})).end,
                  outcome::crash);
        EXPECT_EQ(hop("apex", "0.5", set).end, outcome::invalid_start);
        EXPECT_EQ(hop("bottom", "0.5", set).end, outcome::invalid_start);
        EXPECT_EQ(hop("touchdown", "nan", set).end, outcome::invalid_start);
    }
    const names creeping{{"friction", "2.25"}, {"stance_gravity", "0"}, {"thrust_time", "0"}};
    EXPECT_EQ(hop("touchdown", "20", creeping).end, outcome::creep);  // 3e11 s
}

TEST(raibert_pneumatic, presses_its_leg_to_nothing_without_trouble) {
    // v = 100 without friction: ln chi_b ~ -861; thrust of finite time still lifts the body
    const orbit_answer exact = hop("touchdown", "100", {{"friction", "0"}});
    EXPECT_NE(exact.end, outcome::not_finite);
    // v = 20 with friction: chi_b ~ 1e-14, relative accuracy kept
    const names set{{"stance_gravity", "0"}};
    const orbit_answer plain = hop("touchdown", "20", set);
    const orbit_answer truth = hop("touchdown", "20", set, 1, arithmetic::mp50);
    EXPECT_EQ(plain.end, truth.end);
}

TEST(raibert_pneumatic, accelerates_after_touchdown_under_heavy_gravity) {
    // eta1 / chi_l = 8 < g = 10: v falls further before it rises; the zero hop is no fixed point
    for (const char* friction : {"0", "2.33"}) {
        const names set{{"stiffness", "4"}, {"friction", friction}};
        for (const char* speed : {"1e-6", "0.1", "2"}) {
            const orbit_answer plain = hop("touchdown", speed, set);
            const orbit_answer truth = hop("touchdown", speed, set, 1, arithmetic::mp50);
            ASSERT_EQ(plain.end, outcome::ok);
            EXPECT_NEAR(number(plain.columns[0]), number(truth.columns[0]), 5e-14) << speed;
            EXPECT_GT(number(plain.columns[0]), 0.5) << speed;
        }
    }
}

TEST(raibert_pneumatic, tends_to_the_exact_map_as_friction_vanishes) {
    for (const char* speed : {"0.3", "1.5", "3"}) {
        const orbit_answer exact = hop("touchdown", speed, {{"friction", "0"}});
        const orbit_answer integrated = hop("touchdown", speed, {{"friction", "1e-15"}});
        EXPECT_NEAR(number(exact.columns[0]), number(integrated.columns[0]), 2e-14);
        EXPECT_NEAR(number(exact.time), number(integrated.time), 1e-14);
    }
}

TEST(raibert_pneumatic, agrees_with_fifty_digits_on_random_hops) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int completed = 0;
    for (int i = 0; i < 24; ++i) {
        const names set{{"stiffness", print_real(2 + 6 * unit(random))},
                        {"thrust", print_real(20 + 60 * unit(random))},
                        {"thrust_time", print_real(0.04 * unit(random))},
                        {"friction", i % 2 ? "0" : print_real(4 * unit(random))},
                        {"stance_gravity", print_real(10 * unit(random))},
                        {"leg_mass_ratio", print_real(0.5 * unit(random))}};
        const std::string speed = print_real(0.2 + 3 * unit(random));
        const orbit_answer plain = hop("touchdown", speed, set);
        const orbit_answer truth = hop("touchdown", speed, set, 1, arithmetic::mp50);
        ASSERT_EQ(plain.end, truth.end) << i;
        if (plain.end != outcome::ok) continue;
        ++completed;
        const double expected = number(truth.columns[0]);
        EXPECT_NEAR(number(plain.columns[0]), expected, 1e-13 * (1 + 1 / expected))
            << i;  // fall edge
        EXPECT_NEAR(number(plain.time), number(truth.time), 1e-13 * (1 + 1 / expected)) << i;
    }
    EXPECT_GT(completed, 12);
}

TEST(raibert_pneumatic, differentiates_its_map_exactly) {
    const std::pair<const char*, const char*> starts[] = {
        {"touchdown", "2"}, {"touchdown", "0.1"}, {"apex", "0.9"}, {"bottom", "0.2"}};
    for (const char* friction : {"0", "2.33"}) {
        for (const auto& [section, start] : starts) {
            const names set{{"friction", friction}};
            const double exact =
                number(hop(section, start, set, 1, arithmetic::plain, true).derivative[0]);
            const real50 h("1e-20");
            const real50 middle = parse_real<real50>(start);
            const real50 above(
                hop(section, print_real(middle + h), set, 1, arithmetic::mp50).columns[0]);
            const real50 below(
                hop(section, print_real(middle - h), set, 1, arithmetic::mp50).columns[0]);
            const double expected = to_double((above - below) / (h + h));
            EXPECT_NEAR(exact, expected, 1e-11 * (1 + std::abs(expected)))
                << friction << section << start;
        }
    }
}

TEST(raibert_pneumatic, tells_the_same_story_on_every_section) {
    for (const char* friction : {"0", "2.33"}) {
        const names set{{"friction", friction}};
        const orbit_answer down = hop("touchdown", "2", set, 2);
        const orbit_answer apex = hop("apex", "0.7", set, 2);  // 0.5 + 2^2 / 20
        const double first = number(hop("touchdown", "2", set).columns[0]);
        const double second = number(down.columns[0]);
        EXPECT_NEAR(number(apex.columns[0]), 0.5 + second * second / 20, 1e-14);
        EXPECT_NEAR(number(apex.time), number(down.time) + 2.0 / 10 - second / 10, 1e-14);
        (void)first;
    }
}

}  // namespace
}  // namespace hopscotch
