// Raibert's pneumatic hopper: hard cases of its page (models/raibert_hopper.md, section 8),
// outcomes, 50 digits.
#include "tests/models/pneumatic_hopper.hpp"

#include "kernels/models/raibert_pneumatic.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::pneumatic_hopper;

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
