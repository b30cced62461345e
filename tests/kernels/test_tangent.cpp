// Lyapunov exponents of the tangent ensemble against closed forms: values, error bars that hold the
// truth as often as they say, stopping by error, transients, and orbits without an exponent.
#include "kernels/ensemble/tangent.hpp"
#include "tests/kernels/known_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

using namespace known_maps;
constexpr double inf = std::numeric_limits<double>::infinity();

/// Cells with their own starts and parameters, and what the ensemble gave for them.
struct exponent_run {
    std::vector<double> x, y, p, q;
    exponent_request wanted{.transient = 100, .block = 100};
    std::uint32_t max_returns = 10100;
    int section = 0;

    std::vector<double> largest, second, rate, error;
    std::vector<std::uint32_t> used, returns;
    std::vector<std::uint8_t> motion, ends;

    std::size_t size() const { return x.size(); }
    void add(double start_x, double start_y, double first, double other) {
        x.push_back(start_x);
        y.push_back(start_y);
        p.push_back(first);
        q.push_back(other);
    }
    enum motion motion_of(std::size_t i) const { return static_cast<enum motion>(motion[i]); }

    template <class Map>
    void compute() {
        const std::size_t n = size();
        for (auto* of : {&largest, &second, &rate, &error}) of->assign(n, -77.0);
        for (auto* of : {&used, &returns}) of->assign(n, 77u);
        for (auto* of : {&motion, &ends}) of->assign(n, 77u);
        ensemble_request request;
        request.n_cells = n;
        request.section = section;
        request.columns[0] = {x.data(), 1, n};
        if (Map::n_columns == 2 || section == 1) request.columns[1] = {y.data(), 1, n};
        request.parameters[0] = {p.data(), 1, n};
        request.parameters[1] = {q.data(), 1, n};
        request.max_returns = max_returns;
        request.outcome = ends.data();
        request.returns = returns.data();
        request.exponents = wanted;
        request.exponents.exponents[0] = largest.data();
        request.exponents.exponents[1] = Map::n_columns == 2 ? second.data() : nullptr;
        request.exponents.rate = rate.data();
        request.exponents.standard_error = error.data();
        request.exponents.returns = used.data();
        request.exponents.motion = motion.data();
        run_tangent_ensemble<map_model<Map>, 0, double>(request);
    }
};

double entropy(double p) { return -p * std::log(p) - (1.0 - p) * std::log(1.0 - p); }

/// Many cells of a map, at random starts.
exponent_run random_cells(std::size_t n, const std::function<double(double)>& parameter,
                          std::uint64_t seed = 5) {
    std::mt19937_64 bits(seed);
    const auto share = [&] { return std::ldexp(static_cast<double>(bits() >> 11), -53); };
    exponent_run run;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = share();
        const double y = share();
        run.add(x, y, parameter(share()), 0.3);
    }
    return run;
}

TEST(tangent_ensemble, gives_the_slope_of_a_tent_to_rounding) {
    exponent_run run;
    for (const double slope : {1.2, 1.5, 1.9, 1.999}) run.add(0.3137, 0.0, slope, 0.0);
    run.compute<tent_map>();
    for (std::size_t i = 0; i < run.size(); ++i) {
        // 1e4 products of the slope, each rounded once
        EXPECT_NEAR(run.largest[i], std::log(run.p[i]), 1e-15) << run.p[i];
        EXPECT_LT(run.error[i], 1e-15);
        EXPECT_EQ(run.motion_of(i), motion::chaotic);
        EXPECT_EQ(run.used[i], 10000u);
        EXPECT_NEAR(run.rate[i], 2.0 * std::log(run.p[i]), 1e-14);  // half a unit of time each
    }
}

TEST(tangent_ensemble, error_bars_of_a_skew_tent_hold_the_truth_in_95_percent_of_many_cells) {
    exponent_run run = random_cells(3000, [](double s) { return 0.1 + 0.3 * s; });
    run.compute<skew_tent_map>();
    int held = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
        const double off = run.largest[i] - entropy(run.p[i]);
        held += std::abs(off) <= 1.959964 * run.error[i] ? 1 : 0;
        EXPECT_LT(std::abs(off), 6.0 * run.error[i]);
    }
    // binomial scatter of the share is 0.4 %; positive correlations of chance make bars longer
    EXPECT_GT(held, static_cast<int>(0.94 * 3000));
    EXPECT_LT(held, static_cast<int>(0.985 * 3000));
}

TEST(tangent_ensemble, error_bars_hold_the_truth_where_orbits_stop_by_their_error) {
    exponent_run run = random_cells(
        3000, [](double s) { return 0.1 + 0.3 * s; }, 8);
    run.wanted.error = 0.01;
    run.max_returns = 200100;
    run.compute<skew_tent_map>();
    int held = 0;
    int n_dropped = 0;  // cells where a drift was seen that is not there
    std::uint32_t longest = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
        EXPECT_LT(run.error[i], 0.01);
        EXPECT_GE(run.used[i], 1600u);
        n_dropped += run.returns[i] == run.used[i] + 100u ? 0 : 1;
        longest = std::max(longest, run.used[i]);
        held += std::abs(run.largest[i] - entropy(run.p[i])) <= 1.959964 * run.error[i] ? 1 : 0;
    }
    EXPECT_LT(longest, 30000u);  // spread per return is below 1.1: about 1e4 returns are enough
    EXPECT_GT(held,
              static_cast<int>(0.93 * 3000));  // stopping by error favours small ones a little
}

