// The passive hopper's restitution and damping: limits, chatter, energy (models/passive_hopper.md,
// sections 1, 2 and 6).
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::answers;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;
using passive_rows::single_return;
using passive_rows::start;

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

}  // namespace
}  // namespace hopscotch
