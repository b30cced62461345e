// The planar mirror-law juggler: first contacts, hard cases, outcomes and 50 digits
// (models/mirror_juggler.md, sections 2, 4 and 8).
#include "tests/models/planar_juggler.hpp"

#include "kernels/models/mirror_planar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models::planar_juggler;

TEST(mirror_planar, original_law_takes_the_first_of_two_roots) {
    juggler j{.law = original, .kappa0 = "0.487"};
    j.kappa10 = -2.3533;
    j.kappa11 = -0.0367;
    const orbit_answer a = run(j, {0.1287, 0.2363, 1.8285});
    EXPECT_EQ(a.end, outcome::downward);              // the impact leaves the ball going down
    EXPECT_NEAR(number(a.extras[0]), 0.30262, 6e-6);  // and not 0.4212
}

TEST(mirror_planar, original_law_finds_the_first_contact_of_a_dense_scan) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> u(0, 1);
    tally seen;
    for (int i = 0; i < 400; ++i) {
        juggler j{.law = original};
        j.kappa0 = print_real(-0.5 + u(random));
        j.kappa10 = 8 * (u(random) - 0.5);
        j.kappa11 = u(random) - 0.5;
        j.shoulder = 0.02;
        j.floor = -1.0;
        const state x{0.1 + u(random), 0.1 + u(random), 4 * (u(random) - 0.5)};
        const double gain = 1 + j.gain(x[0], x[1], x[2]);
        const auto F = [&](double t) {
            return gain * std::atan2(x[1] - j.gravity * t * t / 2, x[0] + x[2] * t) -
                   (j.kappa10 * (x[0] + x[2] * t - 0.5) + j.kappa11 * x[2]);
        };
        if (gain <= 0 || F(0) <= 0) continue;
        const double fall = std::sqrt(2 * (x[1] + 1.0) / j.gravity);
        const double pass = x[2] < 0 ? (x[0] - 0.02) / -x[2] : HUGE_VAL;
        SCOPED_TRACE(i);
        seen.compare(run(j, x), F, {fall, pass});
    }
    EXPECT_GT(seen.contacts, 60);
    EXPECT_GT(seen.misses, 20);
}

TEST(mirror_planar, keeps_its_digits_where_the_plain_root_formula_cancels) {
    for (double v : {30.0, -30.0}) {  // s v large of both signs
        juggler j = example();
        j.kappa10 = 0.8;
        j.kappa11 = 0.0;
        const state x{40.0, 33.0, v};
        const orbit_answer got = run(j, x), truth = run(j, x, 1, false, table().run_mp50);
        ASSERT_EQ(got.end, truth.end);
        for (std::size_t c = 0; c < 3; ++c) {
            const double exact = number(truth.columns[c]);
            EXPECT_NEAR(number(got.columns[c]), exact, 1e-12 * (1 + std::abs(exact)));
        }
    }
}

TEST(mirror_planar, basin_boundary_of_low_apexes_is_discontinuous) {
    // z - L = 1e-14: contact at once where the ray falls away, after a flight where it rises
    juggler j = example();
    j.kappa10 = 0.2;
    j.kappa11 = 0.0;
    const auto start = [&](double v) { return state{1.0, 0.1 + 1e-14, v}; };
    EXPECT_LT(number(run(j, start(0.5)).extras[0]), 1e-12);
    EXPECT_NEAR(number(run(j, start(-0.5)).extras[0]), 2 * 0.1 * 0.5 / 9.81, 1e-9);
    EXPECT_EQ(run(j, {1.0, 0.1 - 1e-14, 0.5}).end, outcome::apex_below);
}

TEST(mirror_planar, almost_pacing_the_ball_is_legal_and_pacing_is_not) {
    for (int law : {original, solvable, level}) {
        juggler j = example(law);
        j.kappa1 = 0.0;
        j.kappa10 = j.kappa11 = 0.0;
        j.kappa0 = "-0.999999999999";
        EXPECT_EQ(run(j, {0.5, 0.5, 0.0}).end, outcome::downward) << law;  // hardly an impact
        j.kappa0 = "-1";
        EXPECT_EQ(run(j, {0.5, 0.5, 0.0}).end, outcome::invalid_gain) << law;
    }
}

TEST(mirror_planar, survives_states_next_to_the_shoulder) {
    juggler j = example();
    const orbit_answer a = run(j, {1e-8, 0.5, 0.0}),
                       truth = run(j, {1e-8, 0.5, 0.0}, 1, false, table().run_mp50);
    EXPECT_EQ(a.end, truth.end);
    for (std::size_t c = 0; c < 3; ++c) {
        const double exact = number(truth.columns[c]);
        EXPECT_NEAR(number(a.columns[c]), exact, 1e-12 * (1 + std::abs(exact)));
    }
}

TEST(mirror_planar, reaches_every_outcome_in_the_order_of_the_page) {
    juggler j = example();
    j.shoulder = 0.1;
    j.floor = -0.5;
    EXPECT_EQ(run(j, {0.5, 0.5, 0.0}).end, outcome::ok);
    EXPECT_EQ(run(j, {0.1, 0.5, 0.0}).end, outcome::over_shoulder);    // starts there
    EXPECT_EQ(run(j, {0.15, 0.5, -2.0}).end, outcome::over_shoulder);  // passes it before contact
    juggler low = j;
    low.kappa0 = "-3";
    EXPECT_EQ(run(low, {0.5, 0.5, 0.0}).end, outcome::invalid_gain);
    EXPECT_EQ(run(low, {0.1, 0.5, 0.0}).end, outcome::over_shoulder);  // before the gain
    EXPECT_EQ(run(j, {0.5, -0.1, 0.0}).end, outcome::apex_below);
    juggler steep = j;
    steep.kappa10 = -8.0;  // the ray falls faster than the ball may
    EXPECT_EQ(run(steep, {1.5, 0.5, 1.0}).end, outcome::fell);
    juggler shorter = j;
    shorter.bar = 0.4;
    EXPECT_EQ(run(shorter, {0.5, 0.5, 0.0}).end, outcome::off_bar);
    juggler soft = j;
    soft.kappa0 = "-0.6";  // m = 0.75 - 1.05 < 0
    EXPECT_EQ(run(soft, {0.5, 0.5, 0.0}).end, outcome::downward);
    EXPECT_EQ(with_row(j, {"nan", "0.5", "0"}, 1, false, table().run_double).end,
              outcome::invalid_start);
}

TEST(mirror_planar, an_apex_behind_the_shoulder_ends_the_orbit_and_is_reported) {
    juggler j = example();
    j.shoulder = 0.1;
    j.target_x = 0.12;
    j.kappa10 = 0.8;  // throws the ball back over the shoulder
    j.kappa11 = 0.0;
    const orbit_answer a = run(j, {0.3, 0.5, 0.0});
    EXPECT_EQ(a.end, outcome::over_shoulder);
    EXPECT_EQ(a.returns, 0u);
    EXPECT_LE(number(a.columns[0]), 0.1);
    EXPECT_LT(number(a.columns[2]), -1.0);
    const double parameters[] = {0.75, 9.81, 0.1, 0, 0.5, 0.5, 0, 0, 2.0, 1.0, -1.0};
    EXPECT_FALSE(mirror_planar::refusal(parameters, nullptr).empty());
}

TEST(mirror_planar, total_energy_counts_horizontal_motion) {
    juggler total = example();
    total.energy = 1;
    EXPECT_EQ(run(total, {0.5, 0.6, 0.0}).columns, run(example(), {0.5, 0.6, 0.0}).columns);
    EXPECT_NE(run(total, {0.5, 0.6, 0.2}).columns, run(example(), {0.5, 0.6, 0.2}).columns);
    // the same as vertical energy with its set point lowered by v^2 / 2 in the gain alone
    juggler lowered = example();
    lowered.kappa0 = print_real(1.0 / 7.0 - lowered.kappa1 * 0.02);
    const state a = end_of(run(total, {0.55, 0.6, 0.2})),
                b = end_of(run(lowered, {0.55, 0.6, 0.2}));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 2e-15);
}

TEST(mirror_planar, one_return_is_exact_to_a_few_ulp_against_50_digits) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> u(0, 1);
    int compared = 0;
    for (int i = 0; i < 300; ++i) {
        juggler j = example(i % 3);
        j.energy = (i / 3) % 2;
        j.kappa10 *= 4 * u(random);
        j.kappa11 *= 2 * u(random);
        const state x{0.2 + u(random), 0.2 + u(random), 2 * u(random) - 1};
        const orbit_answer got = run(j, x), truth = run(j, x, 1, false, table().run_mp50);
        ASSERT_EQ(got.end, truth.end) << i;
        if (got.end != outcome::ok) continue;
        ++compared;
        const matrix m = jacobian(j, x);
        for (std::size_t c = 0; c < 3; ++c) {
            double spread = 1;
            for (double d : m[c]) spread += std::abs(d);
            EXPECT_NEAR(number(got.columns[c]), number(truth.columns[c]), 2e-15 * spread) << i;
        }
    }
    EXPECT_GT(compared, 150);
}

TEST(mirror_planar, derivatives_match_50_digit_central_differences) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> u(0, 1);
    for (int i = 0; i < 24; ++i) {
        juggler j = example(i % 3);
        j.energy = (i / 3) % 2;
        const state x{0.4 + 0.3 * u(random), 0.4 + 0.3 * u(random), 0.4 * u(random) - 0.2};
        const std::vector<std::string> at{print_real(x[0]), print_real(x[1]), print_real(x[2])};
        const orbit_answer got = with_row(j, at, 1, true, table().run_mp50);
        ASSERT_EQ(got.end, outcome::ok);
        const real50 step("1e-18");
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<std::string> up = at, down = at;
            up[c] = print_real(real50(x[c]) + step);
            down[c] = print_real(real50(x[c]) - step);
            const orbit_answer a = with_row(j, up, 1, false, table().run_mp50);
            const orbit_answer b = with_row(j, down, 1, false, table().run_mp50);
            for (std::size_t r = 0; r < 3; ++r) {
                const double slope = to_double(
                    (parse_real<real50>(a.columns[r]) - parse_real<real50>(b.columns[r])) /
                    (step + step));
                EXPECT_NEAR(number(got.derivative[3 * r + c]), slope,
                            1e-14 * (1 + std::abs(slope)));
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
