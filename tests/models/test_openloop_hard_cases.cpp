// The clock-driven hopper: the numerically hard cases of its page (section 8), and what ends an
// orbit.
#include "tests/models/openloop_machine.hpp"

#include "kernels/models/openloop_hopper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace hopscotch {
namespace {

using namespace testing_models::openloop_machine;

TEST(openloop_hopper, unforced_graze_is_at_landing_speed_2_7249892) {
    machine m = short_thrust(5.0);  // no thrust after the landing
    m.thrust = 0.0;
    EXPECT_EQ(watch(m, 0.0, -2.7249891 / 30).word(), "-+");
    EXPECT_EQ(watch(m, 0.0, -2.7249893 / 30).word().substr(0, 2), "-T");
}

TEST(openloop_hopper, forced_graze_is_at_landing_speed_1_0899957) {
    machine m{.thrust = 0.6, .on = 4.0, .period = 5.0};
    EXPECT_EQ(watch(m, 0.0, -1.0899956 / 30).word(), "-+");
    EXPECT_EQ(watch(m, 0.0, -1.0899958 / 30).word().substr(0, 2), "TL");
    // square-root singularity: the Jacobian grows like distance^(-1/2)
    m.on = 0.22;
    m.period = 0.25;
    const auto size = [&](double d) { return std::abs(map(m, {0.0, -1.08999572 - d}).j[3]); };
    EXPECT_GT(size(1e-6), 5 * size(1e-4));
}

TEST(openloop_hopper, a_landing_on_a_clock_edge_comes_before_it) {
    machine m = long_thrust();
    m.on = 0.02;
    EXPECT_EQ(watch(m, 2e-4, 0.0).word().substr(0, 2), "L-");  // sqrt(2 y) = t_on
    machine whole = long_thrust();
    const recorder seen = watch(whole, 0.0, 0.13);  // 2 v = tau
    EXPECT_EQ(seen.word(), "-L+");
    const orbit a = run(whole, 0, 0.0, 0.13);
    EXPECT_NEAR(column(a, 0), 0.0, 1e-16);
    EXPECT_NEAR(column(a, 1), -0.13, 1e-16);
    const orbit landing =
        run(whole, 2, 0.0, 0.13);  // take-off at phase 0: back at phase 0, not at tau
    EXPECT_LT(column(landing, 0), whole.period);
}

TEST(openloop_hopper, chatter_is_followed_flight_by_flight) {
    machine m{.thrust = 1.55, .on = 0.2, .period = 0.21};
    EXPECT_EQ(run(m, 0, 0.0, 1e-4).extras[1], print_real(464.0));
    EXPECT_EQ(run(m, 0, 0.0, 1e-5).extras[1], print_real(4644.0));
    const recorder seen = watch(m, 0.0, 1e-5);
    double last = 0.0;
    for (const auto& e : seen.events) {
        if (e.name == "take-off") last = e.before[1];
    }
    EXPECT_NEAR(last / 1e-5, 0.597, 6e-4);
}

TEST(openloop_hopper, a_body_at_the_two_fold_is_held_until_the_thrust_ends) {
    machine m{.thrust = 1.55, .on = 0.2, .period = 0.21};
    EXPECT_EQ(watch(m, 0.0, 0.0).word(), "-+");
    const orbit held = run(m, 0, 0.0, 0.0), nearly = run(m, 0, 1e-18, 0.0);
    EXPECT_EQ(nearly.end, outcome::ok);
    EXPECT_LT(std::stod(nearly.extras[1]), 3.0);              // not ten million flights
    EXPECT_NEAR(column(nearly, 1), column(held, 1), 1.5e-9);  // sqrt(2 y)
    m.thrust = 1.0;                                           // equilibrium
    EXPECT_EQ(watch(m, 0.0, 0.0).word(), "-+");
    m.thrust = 0.9;
    EXPECT_EQ(watch(m, 0.0, 0.0).word(), "-+");
}

TEST(openloop_hopper, chatter_beyond_the_budget_is_reported) {
    machine m{.thrust = 1.55, .on = 0.2, .period = 0.21};
    const orbit a = run(m, 0, 0.0, 2e-7);
    EXPECT_EQ(a.end, outcome::budget);
    EXPECT_EQ(column(a, 1), 2e-7);  // the last section state is the start
}

TEST(openloop_hopper, tiny_thrust_time_tends_to_no_thrust) {
    for (double on : {1e-9, 1e-12}) {
        machine m = short_thrust();
        m.on = on;
        machine none = m;
        none.thrust = 0.0;
        const double impulse = m.thrust * on;  // change of velocity, at most
        EXPECT_NEAR(column(run(m, 0, -1e-3, 0.02), 1), column(run(none, 0, -1e-3, 0.02), 1),
                    10 * impulse + 1e-16);
    }
}

TEST(openloop_hopper, huge_thrust_for_a_tiny_time_keeps_its_digits) {
    const machine m{.thrust = 1e6, .on = 1e-8, .period = 0.2};
    const orbit got = run(m, 0, -1e-3, -0.01);
    const orbit truth = run(m, 0, -1e-3, -0.01, 1, false, table().run_mp50);
    EXPECT_NEAR(column(got, 0) * 900, std::stod(truth.columns[0]) * 900, 2e-13);
    EXPECT_NEAR(column(got, 1) * 30, std::stod(truth.columns[1]) * 30, 2e-13);
}

TEST(openloop_hopper, a_long_flight_passes_all_clock_edges) {
    const machine m = long_thrust();
    const recorder seen = watch(m, 0.5, 3.0, 30);
    int edges = 0;
    for (const auto& e : seen.events) {
        if (e.name == "landing") break;
        ++edges;
    }
    EXPECT_GT(edges, 20);
    const auto& landing = seen.events[static_cast<std::size_t>(edges)];
    EXPECT_NEAR(landing.time, 3 + std::sqrt(10.0), 2e-15 * 10);
    EXPECT_NEAR(landing.before[1], -std::sqrt(10.0), 1e-15 * 4);
}

TEST(openloop_hopper, lands_with_exactly_the_take_off_speed) {
    const machine m = long_thrust();
    const orbit landing = run(m, 1, 0.2, -0.09);
    const recorder seen = watch(m, 0.2, -0.09, 1, 1);
    for (const auto& e : seen.events) {
        if (e.name == "take-off") EXPECT_EQ(-e.before[1], column(landing, 1));
    }
}

TEST(openloop_hopper, critical_damping_is_smooth_from_both_sides) {
    machine m = long_thrust();
    const auto at = [&](double zeta) {
        m.zeta = zeta;
        return map(m, {0.5, 1.0}).to;
    };
    const point below = at(1 - 1e-10), critical = at(1), above = at(1 + 1e-10);
    EXPECT_NEAR(below.height, critical.height, 1e-9);
    EXPECT_NEAR((below.height + above.height) / 2, critical.height, 1e-15 * 8);
    EXPECT_NEAR((below.velocity + above.velocity) / 2, critical.velocity, 1e-15 * 8);
}

TEST(openloop_hopper, undamped_guards_are_the_same) {
    machine length = short_thrust(0.2), force = length;
    length.zeta = force.zeta = 0.0;
    force.guard = 1;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> h(-2, 1), v(-2, 2);
    for (int i = 0; i < 50; ++i) {
        const point x{h(random), v(random)};
        const image a = map(length, x), b = map(force, x);
        double spread = 1;
        for (double j : a.j) spread = std::max(spread, std::abs(j));
        EXPECT_NEAR(a.to.height, b.to.height, 1e-13 * spread);
        EXPECT_NEAR(a.to.velocity, b.to.velocity, 1e-13 * spread);
    }
}

TEST(openloop_hopper, weak_attraction_is_not_mistaken_for_period_two) {
    const machine m{.on = 0.1, .period = 0.26};
    const point x = periodic_point(m, {-0.7176, 0.3013});
    EXPECT_NEAR(map(m, x).larger(), -0.98, 6e-4);
}

TEST(openloop_hopper, sections_of_events_report_that_none_will_come) {
    const machine m{.thrust = 2.5, .on = 0.02, .period = 0.15};
    EXPECT_EQ(run(m, 1, 0.1, -0.05).end, outcome::no_hop);
    EXPECT_EQ(run(m, 2, 0.1, 0.02, 3).end, outcome::no_hop);
    EXPECT_LT(run(m, 2, 0.1, 0.02, 3).returns, 3u);
    EXPECT_EQ(run(m, 0, -0.001, 0.0, 3).end,
              outcome::ok);  // the stroboscopic section always returns
}

TEST(openloop_hopper, refuses_what_is_no_start) {
    const machine m = long_thrust();
    EXPECT_EQ(run(m, 1, 0.1, 0.05).end, outcome::invalid_start);
    EXPECT_EQ(run(m, 2, 0.1, -0.05).end, outcome::invalid_start);
    EXPECT_EQ(run(m, 1, 0.26, -0.05).end, outcome::invalid_start);
    EXPECT_EQ(run_texts(table().run_double, m, 0, {"nan", "0"}, 1).end, outcome::invalid_start);
    EXPECT_EQ(run(m, 0, 1e300, 1e300).end, outcome::not_finite);
    machine reversed = m;
    reversed.on = 0.3;
    EXPECT_EQ(run(reversed, 0, 0.0, 0.0).end, outcome::invalid_start);
    const double parameters[] = {30, 0.2, 1.55, 0.3, 0.26};
    EXPECT_FALSE(openloop_hopper::refusal(parameters, nullptr).empty());
}

TEST(openloop_hopper, counts_time_events_and_hops) {
    const orbit a = run(long_thrust(), 0, -0.00272, -0.0242, 1000);
    EXPECT_EQ(a.events, 4000u);
    EXPECT_EQ(std::stod(a.extras[1]), 1000.0);
    EXPECT_NEAR(std::stod(a.time), 260.0, 260 * 1e-13);
}

}  // namespace
}  // namespace hopscotch
