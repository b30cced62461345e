// The planar mirror-law juggler: fixed points, stability and transverse exponents of its page
// (models/mirror_juggler.md, section 4).
#include "tests/models/planar_juggler.hpp"

#include "kernels/models/mirror_planar.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models::planar_juggler;

struct recorder final : orbit_observer {
    std::vector<std::array<double, 4>> before, after;
    std::vector<double> times;
    void phase(const char*, double, double, const sampler&) override {}
    void event(const char*, double time, const char*, const char*, const double* b, const double* a,
               double) override {
        times.push_back(time);
        before.push_back({b[0], b[1], b[2], b[3]});
        after.push_back({a[0], a[1], a[2], a[3]});
    }
};

recorder watch(const juggler& j, const state& x) {
    recorder seen;
    with_row(j, {print_real(x[0]), print_real(x[1]), print_real(x[2])}, 1, false,
             [&](const orbit_row& row) { return table().trace(row, seen); });
    return seen;
}

TEST(mirror_planar, gives_the_illustrative_return) {
    const state end = end_of(run(example(), {0.55, 0.6, -0.1}));
    EXPECT_NEAR(end[0], 0.494566150124, 6e-13);  // half of the last printed digit
    EXPECT_NEAR(end[1], 0.485733988340, 6e-13);
    EXPECT_NEAR(end[2], -0.064570030411, 6e-13);
}

TEST(mirror_planar, carries_the_line_map_on_the_invariant_slice) {
    for (int law : {original, solvable, level}) {
        for (const char* height : {"0.3", "0.5", "0.72"}) {
            const juggler j = example(law);
            const orbit_answer a = with_row(j, {"0.5", height, "0"}, 1, false, table().run_mp50);
            const real50 z = parse_real<real50>(height);
            const real50 gain = parse_real<real50>(j.kappa0) +
                                parse_real<real50>(j.texts()[3]) *
                                    parse_real<real50>(j.texts()[1]) * (real50(0.5) - z);
            const real50 m = real50(0.75) + real50(1.75) * gain;
            EXPECT_LT(abs(parse_real<real50>(a.columns[0]) - real50(0.5)), real50(1e-48));
            EXPECT_LT(abs(parse_real<real50>(a.columns[2])), real50(1e-48));
            // 50 printed digits; the kappa0 text is 50 digits too
            EXPECT_LT(abs(parse_real<real50>(a.columns[1]) - m * m * z), real50(1e-48)) << law;
        }
    }
}

TEST(mirror_planar, has_the_block_triangular_jacobian_of_the_table) {
    for (int law : {original, solvable, level}) {
        juggler j = example(law);
        j.kappa10 = 0.07;
        j.kappa11 = 0.06;
        const matrix m = jacobian(j, {0.5, 0.5, 0.0});
        const double T = j.flight(), V = j.speed();
        const double G = law == solvable ? 2 * V / j.target_x
                         : law == level  ? 1.75 * V / j.target_x
                                         : 1.75 * V;
        const double k11 = law == original ? j.kappa11 + T * j.kappa10 : j.kappa11;
        EXPECT_NEAR(m[1][1], 1 - 2 * 0.5, 2e-14);
        EXPECT_NEAR(m[0][1], 0.0, 1e-14);  // x and v do not see z
        EXPECT_NEAR(m[2][1], 0.0, 1e-14);
        EXPECT_NEAR(m[0][0] + m[2][2], 2 - T * G * j.kappa10 - G * k11, 3e-14);
        EXPECT_NEAR(m[0][0] * m[2][2] - m[0][2] * m[2][0], 1 + T * G * j.kappa10 - G * k11, 3e-14);
        if (law == original) {
            EXPECT_GT(std::abs(m[1][2]), 1e-3);  // v drives z at first order
        } else {
            EXPECT_NEAR(m[1][0], 0.0, 1e-14);
            EXPECT_NEAR(m[1][2], 0.0, 1e-14);
        }
    }
}

TEST(mirror_planar, is_stable_inside_the_closed_form_triangle_and_not_outside) {
    const state start{0.502, 0.503, 0.004};
    const auto settles = [&](juggler j) {
        const orbit_answer a = run(j, start, 3000);
        if (a.end != outcome::ok) return false;
        const state x = end_of(a);
        return std::abs(x[0] - 0.5) + std::abs(x[1] - 0.5) + std::abs(x[2]) < 1e-6;
    };
    for (int law : {original, solvable, level}) {
        juggler j = example(law);
        const double T = j.flight(), V = j.speed();
        const double G = law == solvable ? 2 * V / 0.5 : law == level ? 1.75 * V / 0.5 : 1.75 * V;
        const auto set = [&](double position, double velocity,
                             double B) {  // T k10' and k11' in 2/G
            j.kappa10 = position * 2 / G / T;
            j.kappa11 = velocity * 2 / G - (law == original ? position * 2 / G : 0.0);
            j.kappa1 = B / (1.75 * 9.81 * 0.5);
            return j;
        };
        EXPECT_TRUE(settles(set(0.3, 0.6, 0.5))) << law;
        EXPECT_TRUE(settles(set(0.05, 0.97, 0.95))) << law;
        EXPECT_FALSE(settles(set(0.3, 1.04, 0.5))) << law;   // k11' > 2/G
        EXPECT_FALSE(settles(set(0.5, 0.45, 0.5))) << law;   // T k10' > k11'
        EXPECT_FALSE(settles(set(-0.05, 0.6, 0.5))) << law;  // k10' < 0
        EXPECT_FALSE(settles(set(0.3, 0.6, 1.05))) << law;   // B > 1
    }
}

