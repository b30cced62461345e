// The sinusoidal paddle's and the mirror laws' regimes: ends of the published ranges, coexisting
// cycles, how long chatter takes, and the identities of exponents and multipliers
// (models/paddle_juggler.md, sections 4, 7, 8; models/mirror_juggler.md, sections 3, 4).
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace hopscotch {
namespace {

using namespace testing_models;

named_map paddle(double amplitude, double restitution, double phase, double speed) {
    return {"paddle_juggler",
            "impact",
            {{"amplitude", amplitude},
             {"restitution", restitution},
             {"phase", phase},
             {"relative_velocity", speed}}};
}
/// From the release state that every caught ball starts from.
named_map released(double amplitude, double restitution = 0.0) {
    return paddle(amplitude, restitution, std::asin(1.0 / amplitude), 0.0);
}
double sticks_of(const orbit_answer& a) { return std::stod(a.extras[0]); }
double distance(const named_map& a, const named_map& b) {
    const double turn = std::abs(std::remainder(a.start[0] - b.start[0], 2 * M_PI));
    return std::hypot(turn, a.start[1] - b.start[1]);
}

/// PERIODIC(q, p): p impacts in q forcing periods without sticking; p = 0 where none up to 16.
struct cycle {
    int q = 0, p = 0;
    auto operator<=>(const cycle&) const = default;
};
cycle cycle_of(const named_map& settled) {
    double time = 0.0;
    named_map there = settled;
    for (int n = 1; n <= 16; ++n) {
        const map_image f = there.image();
        if (f.end != outcome::ok) return {};
        there.start = f.state;
        time += f.time;
        if (distance(there, settled) < 1e-7) {
            return {static_cast<int>(std::lround(time / (2 * M_PI))), n};
        }
    }
    return {};
}

// --------------------------------------------------------------- restitution towards 1

TEST(juggler_regimes, next_to_restitution_1_the_map_nearly_keeps_area) {
    // det J = e^2 U / U' (page, section 4), from the exact derivatives at random starts
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> phase(0.0, 2 * M_PI), speed(2.0, 12.0);
    for (const double e : {1 - 1e-3, 1 - 1e-6, 1 - 0x1p-40}) {
        for (int i = 0; i < 40; ++i) {
            const named_map start = paddle(2.0, e, phase(bits), speed(bits));
            const map_image f = start.image();
            ASSERT_EQ(f.end, outcome::ok);
            const double weighed = f.jacobian.determinant() * f.state[1] / start.start[1];
            // rounding of two products of the size of the entries
            const double size = f.jacobian.squaredNorm() * std::abs(f.state[1] / start.start[1]);
            EXPECT_NEAR(weighed, e * e, 1e-14 * (1 + size)) << e;
        }
    }
}

TEST(juggler_regimes, speeds_next_to_restitution_1_stay_below_gamma_over_1_minus_e) {
    // A ball launched at V lands with at most sqrt(V^2 + 4 Gamma), and leaves with
    // e times that and (1 + e) Gamma: so V ends below the root of V = e sqrt(V^2 + 4 Gamma) +
    // (1 + e) Gamma, about 2 Gamma / (1 - e).
    const double gamma = 2.0;
    for (const double e : {0.9, 0.99}) {
        double bound = 4 * gamma / (1 - e);
        for (int i = 0; i < 10000; ++i)
            bound = e * std::sqrt(bound * bound + 4 * gamma) + (1 + e) * gamma;
        double highest = 0.0;
        for (int i = 0; i < 8; ++i) {
            named_map ball = paddle(gamma, e, 0.1 + 0.7 * i, 5.0);
            for (int n = 0; n < 600; ++n) {
                const orbit_answer next = ball.answer(1);
                if (next.end != outcome::ok) break;
                ball.start = {std::stod(next.columns[0]), std::stod(next.columns[1])};
                highest = std::fmax(highest, ball.start[1] + gamma * std::cos(ball.start[0]));
            }
        }
        EXPECT_LT(highest, bound) << e;
        EXPECT_GT(highest, 4 * gamma) << e;  // grows well beyond one stroke's speed
    }
}

// ------------------------------------------------------------- Shannon's juggler (e = 0)

TEST(juggler_regimes, shannon_bounces_on_a_whole_interval_of_amplitudes) {
    // sqrt(pi^2 + 1) = 3.2969 to sqrt(pi^2 + 4) = 3.7242; V_r = sqrt(Gamma^2 - 1): pi to
    // sqrt(pi^2 + 3), = 3.58742; the page prints 3.5875
    const double low = std::sqrt(M_PI * M_PI + 1), high = std::sqrt(M_PI * M_PI + 4);
    EXPECT_NEAR(low, 3.2969, 6e-5);
    EXPECT_NEAR(high, 3.7242, 6e-5);
    EXPECT_NEAR(std::sqrt(low * low - 1), M_PI, 1e-15);
    EXPECT_NEAR(std::sqrt(high * high - 1), 3.58742, 6e-6);
    for (int i = 0; i < 60; ++i) {
        const double gamma = low + (high - low) * (i + 0.5) / 60;
        const orbit_answer late = released(gamma).answer(3000);
        ASSERT_EQ(late.end, outcome::ok);
        EXPECT_EQ(sticks_of(late), 0.0) << gamma;
        // the multiplier 1 - D comes within 1 % of -1 at the upper end
        EXPECT_NEAR(std::stod(late.columns[0]), std::acos(M_PI / gamma), 1e-6) << gamma;
    }
    EXPECT_GT(sticks_of(released(low - 1e-4).answer(100)), 50.0);  // caught every period below
    EXPECT_EQ(cycle_of(released(high - 2e-3).after(20000)), (cycle{1, 1}));
    EXPECT_EQ(cycle_of(released(high + 2e-3).after(20000)), (cycle{2, 2}));
}

TEST(juggler_regimes, shannons_period_two_window_ends_at_3_85685) {
    EXPECT_EQ(cycle_of(released(3.85685 - 1e-4).after(8000)), (cycle{2, 2}));
    EXPECT_GT(sticks_of(released(3.85685 + 1e-4).answer(4000)), 100.0);
    EXPECT_NEAR(std::sqrt(3.85685 * 3.85685 - 1), 3.7250, 6e-5);
}

TEST(juggler_regimes, landing_next_to_the_release_phase_decides_catch_or_bounce) {
    // with e = 0 a landing where D <= 1 is caught, one where D > 1 leaves at once: the start's
    // phase that lands on the release phase is bisected; either side of it has its own outcome
    const double gamma = 3.2;
    double caught = 0.0, bounced = 0.0;
    bool has_caught = false, has_bounced = false;
    for (double phase = 0.0; phase < 2 * M_PI && !(has_caught && has_bounced); phase += 0.01) {
        const orbit_answer a = paddle(gamma, 0.0, phase, 1.0).answer();
        if (a.end != outcome::ok) continue;
        (sticks_of(a) > 0 ? caught : bounced) = phase;
        (sticks_of(a) > 0 ? has_caught : has_bounced) = true;
    }
    ASSERT_TRUE(has_caught && has_bounced);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (caught + bounced);
        (sticks_of(paddle(gamma, 0.0, middle, 1.0).answer()) > 0 ? caught : bounced) = middle;
    }
    EXPECT_LT(std::abs(caught - bounced), 4e-15);
    const orbit_answer at = paddle(gamma, 0.0, caught, 1.0).answer();
    EXPECT_NEAR(std::stod(at.columns[0]), std::asin(1 / gamma), 1e-15);  // released
    // in 50 digits the two neighbours differ in the same way
    EXPECT_NE(
        sticks_of(
            paddle(gamma, 0.0, caught - 8 * (bounced - caught), 1.0).answer(1, digits::fifty)),
        sticks_of(
            paddle(gamma, 0.0, bounced + 8 * (bounced - caught), 1.0).answer(1, digits::fifty)));
}

// ------------------------------------------------------------- coexisting cycles

std::set<cycle> cycles_from(double amplitude, double restitution, int n) {
    std::set<cycle> seen;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) {
            const named_map m =
                paddle(amplitude, restitution, 2 * M_PI * (i + 0.5) / n, 9.0 * (k + 0.5) / n);
            const orbit_answer late = m.answer(3000);
            if (late.end != outcome::ok || sticks_of(late) > 0) continue;
            seen.insert(cycle_of(m.after(3000)));
        }
    }
    return seen;
}

TEST(juggler_regimes, gamma_0_9_has_rest_and_three_cycles) {
    const std::set<cycle> seen = cycles_from(0.9, 0.8, 16);
    EXPECT_TRUE(seen.contains({1, 1}));
    EXPECT_TRUE(seen.contains({2, 1}));
    EXPECT_TRUE(seen.contains({2, 4}));
    EXPECT_EQ(paddle(0.9, 0.8, 0.1, 0.2).answer(5000).end, outcome::rest);
}

TEST(juggler_regimes, gamma_1_6_has_the_interleaved_cycles_of_the_page) {
    const std::set<cycle> seen = cycles_from(1.6, 0.5, 16);
    for (const cycle& c : {cycle{2, 2}, {2, 8}, {3, 3}}) {
        EXPECT_TRUE(seen.contains(c)) << c.q << " " << c.p;
    }
}

// ------------------------------------------------------------- chatter

/// Impacts until a stick or rest, from random starts; sorted.
std::vector<double> impacts_to_stick(double low, double high, double restitution, int n) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<double> counts;
    while (static_cast<int>(counts.size()) < n) {
        const double amplitude = low + (high - low) * unit(random);
        const named_map m =
            paddle(amplitude, restitution, 2 * M_PI * unit(random), 3.0 * unit(random));
        // returns to the first stick by bisection on the count
        std::uint32_t before = 0, after = 2000;
        const auto is_caught = [&](std::uint32_t n_returns) {
            const orbit_answer a = m.answer(n_returns);
            return a.end == outcome::rest || (a.end == outcome::ok && sticks_of(a) > 0);
        };
        if (!is_caught(after)) continue;  // bounces on: another attractor
        while (after - before > 1) {
            const std::uint32_t middle = (before + after) / 2;
            (is_caught(middle) ? after : before) = middle;
        }
        counts.push_back(after);
    }
    std::sort(counts.begin(), counts.end());
    return counts;
}

TEST(juggler_regimes, chatter_takes_as_many_impacts_as_the_page_counts) {
    // the page's starts are not given: medians within a factor of two, maxima of the same order
    const std::vector<double> resting = impacts_to_stick(0.6, 0.6, 0.8, 60);
    EXPECT_GT(resting[30], 27 / 2);
    EXPECT_LT(resting[30], 27 * 2);
    const std::vector<double> caught = impacts_to_stick(2.0, 3.0, 0.5, 60);
    EXPECT_GT(caught[30], 12 / 2.5);
    EXPECT_LT(caught[30], 12 * 2.5);
    EXPECT_LT(caught.back(), 400);
    const std::vector<double> slow = impacts_to_stick(1.2, 1.2, 0.95, 20);
    EXPECT_GT(slow.back(), 200);  // up to 595 on the page: limited by impacts, not by time
    EXPECT_LT(slow.back(), 2000);
}

// ------------------------------------------------------------- identities

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

// ------------------------------------------------------------- mirror laws

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