TEST(tangent_ensemble, logistic_map_at_four_has_exponent_ln_2_with_a_cautious_error) {
    exponent_run run = random_cells(300, [](double) { return 4.0; });
    run.compute<logistic_map>();
    for (std::size_t i = 0; i < run.size(); ++i) {
        // the sum is n ln 2 and a bounded-variance rest: the bar, which uses no negative
        // correlation, is too long
        EXPECT_LT(std::abs(run.largest[i] - std::log(2.0)), 3.0 * run.error[i] + 1e-9);
        EXPECT_LT(run.error[i], 0.02);
        EXPECT_EQ(run.motion_of(i), motion::chaotic);
    }
}

TEST(tangent_ensemble, cat_map_has_both_exponents_to_rounding) {
    exponent_run run = random_cells(20, [](double) { return 0.0; });
    run.compute<cat_map>();
    const double truth = std::log((3.0 + std::sqrt(5.0)) / 2.0);
    for (std::size_t i = 0; i < run.size(); ++i) {
        EXPECT_NEAR(run.largest[i], truth, 1e-13);
        EXPECT_NEAR(run.second[i], -truth, 1e-13);
    }
}

TEST(tangent_ensemble, bakers_map_has_both_exponents_within_their_errors) {
    exponent_run run = random_cells(200, [](double s) { return 0.2 + 0.2 * s; });
    run.compute<baker_map>();
    for (std::size_t i = 0; i < run.size(); ++i) {
        const double p = run.p[i];
        const double q = run.q[i];
        EXPECT_NEAR(run.largest[i], entropy(p), 5.0 * run.error[i]);
        // both are sums over the same share of left steps
        const double left = (run.largest[i] + std::log(1.0 - p)) / std::log((1.0 - p) / p);
        EXPECT_NEAR(run.second[i], left * std::log(q) + (1.0 - left) * std::log(1.0 - q), 1e-12);
    }
}

TEST(tangent_ensemble, henon_map_has_its_published_exponent_and_its_determinant) {
    exponent_run run;
    for (int i = 0; i < 20; ++i) run.add(0.01 * i, 0.1, 1.4, 0.3);
    run.max_returns = 100100;
    run.compute<henon_map>();
    for (std::size_t i = 0; i < run.size(); ++i) {
        EXPECT_NEAR(run.largest[i], 0.4192, 4.0 * run.error[i]);  // Sprott 2003: 0.41922
        EXPECT_LT(run.error[i], 2e-3);
        // the determinant is -q at every step; 1e5 logarithms of sums of rounding 1e-16
        EXPECT_NEAR(run.largest[i] + run.second[i], std::log(0.3), 1e-12);
    }
}

TEST(tangent_ensemble, motion_at_a_fixed_conserved_column_has_its_own_exponent_first) {
    exponent_run run;
    for (const double p : {0.5, -0.9}) run.add(0.7, 0.1, p, 1.0);
    run.add(0.7, 0.1, 0.0, 0.0);
    run.wanted.direction[0] = 1;
    run.wanted.direction[1] = 0;
    run.wanted.n_free = 1;
    run.compute<conserving_map>();
    for (std::size_t i = 0; i < 2; ++i) {
        // logarithms of 1e4 derivatives that are p but for a few roundings each
        EXPECT_NEAR(run.largest[i], std::log(std::abs(run.p[i])), 1e-15);
        EXPECT_NEAR(run.second[i], 0.0, 1e-15);
        EXPECT_EQ(run.motion_of(i), motion::periodic);
    }
    EXPECT_EQ(run.largest[2], -inf);
    EXPECT_NEAR(run.second[2], 0.0, 1e-15);
    EXPECT_EQ(run.motion_of(2), motion::periodic);

    // in the order of the columns the conserved one comes first, and hides the motion
    run.wanted = {.transient = 100, .block = 100};
    run.compute<conserving_map>();
    EXPECT_NEAR(run.largest[0], 0.0, 1e-15);
    EXPECT_EQ(run.motion_of(0), motion::undecided);
    // rounding leaks into it where directions are only begun among the free columns
    run.wanted.direction[0] = 1;
    run.wanted.direction[1] = 0;
    run.compute<conserving_map>();
    EXPECT_GT(run.largest[0], 0.5 * std::log(0.5));
}

TEST(tangent_ensemble, a_superstable_orbit_has_exponent_minus_infinity) {
    exponent_run run;
    run.add(0.5, 0.0, 2.0, 0.0);
    run.compute<logistic_map>();
    EXPECT_EQ(run.largest[0], -inf);
    EXPECT_EQ(run.motion_of(0), motion::periodic);
    EXPECT_EQ(static_cast<outcome>(run.ends[0]), outcome::ok);
}

