// The passive hopper's mass ratio, added energy and budgets (models/passive_hopper.md, sections 1,
// 5 and 8).
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::answers;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;
using passive_rows::single_return;
using passive_rows::start;

constexpr double inf = std::numeric_limits<double>::infinity();

// ---- mass ratio ----

TEST(passive_parameters, light_foot_keeps_the_speed_but_for_its_share) {
    for (const double mass_ratio : {1e-5, 1e-8, 1e-12}) {
        for (const double alpha : {0.9, 4.2, 5.5, 9.9}) {
            const single_return one = hop(alpha, mass_ratio);
            ASSERT_EQ(one.end, outcome::ok);
            // loss = kappa sum G'^2 with |G'| <= 2 x < alpha + 3 and at most two impacts
            EXPECT_LE(one.speed, alpha);
            EXPECT_GE(one.speed, alpha - mass_ratio * 2.0 * (alpha + 3.0) * (alpha + 3.0) / alpha);
            EXPECT_LE(one.bounces, 1.0);
        }
    }
}

TEST(passive_parameters, up_to_mass_ratio_0_7_there_is_at_most_one_bounce) {
    rows of{.mass_ratio = {0.7}};
    of.columns.emplace_back();
    for (int i = 0; i < 20000; ++i) of.columns[0].push_back(0.01 * (i + 0.5));
    for (const double mass_ratio : {0.05, 0.3, 0.7}) {
        of.mass_ratio = {mass_ratio};
        const answers all = run(of, passive_rows::fastest());
        for (std::size_t i = 0; i < all.end.size(); ++i)
            ASSERT_LE(all.bounces[i], 1.0) << of.columns[0][i];
    }
}

TEST(passive_parameters, mass_ratio_1e5_bounces_thousands_of_times_within_its_budget) {
    rows of{
        .columns = {{3.17, 3.3, 3.45, 3.6, 3.72}}, .mass_ratio = {1e5}, .max_steps = 1.0 + 0.2e5};
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        ASSERT_EQ(all.end[i], outcome::ok);
        const double alpha = of.columns[0][i];
        EXPECT_LT(all.speed[i], M_PI);
        EXPECT_GT(all.speed[i], M_PI - 0.2);
        const double kappa = 1e5 / (100001.0 * 100001.0);
        // each period-one bounce takes 4 pi^2 kappa; period two and the ends differ by percents
        const double steady = (alpha * alpha - M_PI * M_PI) / (4.0 * M_PI * M_PI * kappa);
        EXPECT_NEAR(all.bounces[i] / steady, 1.0, 0.1) << alpha;
        const double drop = (alpha - all.speed[i]) * (alpha + all.speed[i]);
        EXPECT_NEAR(all.loss[i], drop, 1e-14 * all.bounces[i]);
    }
}

TEST(passive_parameters, heavy_foot_tends_to_the_unbounded_juggler) {
    for (const double alpha : {1.3, 4.7, 5.9, 8.0}) {
        const auto limit =
            run({.model = "passive_juggler", .columns = {{alpha}}, .mass_ratio = {inf}});
        const auto near =
            run({.model = "passive_juggler", .columns = {{alpha}}, .mass_ratio = {1e9}});
        EXPECT_NEAR(limit.speed[0], near.speed[0], 1e-6);  // kappa = 1e-9, loss below 1e3 kappa
        EXPECT_NEAR(limit.time[0], near.time[0], 1e-5);
    }
}

TEST(passive_parameters, both_machines_share_the_lift_off_map) {
    rows of{.restitution = {0.3}};
    of.columns.emplace_back();
    for (int i = 0; i < 100; ++i) of.columns[0].push_back(0.1 + 0.12 * i);
    const answers hopper = run(of);
    of.model = "passive_juggler";
    const answers juggler = run(of);
    EXPECT_EQ(hopper.speed, juggler.speed);
    EXPECT_EQ(hopper.time, juggler.time);
    EXPECT_EQ(hopper.end, juggler.end);
}

// ---- added speed ----

TEST(passive_parameters, increment_is_added_once_at_each_lift_off) {
    for (const double increment : {0.05, -0.05, 1.0, -1.0}) {
        for (const double alpha : {2.0, 4.6, 7.9, 9.9}) {
            const single_return plain = hop(alpha, 0.2);
            const single_return pushed = hop(alpha, 0.2, 0.0, 0.0, increment);
            ASSERT_EQ(plain.end, outcome::ok);
            EXPECT_EQ(pushed.end, outcome::ok);
            EXPECT_NEAR(pushed.speed, plain.speed + increment, 4e-15) << alpha << " " << increment;
            EXPECT_EQ(pushed.loss, plain.loss);
            EXPECT_EQ(pushed.time, plain.time);
        }
    }
}

TEST(passive_parameters, increment_that_takes_all_the_speed_ends_the_orbit) {
    const double f = hop(2.0, 0.2).speed;
    EXPECT_EQ(hop(2.0, 0.2, 0.0, 0.0, -f).end, outcome::stuck);
    EXPECT_EQ(hop(2.0, 0.2, 0.0, 0.0, -2.0 * f).end, outcome::stuck);
    EXPECT_EQ(hop(2.0, 0.2, 0.0, 0.0, -0.99 * f).end, outcome::ok);
}

TEST(passive_parameters, increment_does_not_revive_a_stuck_hopper) {
    EXPECT_EQ(hop(2.0, 1.0).end, outcome::stuck);
    EXPECT_EQ(hop(2.0, 1.0, 0.0, 0.0, 3.0).end, outcome::stuck);
}

TEST(passive_parameters, certificate_claims_nothing_above_zero_increment) {
    const model_entry* const entry = find_model("passive_hopper");
    const auto covers = [&](double restitution, double damping, double increment) {
        const double point[] = {1.0, restitution, damping, increment, 0.0, 0.0, 0.0};
        return entry->certificate_covers({.lowest = point, .highest = point, .options = nullptr});
    };
    EXPECT_TRUE(covers(0.0, 0.0, 0.0));
    EXPECT_TRUE(covers(0.0, 0.0, -0.1));
    EXPECT_TRUE(covers(0.5, 0.1, 0.0));
    EXPECT_FALSE(covers(0.0, 0.0, 0.01));
    EXPECT_FALSE(covers(0.5, 0.0, 0.0));
    // M = 1, alpha = 4.5: T_1 without increment; with it, nothing may be labelled by T_k
    const answers pushed = run({.columns = {{4.5}},
                                .increment = {0.05},
                                .returns = 300,
                                .decided_by = decision::certificate,
                                .died_label = 1});
    EXPECT_EQ(pushed.end[0], outcome::budget);
    EXPECT_EQ(pushed.label[0], 0);
}

TEST(passive_parameters, negative_increment_kills_every_orbit) {
    rows of{.mass_ratio = {0.05},
            .increment = {-1e-3},
            .returns = 30000,
            .decided_by = decision::certificate,
            .died_label = 1};
    of.columns.emplace_back();
    for (int i = 1; i < 60; ++i) of.columns[0].push_back(0.25 * i);
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        EXPECT_EQ(all.end[i], outcome::attracted) << of.columns[0][i];
        EXPECT_EQ(all.label[i], 1) << of.columns[0][i];
    }
}

// ---- budget ----

TEST(passive_parameters, budget_of_steps_per_return_ends_an_orbit_and_says_so) {
    // 5 bounces and the last flight: 6 steps
    const rows enough{.columns = {{3.4}}, .mass_ratio = {100.0}, .max_steps = 7.0};
    EXPECT_EQ(run(enough).end[0], outcome::ok);
    rows too_few = enough;
    too_few.max_steps = 4.0;
    const answers spent = run(too_few);
    EXPECT_EQ(spent.end[0], outcome::budget);
    EXPECT_EQ(spent.returns[0], 0u);
    EXPECT_EQ(spent.speed[0], 3.4);  // the last section state reached
}

TEST(passive_parameters, returns_count_completed_ones_only) {
    const answers all = run({.columns = {{2.0, 4.6, 6.0}}, .mass_ratio = {1.0}, .returns = 100});
    EXPECT_EQ(all.end[0], outcome::stuck);
    EXPECT_EQ(all.returns[0], 0u);
    EXPECT_EQ(all.end[2], outcome::stuck);
    EXPECT_EQ(all.returns[2], 0u);
    // 4.6 -> 4.392 (left of alpha*_1) -> ...
    simulator hopper({});
    real50 alpha(4.6);
    std::uint32_t n = 0;
    for (;; ++n) {
        const history next = hopper.from_lift_off(alpha);
        if (!next.lifts || n == 100) break;
        alpha = next.speed;
        if (n > 20) break;
    }
    if (n < 20) EXPECT_EQ(all.returns[1], n);
}

}  // namespace
}  // namespace hopscotch
