// Restitution, damping, mass ratios from 1e-5 to infinity, added speed of either sign, and budgets:
// what each parameter must do to an orbit (model page, sections 2, 5, 6 and 8).
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

// ---- restitution ----

TEST(passive_parameters, lossless_motions_persist_for_every_restitution) {
    for (int k = 1; k <= 6; ++k) {
        const double alpha = to_double(lossless(k));
        for (const double restitution : {0.0, 0.1, 0.5, 0.9, 0.99}) {
            for (const double mass_ratio : {0.1, 1.0, 12.0}) {
                const single_return one = hop(alpha, mass_ratio, restitution);
                ASSERT_EQ(one.end, outcome::ok) << k << " " << restitution;
                // rounding puts the start 1e-15 beside it; the loss there is 1e-20
                EXPECT_NEAR(one.speed, alpha, 1e-14) << k << " " << restitution;
                EXPECT_LT(one.loss, 1e-12);
            }
        }
    }
}

TEST(passive_parameters, chatter_comes_to_rest_with_geometric_times) {
    // spring far compressed: the foot bounces on nearly constant pull; times add up to a geometric
    // series
    for (const double restitution : {0.3, 0.5, 0.8, 0.9}) {
        const single_return one = start(-8.0, 0.0, 0.0, 1e-3, 1.0, restitution);
        ASSERT_EQ(one.end, outcome::ok);
        // the first impacts at G' = -2e-3 lose kappa (1 - e^2) G'^2 e^(2 i): in sum kappa G'^2
        EXPECT_NEAR(one.loss / (0.25 * 4e-6), 1.0, 1e-3);  // pull changes by 1e-3 meanwhile
        // impacts with |v2-| = 1e-3 e^i above 1e-8
        const double audible = std::floor(std::log(1e-5) / std::log(restitution)) + 1.0;
        EXPECT_NEAR(one.bounces, audible, 1.0) << restitution;
        // (Y - 1)(Y + 3) / 2 from rest, and the foot's energy is lost
        EXPECT_NEAR(one.speed, std::sqrt(22.5), 1e-3);
    }
}

TEST(passive_parameters, restitution_close_to_1_still_comes_to_rest) {
    const single_return one = start(-8.0, 0.0, 0.0, 1e-4, 1.0, 0.999);
    ASSERT_EQ(one.end, outcome::ok);
    EXPECT_NEAR(one.loss / (0.25 * 4e-8), 1.0,
                0.05);  // pull changes over the chatter's 0.02 time units
    EXPECT_NEAR(one.speed, std::sqrt(22.5), 1e-3);
}

TEST(passive_parameters, restitution_0_999_ends_every_hop_with_an_outcome_and_without_gain) {
    rows of{.restitution = {0.999}, .max_steps = 20000.0};
    of.columns.emplace_back();
    for (int i = 0; i < 40; ++i) of.columns[0].push_back(0.2 + 0.3 * i);
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        EXPECT_TRUE(all.end[i] == outcome::ok || all.end[i] == outcome::budget ||
                    all.end[i] == outcome::stuck)
            << of.columns[0][i] << " " << name_of(all.end[i]);
        if (all.end[i] == outcome::ok) EXPECT_LE(all.speed[i], of.columns[0][i]);
        EXPECT_LE(all.loss[i], of.columns[0][i] * of.columns[0][i] * (1.0 + 1e-12) + 4.0);
    }
}

TEST(passive_parameters, elastic_impacts_end_by_budget_and_lose_nothing) {
    rows of{.columns = {{0.7, 2.0, 4.4, 4.6, 9.3}}, .restitution = {1.0}, .max_steps = 2000.0};
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        EXPECT_EQ(all.end[i], outcome::budget) << of.columns[0][i];
        EXPECT_EQ(all.loss[i], 0.0);
        EXPECT_EQ(all.returns[i], 0u);
        EXPECT_GT(all.bounces[i], 1000.0);
    }
}