TEST(tangent_ensemble, a_start_at_the_critical_point_has_the_exponent_of_its_attractor) {
    exponent_run run;
    run.add(0.5, 0.0, 4.0 - 1e-9, 0.0);  // the first derivative is exactly 0
    run.add(0.5, 0.0, 2.8, 0.0);
    run.compute<logistic_map>();
    EXPECT_NEAR(run.largest[0], std::log(2.0), 0.02);
    EXPECT_EQ(run.motion_of(0), motion::chaotic);
    EXPECT_NEAR(run.largest[1], std::log(0.8), 1e-13);
}

TEST(tangent_ensemble, periodic_orbits_have_the_logarithm_of_their_multiplier) {
    exponent_run run;
    run.add(0.3, 0.0, 2.8, 0.0);  // fixed point, multiplier 2 - p
    run.add(0.3, 0.0, 3.2, 0.0);  // period 2, multiplier 4 + 2 p - p^2
    run.add(0.3, 0.0, 3.0, 0.0);  // multiplier -1: attracts like 1 / sqrt(n)
    run.compute<logistic_map>();
    EXPECT_NEAR(run.largest[0], std::log(0.8), 1e-13);
    EXPECT_NEAR(run.largest[1], 0.5 * std::log(std::abs(4.0 + 6.4 - 10.24)), 1e-13);
    EXPECT_EQ(run.motion_of(0), motion::periodic);
    EXPECT_EQ(run.motion_of(1), motion::periodic);
    EXPECT_LT(std::abs(run.largest[2]), 1e-3);
    EXPECT_NE(run.motion_of(2), motion::chaotic);
}

TEST(tangent_ensemble, a_chaotic_transient_longer_than_the_one_asked_for_is_left_out) {
    exponent_run run;
    run.add(1.5, 0.0, 1.01, 0.5);
    run.compute<late_map>();
    EXPECT_NEAR(run.largest[0], std::log(0.5), 1e-12);
    EXPECT_EQ(run.motion_of(0), motion::periodic);
    EXPECT_LT(run.used[0], 9200u);  // of 10000: 900 of them still grow
    EXPECT_GT(run.used[0], 4000u);
}

TEST(tangent_ensemble, too_few_blocks_leave_the_motion_undecided) {
    exponent_run run;
    run.add(0.3137, 0.0, 1.9, 0.0);
    run.max_returns = 100 + 300;
    run.compute<tent_map>();
    EXPECT_NEAR(run.largest[0], std::log(1.9), 1e-14);
    EXPECT_EQ(run.motion_of(0), motion::undecided);
    run.max_returns = 100;
    run.compute<tent_map>();
    EXPECT_TRUE(std::isnan(run.largest[0]));
    EXPECT_EQ(run.motion_of(0), motion::undecided);
    EXPECT_EQ(run.used[0], 0u);
}

TEST(tangent_ensemble, a_vertical_tangent_is_said_and_not_hidden) {
    exponent_run run;
    run.add(0.0, 0.0, 0.1, 10.0);  // the square root's slope is infinite at its start
    run.add(0.5, 0.0, 0.1, 10.0);
    run.compute<root_map>();
    EXPECT_TRUE(std::isnan(run.largest[0]));
    EXPECT_EQ(run.motion_of(0), motion::not_smooth);
    EXPECT_EQ(static_cast<outcome>(run.ends[0]), outcome::ok);
    EXPECT_EQ(run.returns[0], 10100u);
    EXPECT_EQ(run.motion_of(1), motion::periodic);
}

TEST(tangent_ensemble, an_orbit_that_ends_has_its_outcome_and_no_exponent) {
    exponent_run run;
    run.add(0.5, 0.0, 5.0, 7.0);  // tends to 7.79: falls
    run.compute<root_map>();
    EXPECT_EQ(static_cast<outcome>(run.ends[0]), outcome::fell);
    EXPECT_TRUE(std::isnan(run.largest[0]));
    EXPECT_TRUE(std::isnan(run.error[0]));
    EXPECT_EQ(run.motion_of(0), motion::ended);
    EXPECT_EQ(run.used[0], 0u);
    EXPECT_LT(run.returns[0], 100u);
}

TEST(tangent_ensemble, a_section_that_only_starts_orbits_gives_the_same_exponent) {
    exponent_run run;
    run.add(0.1137, 0.1, 1.9, 0.0);
    run.section = 1;
    run.compute<tent_map>();
    EXPECT_NEAR(run.largest[0], std::log(1.9), 1e-14);
}

TEST(tangent_ensemble, keeps_directions_apart_that_contract_by_a_hundred_decades) {
    // growth per return far from 1 in both directions: no overflow, no loss
    exponent_run run;
    run.add(0.4, 0.3, 1e-3, 1e-9);
    run.compute<baker_map>();
    const double left = (run.largest[0] + std::log(0.999)) / std::log(0.999 / 1e-3);
    EXPECT_NEAR(run.second[0], left * std::log(1e-9) + (1.0 - left) * std::log(1.0 - 1e-9), 1e-9);
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET
