// The spatial mirror-law juggler: first contacts with cones and polynomials, outcomes, impacts
// (models/mirror_juggler.md, sections 2, 5 and 8).
#include "tests/models/spatial_juggler.hpp"

#include "kernels/models/mirror_planar.hpp"
#include "kernels/models/mirror_spatial.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models::spatial_juggler;

TEST(mirror_spatial, takes_the_first_of_three_contacts_with_a_cone) {
    juggler j;
    const double slope = -1.79154234, r = 0.71002195;
    j.kr1 = 0.0;
    j.kr0 = slope * r / (r - j.radius);
    const orbit_answer a = run(j, {r, 0.0, 0.30860018, -2.48461053, 0.20269112});
    ASSERT_TRUE(a.end == outcome::ok || a.end == outcome::downward) << name_of(a.end);
    EXPECT_NEAR(number(a.extras[0]), 0.29199,
                6e-6);  // 0.2919 on the page, cut off; the others are 0.3229, 0.5672
}

TEST(mirror_spatial, finds_the_first_contact_of_a_dense_scan) {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> u(0, 1);
    tally seen;
    for (int i = 0; i < 300; ++i) {
        juggler j{.law = i % 2 ? original : solvable};
        j.kappa0 = -0.5 + u(random);
        j.kr0 = 8 * (u(random) - 0.5);
        j.kr1 = u(random) - 0.5;
        j.shoulder = 0.02;
        j.floor = -1.0;
        const state x{0.1 + u(random), u(random) - 0.5, 0.1 + u(random), 5 * (u(random) - 0.5),
                      3 * (u(random) - 0.5)};
        const double gain = 1 + j.gain(x);
        const auto regulation = [&](double t) {
            const double px = x[0] + x[3] * t, py = x[1] + x[4] * t, r = std::hypot(px, py);
            return j.kr0 * (r - j.radius) + j.kr1 * (px * x[3] + py * x[4]) / r;
        };
        const double apart = std::hypot(x[0], x[1]), slope = regulation(0) / apart;
        const auto F = [&](double t) {
            const double r = std::hypot(x[0] + x[3] * t, x[1] + x[4] * t),
                         z = x[2] - j.gravity * t * t / 2;
            return j.law == original ? gain * std::atan2(z, r) - regulation(t) : z - slope * r;
        };
        if (gain <= 0 || F(0) <= 0) continue;
        const double fall = std::sqrt(2 * (x[2] + 1.0) / j.gravity);
        // the horizontal path enters the shoulder's circle where |p + v t| = 0.02 first
        const double speed = x[3] * x[3] + x[4] * x[4], closing = -(x[0] * x[3] + x[1] * x[4]);
        const double inside = closing * closing - speed * (apart * apart - 0.02 * 0.02);
        const bool enters = closing > 0 && inside >= 0;
        const double pass = enters ? (closing - std::sqrt(inside)) / speed : HUGE_VAL;
        SCOPED_TRACE(i);
        seen.compare(run(j, x), F, {fall, pass});
    }
    EXPECT_GT(seen.contacts, 40);
    EXPECT_GT(seen.misses, 10);
}

