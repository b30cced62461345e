// The clock-driven hopper: invariants along many periods, and the hard cases of its page about slow
// convergence and singular slopes (models/openloop_hopper.md, sections 5 and 8).
#include "tests/models/openloop_map.hpp"

#include "tests/models/every_model.hpp"
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::openloop_map;

TEST(openloop_regimes, trace_and_determinant_of_one_hop_have_their_closed_forms) {
    const named_map orbits[] = {long_thrust(0.26, -2.448, -0.725), long_thrust(0.26, -1.705, 0.931),
                                long_thrust(0.26, -0.677, 0.265), short_thrust(0.15, -1.5, -0.6)};
    for (const named_map& near : orbits) {
        const named_map orbit = periodic_point(near);
        const recorder seen = watch(orbit);
        const double root = std::sqrt(1 - zeta * zeta);  // w = 1 in scaled units
        const double stance = seen.stance * w;
        const double u = seen.states[seen.first('T')][1] * w;
        const bool is_long = seen.first('T') < seen.first('-');
        const double force = is_long ? orbit.value("thrust") : 0.0;
        const double c = 2 * zeta;
        const double trace = std::exp(-zeta * stance) *
                             (2 * (1 - force) * std::cos(root * stance) +
                              std::sin(root * stance) / root * (c * force - 2 * u - force / u));
        const Eigen::MatrixXd j = orbit.image().jacobian;
        EXPECT_NEAR(j.trace(), trace, 1e-11);
        EXPECT_NEAR(j.determinant(), std::exp(-c * stance), 1e-12);
        if (!is_long) continue;
        // corrected Eq (53): 1 - tr + det = T / (u wd) e^{-zeta dt_on} B, B > 0 for stability
        const double on = seen.times[seen.first('T')] * w;
        const double off = stance - on;
        const double v = velocity_of(orbit);
        const double margin = std::sin(root * on) -
                              std::exp(-zeta * stance) * std::sin(root * off) -
                              2 * root * std::exp(-zeta * on) * v;
        EXPECT_NEAR(1 - j.trace() + j.determinant(),
                    force / (u * root) * std::exp(-zeta * on) * margin, 1e-10);
        EXPECT_EQ(margin > 0, largest_multiplier_modulus(orbit) < 1.0);
    }
}

TEST(openloop_regimes, exponents_sum_to_the_damping_of_the_time_on_the_ground) {
    for (const named_map& m : {hopper(1.55, 0.2, 0.24, -0.5, 0.3),
                               hopper(6.5, 0.02, 0.09, -1.0, 0.1), short_thrust(0.15, -1.0, 0.1)}) {
        const int periods = 400;
        double total = 0.0;  // period by period, as the exponents: a chaotic orbit is not repeated
        named_map at = m;
        for (int i = 0; i < periods; ++i) {
            total += watch(at).stance;
            at = at.after(1);
        }
        const double time = periods * m.value("stride_period");
        // 400 periods of 2 x 2 products, each good to some 1e-14
        EXPECT_NEAR(lyapunov(m, periods).sum, -2 * zeta * w * total / time, 1e-9);
    }
}

TEST(openloop_regimes, starts_from_inside_an_orbit_go_on_with_it) {
    for (const named_map& m : {short_thrust(0.15, -1.0, 0.1), long_thrust(0.26, -0.5, 0.6),
                               hopper(6.5, 0.02, 0.09, -1.0, 0.1)}) {
        const recorder seen = watch(m, 12);
        for (const auto& [section, letter] : {std::pair{"landing", 'L'}, {"takeoff", 'T'}}) {
            std::vector<std::size_t> events;
            for (std::size_t i = 0; i < seen.word.size(); ++i) {
                if (seen.word[i] == letter) events.push_back(i);
            }
            ASSERT_GT(events.size(), 3u);
            const double period = m.value("stride_period");
            named_map there("openloop_hopper", section, {});
            there.at.parameters = m.at.parameters;
            for (std::size_t k = 0; k + 1 < 4; ++k) {
                const std::size_t i = events[k];
                const std::size_t next = events[k + 1];
                there.start = {std::fmod(seen.times[i], period), seen.states[i][1]};
                const map_image f = there.image();
                ASSERT_EQ(f.end, outcome::ok);
                // the phase of the event carries the rounding of its time, some 1e-16 s
                EXPECT_NEAR(f.state[0], std::fmod(seen.times[next], period), 1e-12) << section << k;
                EXPECT_NEAR(f.state[1], seen.states[next][1], 1e-12) << section << k;
                EXPECT_NEAR(f.time, seen.times[next] - seen.times[i], 1e-12);
            }
        }
    }
}

TEST(openloop_regimes, only_four_groups_matter) {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> height(-3.0, 1.5), velocity(-2.0, 2.0);
    for (int i = 0; i < 40; ++i) {
        const named_map m = short_thrust(0.2, height(random), velocity(random));
        const double factor = 8.0;  // a power of two: the scaled numbers are the same bits
        const named_map slow = m.with({{"natural_frequency", w / factor},
                                       {"thrust_time", 0.02 * factor},
                                       {"stride_period", 0.2 * factor},
                                       {"height", m.start[0] * factor * factor},
                                       {"velocity", m.start[1] * factor}});
        const map_image f = m.image();
        const map_image g = slow.image();
        EXPECT_EQ(f.state[0] * factor * factor, g.state[0]);
        EXPECT_EQ(f.state[1] * factor, g.state[1]);
    }
}

TEST(openloop_regimes, passage_behind_a_fold_slows_down_like_the_root_of_the_distance) {
    const named_map fold =
        point_with_multiplier(long_thrust(0.275, -2.5, 0.1), "stride_period", 1.0);
    const auto passage = [&](double distance) {
        named_map m = fold.with("stride_period", fold.value("stride_period") + distance);
        int periods = 0;
        while ((m.point() - fold.point()).norm() * w * w < 0.05 && periods < 100000) {
            m = m.after(1);
            ++periods;
        }
        return periods;
    };
    const int near = passage(4e-10);
    const int nearer = passage(1e-10);
    EXPECT_GT(near, 100);
    EXPECT_NEAR(nearer / static_cast<double>(near), 2.0, 0.1);
}

TEST(openloop_regimes, convergence_at_a_flip_is_algebraic) {
    for (const double period : {0.12354, 0.156}) {
        const named_map near = short_thrust(period, -1.5, -0.6);
        const named_map flip = point_with_multiplier(near, "stride_period", -1.0);
        EXPECT_NEAR(flip.value("stride_period"), period, 6e-6 + 5e-5 * (period > 0.15));
        named_map m = flip;
        m.value("velocity") += 0.03 / w;
        const auto distance = [&](std::uint32_t periods) {
            return (m.after(periods).point() - flip.point()).norm();
        };
        // d ~ 1 / sqrt(n): four times the periods halve it
        EXPECT_NEAR(distance(16000) / distance(4000), 0.5, 0.05) << period;
    }
}

TEST(openloop_regimes, weak_attraction_looks_like_period_two_for_long) {
    const named_map orbit = periodic_point(hopper(1.55, 0.1, 0.26, -0.7176, 0.3013));
    EXPECT_NEAR(largest_multiplier(orbit), -0.98, 6e-3);
    named_map m = orbit;
    m.value("velocity") += 0.02 / w;
    m = m.after(100);
    const named_map next = m.after(1);
    const named_map second = m.after(2);
    const double once = (next.point() - m.point()).norm();
    const double twice = (second.point() - m.point()).norm();
    EXPECT_GT(once, 1e-6 / w);
    EXPECT_LT(twice, 0.1 * once);            // nearly back after two periods
    EXPECT_EQ(period_of(m.after(3000)), 1);  // but it is period 1
}

TEST(openloop_regimes, map_is_smooth_through_the_unforced_graze) {
    // beyond the threshold the body takes off; the Jacobian tends to that of staying like d^(1/2)
    named_map m("openloop_hopper", "strobe",
                {{"thrust", 0.0}, {"thrust_time", 0.02}, {"stride_period", 0.25}});
    const auto slope = [&](double beyond) {
        return m.with("velocity", -(2.7249892 + beyond) / w).image().jacobian;
    };
    const Eigen::MatrixXd stays = slope(-1e-4);
    const double near = (slope(1e-4) - stays).norm();
    const double nearer = (slope(1e-6) - slope(-1e-6)).norm();
    EXPECT_GT(near, 3 * nearer);
    EXPECT_LT(nearer, 0.1 * stays.norm());
}

TEST(openloop_regimes, landing_on_a_clock_edge_kinks_the_map) {
    // y = 2e-4, v = 0: the landing falls on the end of the thrust (t_on = 0.02 s)
    const auto slope = [](double shift) {
        return hopper(1.55, 0.02, 0.26).with("height", 2e-4 + shift).image().jacobian;
    };
    const Eigen::MatrixXd before = slope(-1e-9);
    const Eigen::MatrixXd after = slope(1e-9);
    EXPECT_GT((before - after).norm(), 1e-2 * before.norm());
    // each side is smooth by itself
    EXPECT_LT((slope(-2e-9) - before).norm(), 1e-3 * before.norm());
    EXPECT_LT((slope(2e-9) - after).norm(), 1e-3 * after.norm());
}

TEST(openloop_regimes, near_full_duty_ends_every_period_or_says_that_it_cannot) {
    const named_map m = hopper(1.55, 0.2, 0.205);
    double hops = 0.0;
    for (const double velocity : {-1.0, -0.2, 0.0, 0.3, 1.0}) {
        const orbit_answer late = m.with("velocity", velocity / w).answer(200);
        EXPECT_TRUE(late.end == outcome::ok || late.end == outcome::budget);
        if (late.end == outcome::ok) hops = std::max(hops, std::stod(late.extras[1]));
    }
    EXPECT_GT(hops, 2 * 200);  // several take-offs per period: chatter lives on
}

}  // namespace
}  // namespace hopscotch