TEST(mirror_planar, settles_in_15_to_55_cycles) {
    for (int law : {original, solvable, level}) {
        const juggler j = example(law);
        state x{0.55, 0.6, -0.1};
        int cycles = 0;
        while (std::abs(x[0] - 0.5) + std::abs(x[1] - 0.5) + std::abs(x[2]) > 1e-9 &&
               cycles < 1000) {
            x = end_of(run(j, x));
            ++cycles;
        }
        EXPECT_GE(cycles, 15) << law;
        EXPECT_LE(cycles, 100) << law;  // "typical" on the page
    }
}

TEST(mirror_planar, has_the_transverse_jacobian_and_exponents_of_the_page) {
    const auto larger_exponent = [](double B) {
        juggler j;
        j.kappa1 = B / (1.75 * 9.81 * 0.5);
        j.kappa11 = 0.5 * 0.5 / j.speed();
        j.kappa10 = 0.3 * j.kappa11 / j.flight();
        double z = B < 1 ? 0.5 : 0.43, sum = 0, a = 1, b = 0.3;
        const int transient = 500, cycles = 3000;
        for (int i = 0; i < transient + cycles; ++i) {
            const matrix m = jacobian(j, {0.5, z, 0.0});
            const double gain = j.gain(0.5, z, 0), mn = 0.75 + 1.75 * gain;
            const double T = std::sqrt(2 * z / 9.81), c = (1 + mn) * 9.81 * T, ta = mn * T;
            if (i < 20) {
                EXPECT_NEAR(m[0][0], 1 - ta * c * j.kappa10 / 0.5, 1e-13);
                EXPECT_NEAR(m[0][2], T + ta - ta * c * j.kappa11 / 0.5, 1e-13);
                EXPECT_NEAR(m[2][0], -c * j.kappa10 / 0.5, 1e-13);
                EXPECT_NEAR(m[2][2], 1 - c * j.kappa11 / 0.5, 1e-13);
            }
            const double p = m[0][0] * a + m[0][2] * b, q = m[2][0] * a + m[2][2] * b;
            const double growth = std::hypot(p, q);
            a = p / growth, b = q / growth;
            if (i >= transient) sum += std::log(growth);
            z = end_of(run(j, {0.5, z, 0.0}))[1];
        }
        return sum / cycles;
    };
    EXPECT_NEAR(larger_exponent(0.7), -0.602, 6e-4);
    EXPECT_NEAR(larger_exponent(1.38), -0.554, 2e-3);
    EXPECT_NEAR(larger_exponent(1.53), -0.486, 1e-2);  // chaotic: statistical error of 3000 cycles
}

TEST(mirror_planar, contacts_lie_where_equations_15_and_16_put_them) {
    const state x{0.55, 0.6, -0.1};
    const juggler j15 = example(solvable), j16 = example(level);
    const double regulation = j15.kappa10 * 0.05 + j15.kappa11 * -0.1;
    const auto contact15 = watch(j15, x).before.at(0), contact16 = watch(j16, x).before.at(0);
    EXPECT_NEAR(contact15[1] * 0.55, regulation * contact15[0], 1e-16);  // (15): (1 + K) cancels
    const double gain = j16.gain(x[0], x[1], x[2]);
    EXPECT_NEAR(contact16[1], regulation / (1 + gain), 1e-15);  // (16) with k = -K
}

TEST(mirror_planar, reflects_with_restitution_relative_to_the_bar) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> x(0.3, 0.8), z(0.3, 0.8), v(-0.3, 0.3);
    for (int i = 0; i < 60; ++i) {
        juggler j = example(i % 3);
        j.energy = (i / 3) % 2;
        const state start{x(random), z(random), v(random)};
        const recorder seen = watch(j, start);
        ASSERT_EQ(seen.before.size(), 1u);
        const auto &b = seen.before[0], &a = seen.after[0];
        const double gain = j.gain(start[0], start[1], start[2]);
        const double square = b[0] * b[0] + b[1] * b[1], rho = std::sqrt(square);
        const double theta_rate = (b[0] * b[3] - b[1] * b[2]) / square;
        const double bar_rate =
            -gain * theta_rate + (j.law == original ? j.kappa10 * start[2] : 0.0);
        const double nx = -b[1] / rho, nz = b[0] / rho;
        const double before = b[2] * nx + b[3] * nz - rho * bar_rate;
        const double after = a[2] * nx + a[3] * nz - rho * bar_rate;
        EXPECT_LT(before, 0.0);
        EXPECT_NEAR(after, -0.75 * before, 1e-13);
        EXPECT_NEAR(a[2] * nz - a[3] * nx, b[2] * nz - b[3] * nx, 1e-13);  // along the bar
    }
}

}  // namespace
}  // namespace hopscotch