TEST(mirror_spatial, reaches_every_outcome_in_the_order_of_the_page) {
    juggler j;
    j.shoulder = 0.1;
    j.floor = -0.5;
    EXPECT_EQ(run(j, {0.5, 0.0, 0.5, 0.0, 0.0}).end, outcome::ok);
    EXPECT_EQ(run(j, {0.06, 0.08, 0.5, 0.0, 0.0}).end, outcome::over_shoulder);
    EXPECT_EQ(run(j, {0.15, 0.0, 0.5, -2.0, 0.0}).end, outcome::over_shoulder);
    juggler low = j;
    low.kappa0 = -3.0;
    EXPECT_EQ(run(low, {0.5, 0.0, 0.5, 0.0, 0.0}).end, outcome::invalid_gain);
    EXPECT_EQ(run(low, {0.05, 0.0, 0.5, 0.0, 0.0}).end, outcome::over_shoulder);
    EXPECT_EQ(run(j, {0.5, 0.0, -0.1, 0.0, 0.0}).end, outcome::apex_below);
    juggler steep = j;
    steep.kr0 = -8.0;
    EXPECT_EQ(run(steep, {1.5, 0.0, 0.5, 1.0, 0.0}).end, outcome::fell);
    juggler shorter = j;
    shorter.bar = 0.4;
    EXPECT_EQ(run(shorter, {0.5, 0.0, 0.5, 0.0, 0.0}).end, outcome::off_bar);
    juggler soft = j;
    soft.kappa0 = -0.6;
    EXPECT_EQ(run(soft, {0.5, 0.0, 0.5, 0.0, 0.0}).end, outcome::downward);
    EXPECT_EQ(run_texts(j, {"nan", "0", "0.5", "0", "0"}, 1, false, table().run_double).end,
              outcome::invalid_start);
    juggler back = j;
    back.radius = 0.12;
    back.kr0 = 0.73;
    back.kr1 = 0.0;
    const orbit_answer a = run(back, {0.2, 0.0, 0.5, 0.0, 0.0});
    if (a.end == outcome::over_shoulder) EXPECT_EQ(a.returns, 0u);
    juggler bent = j;
    bent.shoulder = 2.0;
    bent.bar = 1.0;
    EXPECT_FALSE(mirror_spatial::refusal(bent.numbers().data(), nullptr).empty());
}

TEST(mirror_spatial, reflects_with_restitution_relative_to_the_paddle) {
    struct recorder final : orbit_observer {
        std::array<double, 6> before{}, after{};
        void phase(const char*, double, double, const sampler&) override {}
        void event(const char*, double, const char*, const char*, const double* b, const double* a,
                   double) override {
            for (std::size_t i = 0; i < 6; ++i) before[i] = b[i], after[i] = a[i];
        }
    };
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int i = 0; i < 60; ++i) {
        const juggler j{.law = i % 3};
        const state x{0.55 + 0.1 * u(random), 0.1 * u(random), 0.55 + 0.1 * u(random),
                      0.2 * u(random), 0.2 * u(random)};
        recorder seen;
        with_texts(j.law, 0, written(x), written(j.numbers()), 1, false,
                   [&](const orbit_row& row) { table().trace(row, seen); });
        const auto &b = seen.before, &a = seen.after;
        const double r = std::hypot(b[0], b[1]), rho = std::hypot(r, b[2]), e = std::atan2(b[2], r);
        const double c = b[0] / r, s = b[1] / r, rdot = b[3] * c + b[4] * s,
                     phidot = (b[0] * b[4] - b[1] * b[3]) / (r * r);
        const double apart = std::hypot(x[0], x[1]), h = x[0] * x[4] - x[1] * x[3];
        const double q3 = j.law == original
                              ? j.kl0 * std::atan2(b[1], b[0]) + j.kl1 * phidot
                              : j.kl0 * std::atan2(x[1], x[0]) + j.kl1 * h / (apart * apart);
        const double ball_rate = (b[5] * std::cos(e) - rdot * std::sin(e)) / rho;
        const double gain = j.gain(x);
        double rate = -gain * ball_rate;
        if (j.law == original) rate += j.kr0 * rdot + j.kr1 * h * h / (r * r * r);
        const double n0[] = {-std::sin(e) * c, -std::sin(e) * s, std::cos(e)}, t[] = {-s, c, 0.0};
        double normal_before = 0, normal_after = 0, jump = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double n = std::cos(q3) * n0[k] - std::sin(q3) * t[k];
            const double paddle = rho * (std::cos(e) * phidot * t[k] + rate * n0[k]);
            normal_before += (b[3 + k] - paddle) * n;
            normal_after += (a[3 + k] - paddle) * n;
            jump += (a[3 + k] - b[3 + k]) * (a[3 + k] - b[3 + k]);
        }
        EXPECT_NEAR(normal_after, -0.75 * normal_before, 1e-13);
        EXPECT_NEAR(std::sqrt(jump), -1.75 * normal_before, 1e-13);  // only along the normal
    }
}

}  // namespace
}  // namespace hopscotch
