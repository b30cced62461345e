// The paddle juggler's regimes: Shannon's windows, coexisting cycles, catches, transients near
// restitution 1 (models/paddle_juggler.md, sections 5 to 8).
#include "tests/models/juggler_maps.hpp"

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::juggler_maps;

/// From the release state that every caught ball starts from.
named_map released(double amplitude, double restitution = 0.0) {
    return paddle(amplitude, restitution, std::asin(1.0 / amplitude), 0.0);
}

double distance(const named_map& a, const named_map& b) {
    const double turn = std::abs(std::remainder(a.start[0] - b.start[0], 2 * M_PI));
    return std::hypot(turn, a.start[1] - b.start[1]);
}

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

}  // namespace
}  // namespace hopscotch