TEST(passive_parameters, restitution_0_through_the_elastic_kernel_is_the_plastic_map) {
    rows of;
    of.columns.emplace_back();
    for (int i = 0; i < 500; ++i) of.columns[0].push_back(0.013 + 0.0297 * i);
    for (const double mass_ratio : {0.2, 1.0, 30.0}) {
        of.mass_ratio = {mass_ratio};
        const answers plain = run(of, backend::scalar, passive_rows::plastic);
        const answers general = run(of, backend::scalar, passive_rows::elastic);
        for (std::size_t i = 0; i < plain.end.size(); ++i) {
            ASSERT_EQ(plain.end[i], general.end[i]) << of.columns[0][i];
            EXPECT_EQ(plain.speed[i], general.speed[i]) << of.columns[0][i];
            EXPECT_EQ(plain.bounces[i], general.bounces[i]);
        }
    }
}

TEST(passive_parameters, small_restitution_tends_to_the_plastic_map) {
    for (const double alpha : {2.0, 4.6, 7.9, 9.9}) {
        const single_return plain = hop(alpha, 0.3);
        for (const double restitution : {1e-3, 1e-6, 1e-12}) {
            const single_return near = hop(alpha, 0.3, restitution);
            ASSERT_EQ(near.end, plain.end);
            // first order in e, coefficient below alpha
            EXPECT_NEAR(near.speed, plain.speed, 2.0 * alpha * restitution + 4e-15) << alpha;
        }
    }
}

// ---- damping ----

TEST(passive_parameters, damped_kernel_without_damping_is_the_undamped_map) {
    for (const double alpha : {0.8, 2.9, 4.4, 4.6, 6.6, 9.9}) {
        for (const double mass_ratio : {0.2, 1.0, 20.0}) {
            const answers general = run({.columns = {{alpha}}, .mass_ratio = {mass_ratio}},
                                        backend::scalar, passive_rows::damped);
            const single_return plain = hop(alpha, mass_ratio);
            ASSERT_EQ(general.end[0], plain.end) << alpha << " " << mass_ratio;
            if (plain.end != outcome::ok) continue;
            // other formulas: a direct root of the gap, whose rounding f' < 50 multiplies
            EXPECT_NEAR(general.speed[0], plain.speed, 1e-12) << alpha << " " << mass_ratio;
            EXPECT_NEAR(general.time[0], plain.time, 1e-12 * plain.time);
        }
    }
}

TEST(passive_parameters, damping_ends_every_orbit) {
    rows of{.damping = {0.02}, .returns = 5000};
    of.columns.emplace_back();
    for (int i = 1; i < 60; ++i) of.columns[0].push_back(0.25 * i);
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        EXPECT_TRUE(all.end[i] == outcome::stuck || all.end[i] == outcome::rest)
            << of.columns[0][i];
        EXPECT_LT(all.returns[i], 5000u);
    }
}

TEST(passive_parameters, damped_energy_at_lift_off_falls_from_hop_to_hop) {
    // E / (1 + M) at lift-off with y1 = s = 1 - 2 zeta alpha
    const auto energy = [](double alpha, double mass_ratio, double damping) {
        const double y = 1.0 - 2.0 * damping * alpha;
        return 0.5 * (1.0 + mass_ratio) * alpha * alpha + 0.5 * mass_ratio * y * y + y;
    };
    for (const double damping : {1e-3, 0.05, 0.4}) {
        for (const double mass_ratio : {0.1, 1.0, 8.0}) {
            for (double alpha = 2.0; alpha < 20.0; alpha += 0.37) {
                const single_return one = hop(alpha, mass_ratio, 0.0, damping);
                if (one.end != outcome::ok) continue;
                EXPECT_LT(energy(one.speed, mass_ratio, damping),
                          energy(alpha, mass_ratio, damping));
            }
        }
    }
}

TEST(passive_parameters, damped_lift_off_section_below_twice_the_damping_is_contact) {
    // F = 1 falls there (F' = alpha - 2 zeta): the same as standing on the ground in that state
    for (const double damping : {0.1, 0.4}) {
        for (const double share : {0.2, 0.6, 0.95}) {
            const double alpha = 2.0 * damping * share;
            const single_return lift = hop(alpha, 1.0, 0.0, damping);
            // y1 = 1 - 2 zeta alpha, a little lower so that F < 1 beyond doubt
            const single_return stand =
                start(1.0 - 2.0 * damping * alpha - 1e-12, alpha, 0.0, 0.0, 1.0, 0.0, damping);
            EXPECT_EQ(lift.end, stand.end) << damping << " " << alpha;
        }
    }
}

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
