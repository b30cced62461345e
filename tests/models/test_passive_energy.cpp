// The passive map never gains: f(alpha) <= alpha in every rounding, for any mass ratio, bounce
// count and backend, over millions of returns (model page, section 9 H2).
#include "tests/models/passive_lane.hpp"
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using passive_rows::answers;
using passive_rows::rows;
using passive_rows::run;

struct tally {
    std::uint64_t returns = 0;
    std::uint64_t gains = 0;
    std::uint64_t other_ends = 0;
    double worst_alpha = 0.0;
    double worst_mass_ratio = 0.0;
};

/// One return from each of n random starts.
void count_gains(std::uint64_t n, std::uint64_t seed, bool is_elastic, tally& total) {
    std::mt19937_64 random(seed);
    const auto share = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
    rows of;
    of.columns.assign(1, std::vector<double>(n));
    of.mass_ratio.resize(n);
    if (is_elastic) of.restitution.resize(n);
    for (std::uint64_t i = 0; i < n; ++i) {
        double& alpha = of.columns[0][i];
        // uniform, next to lossless points, next to multiples of pi, small, large
        const std::uint64_t kind = random() % 8;
        const double k = 1.0 + static_cast<double>(random() % 12);
        const double side = (random() & 1) != 0 ? 1.0 : -1.0;
        const double tiny = side * std::exp(std::log(1e-16) * share());
        if (kind < 4) alpha = 20.0 * share();
        if (kind == 4) alpha = passive::lossless_point(k).high + tiny;
        if (kind == 5) alpha = k * M_PI + tiny;
        if (kind == 6) alpha = std::exp(std::log(1e-4) * share());
        if (kind == 7) alpha = 1000.0 * share();
        of.mass_ratio[i] = std::exp(std::log(1e12) * (2.0 * share() - 1.0));
        if ((random() & 7) == 0) of.mass_ratio[i] = 1.0;
        if (of.mass_ratio[i] > 300.0 && (random() & 15) != 0)
            of.mass_ratio[i] = 300.0 * share() + 0.01;
        if (is_elastic) of.restitution[i] = 0.9 * share();
    }
    of.max_steps = 4000.0;
    const answers all = run(of, passive_rows::fastest(),
                            is_elastic ? passive_rows::elastic : passive_rows::plastic);
    for (std::uint64_t i = 0; i < n; ++i) {
        if (all.end[i] == outcome::ok) {
            ++total.returns;
            if (all.speed[i] <= of.columns[0][i]) continue;
            ++total.gains;
            total.worst_alpha = of.columns[0][i];
            total.worst_mass_ratio = of.mass_ratio[i];
        } else if (all.end[i] != outcome::stuck && all.end[i] != outcome::budget &&
                   all.end[i] != outcome::rest) {
            ++total.other_ends;
            total.worst_alpha = of.columns[0][i];
            total.worst_mass_ratio = of.mass_ratio[i];
        }
    }
}

void expect_no_gain(std::uint64_t n, bool is_elastic) {
    tally total;
    std::uint64_t seed = 1;
    for (std::uint64_t done = 0; done < n;) {
        const std::uint64_t chunk = std::min<std::uint64_t>(n - done, 200000);
        count_gains(chunk, seed++, is_elastic, total);
        done += chunk;
    }
    EXPECT_GT(total.returns, n / 2);
    EXPECT_EQ(total.gains, 0u) << "alpha " << total.worst_alpha << " M " << total.worst_mass_ratio;
    EXPECT_EQ(total.other_ends, 0u)
        << "alpha " << total.worst_alpha << " M " << total.worst_mass_ratio;
}

TEST(passive_energy, no_return_gains_over_a_million_random_starts) {
    expect_no_gain(1000000, false);
}

TEST(passive_energy, no_elastic_return_gains_over_random_starts) { expect_no_gain(40000, true); }

TEST(passive_energy, slow_no_return_gains_over_a_hundred_million_random_starts) {
    expect_no_gain(100000000, false);
}

/// Successive returns of orbits that start right of alpha*_k, in the ordinary section.
void expect_descent(std::uint32_t n) {
    for (int k = 1; k <= 4; ++k) {
        for (const double mass_ratio : {1.0, 0.05, 20.0}) {
            for (const double start : {1e-4, 1e-9, 1e-14}) {  // inside T_k: r_4(1) is above 5e-4
                passive_lane::hand_stepped orbit(k, start, mass_ratio);
                double alpha = passive::lift_off_speed(orbit.lane);
                for (std::uint32_t i = 0; i < n / 9; ++i) {
                    ASSERT_TRUE(orbit.hop());
                    const double next = passive::lift_off_speed(orbit.lane);
                    ASSERT_LE(next, alpha) << k << " " << mass_ratio << " return " << i;
                    ASSERT_GT(orbit.lane.beta, 0.0);  // and never falls through
                    alpha = next;
                }
            }
        }
    }
}

TEST(passive_energy, successive_returns_to_each_lossless_point_never_rise) {
    expect_descent(100000);
}

TEST(passive_energy, slow_a_million_successive_returns_to_each_lossless_point_never_rise) {
    expect_descent(9000000);
}

TEST(passive_energy, successive_returns_from_the_left_fall_through_every_cell_and_never_rise) {
    for (const double mass_ratio : {0.4, 1.0, 3.0, 1e-9, 200.0}) {
        for (int k = 1; k <= 4; ++k) {
            for (const double start : {-1e-14, -1e-9, -1e-3, -1.0}) {
                passive_lane::hand_stepped orbit(k, start, mass_ratio);
                double alpha = passive::lift_off_speed(orbit.lane);
                for (int i = 0; i < 1000 && orbit.hop(); ++i) {
                    const double next = passive::lift_off_speed(orbit.lane);
                    ASSERT_LE(next, alpha) << k << " " << start << " " << mass_ratio;
                    alpha = next;
                }
            }
        }
    }
}

TEST(passive_energy, reported_loss_is_the_drop_of_alpha_squared) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    rows of;
    of.columns.assign(1, {});
    of.mass_ratio.clear();
    of.restitution.clear();
    for (int i = 0; i < 4000; ++i) {
        of.columns[0].push_back(0.01 + 15.0 * share(random));
        of.mass_ratio.push_back(std::exp(std::log(1e3) * (2.0 * share(random) - 1.0)));
        of.restitution.push_back(i % 2 == 0 ? 0.0 : 0.95 * share(random));
    }
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        const double alpha = of.columns[0][i];
        if (all.end[i] != outcome::ok) continue;
        const double drop = (alpha - all.speed[i]) * (alpha + all.speed[i]);
        // alpha^2 in double, and one rounding of the sum per bounce
        EXPECT_NEAR(all.loss[i], drop, (4.0 + all.bounces[i]) * 4e-16 * alpha * alpha) << alpha;
    }
}

TEST(passive_energy, loss_adds_up_over_returns) {
    const rows of{.columns = {{4.6, 9.9, 11.0, 14.3}}, .mass_ratio = {0.2}, .returns = 50};
    const answers all = run(of);
    for (std::size_t i = 0; i < all.end.size(); ++i) {
        ASSERT_EQ(all.end[i], outcome::ok);
        const double alpha = of.columns[0][i];
        const double drop = (alpha - all.speed[i]) * (alpha + all.speed[i]);
        EXPECT_NEAR(all.loss[i], drop, 50.0 * 4e-16 * alpha * alpha);  // a rounding per return
    }
}

}  // namespace
}  // namespace hopscotch
