// Invariants of the jugglers' orbits, and the line juggler's cascade (models/paddle_juggler.md,
// section 4; models/mirror_juggler.md, section 3).
#include "tests/models/juggler_maps.hpp"

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::juggler_maps;

TEST(juggler_regimes, exponents_of_the_paddle_sum_to_twice_ln_e) {
    // the product of dets telescopes: det J = e^2 U / U', so after n impacts e^{2n} U_0 / U_n
    for (const auto& [amplitude, e] : {std::pair{2.5, 0.5}, {4.0, 0.7}, {6.0, 0.3}}) {
        named_map m = paddle(amplitude, e, 1.0, 3.0);
        double sum = 0.0;
        int n = 0;
        const double first = m.start[1];
        for (; n < 60; ++n) {
            const orbit_answer a = m.answer();
            if (a.end != outcome::ok || sticks_of(a) > 0) break;
            const map_image f = m.image();
            sum += std::log(f.jacobian.determinant());
            m.start = f.state;
        }
        ASSERT_GT(n, 5);
        EXPECT_NEAR(sum, 2 * n * std::log(e) + std::log(first / m.start[1]), 1e-8) << amplitude;
    }
}

TEST(juggler_regimes, multipliers_of_a_cycle_multiply_to_e_to_twice_its_period) {
    const std::pair<double, double> settings[] = {{0.9, 0.8}, {1.2, 0.5}};
    for (const auto& [amplitude, e] : settings) {
        // period 1 every forcing period: V = pi, Gamma cos theta = pi (1 - e) / (1 + e)
        const double slow = M_PI * (1 - e) / (1 + e);
        const named_map m =
            periodic_point(paddle(amplitude, e, std::acos(slow / amplitude), M_PI - slow));
        for (const std::uint32_t p : {1u, 3u}) {
            EXPECT_NEAR(m.image(p).jacobian.determinant(), std::pow(e, 2.0 * p), 1e-11);
        }
    }
}

TEST(juggler_regimes, orbits_of_the_paddle_go_on_from_any_impact) {
    const named_map m = paddle(1.6, 0.5, 2.0, 5.0);
    const map_image five = m.image(5);
    const map_image two = m.image(2);
    named_map there = m;
    there.start = two.state;
    const map_image three = there.image(3);
    EXPECT_EQ(three.state, five.state);
    EXPECT_NEAR(two.time + three.time, five.time, 1e-13);
}

/// The line juggler in the page's y and a (restitution 0, gravity 1, kappa1 = 1, kappa0 = 0).
named_map line(double a, double y) {
    return {"mirror_line",
            "apex",
            {{"restitution", 0.0},
             {"gravity", 1.0},
             {"gain_offset", 0.0},
             {"energy_gain", 1.0},
             {"target_height", a},
             {"apex_height", y}}};
}

TEST(juggler_regimes, line_juggler_doubles_at_2_and_root_5_and_has_lyapunov_exponent_ln_3_at_3) {
    const named_map first = point_with_multiplier(line(1.98, 0.98), "target_height", -1.0);
    EXPECT_NEAR(first.value("target_height"), 2.0, 1e-9);
    const named_map pair = periodic_point(line(2.23, 0.0).with("apex_height", 0.65), 2);
    const named_map second = point_with_multiplier(pair, "target_height", -1.0, 2);
    EXPECT_NEAR(second.value("target_height"), std::sqrt(5.0), 1e-9);
    named_map m = line(3.0, 0.7);
    double sum = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const map_image f = m.image();
        sum += std::log(std::abs(f.jacobian(0, 0)));
        m.start = f.state;
    }
    EXPECT_NEAR(sum / n, std::log(3.0), 0.02);  // fluctuations like n^(-1/2)
}

TEST(juggler_regimes, superstable_gaps_of_the_line_shrink_by_feigenbaums_factor) {
    const double a[] = {1.5, 2.1213203, 2.2629897, 2.2938433};
    EXPECT_NEAR((a[1] - a[0]) / (a[2] - a[1]), 4.39, 6e-3);
    EXPECT_NEAR((a[2] - a[1]) / (a[3] - a[2]), 4.59, 6e-3);  // on the way to 4.66920
    // and each is superstable: the exponent of the cycle through the critical point a / 3 is -inf
    for (int k = 0; k < 4; ++k) {
        const map_image f = line(a[k], a[k] / 3).image(static_cast<std::uint32_t>(1 << k));
        EXPECT_NEAR(f.jacobian(0, 0), 0.0, 1e-6);
        EXPECT_NEAR(f.to[0], a[k] / 3, 4e-6);
    }
}

TEST(juggler_regimes,
     downward_impacts_and_invalid_gains_are_reached_from_inside_only_beyond_their_bounds) {
    const auto flags = [](double a) {
        double downward = 0.0, invalid = 0.0;
        for (int i = 1; i < 60; ++i) {
            const orbit_answer late = line(a, a * i / 60.0).answer(40);
            downward = std::max(downward, std::stod(late.extras[0]));
            invalid = std::max(invalid, std::stod(late.extras[1]));
        }
        return std::pair{downward, invalid};
    };
    const double bound = 1.5 * std::sqrt(3.0);  // the paper's regime of physical interest
    EXPECT_EQ(flags(bound - 1e-3), (std::pair{0.0, 0.0}));
    EXPECT_EQ(flags(bound + 0.05).first, 1.0);
    EXPECT_EQ(flags(2.99).second, 0.0);  // [0, a + 1] is forward invariant up to a = 3
    // beyond 3 the image of a / 3 exceeds a + 1
    const orbit_answer out = line(3.05, 3.05 / 3).answer(2);
    EXPECT_EQ(std::stod(out.extras[1]), 1.0);
}

TEST(juggler_regimes, orbits_of_the_jugglers_go_on_from_any_apex) {
    for (const char* law : {"original", "solvable", "level"}) {
        named_map planar("mirror_planar", "apex", {{"bx", 0.55}, {"bz", 0.6}, {"vx", -0.1}},
                         {{"law", law}});
        named_map spatial("mirror_spatial", "apex",
                          {{"bx", 0.52}, {"by", 0.05}, {"bz", 0.6}, {"vx", -0.1}, {"vy", 0.05}},
                          {{"law", law}});
        for (const named_map& m : {planar, spatial}) {
            const map_image five = m.image(5);
            ASSERT_EQ(five.end, outcome::ok) << law;
            const map_image two = m.image(2);
            named_map there = m;
            there.start = two.state;
            EXPECT_EQ(there.image(3).state, five.state) << law;
        }
    }
}

}  // namespace
}  // namespace hopscotch
