// The pitching spring-mass runner: gaits of Fig. 5 with their multipliers (models/slip.md, section
// 11), the weak instability of case 9, and the body's swing.
#include "tests/models/pitching_gaits.hpp"

#include "kernels/models/slip.hpp"
#include "kernels/models/slip_pitching.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::pitching_gaits;
using model = slip_pitching;

const published_gait fig5b_other{"0.15",   "0.000225", "8.26",   inertial,
                                 0.115440, -0.522890,  -5.39149, {1e-6, 1e-6, 1e-5}};

/// Newton's method on the gait at constant touchdown speed: three columns, three unknowns.
model_row polished(model_row row) {
    for (int iteration = 0; iteration < 6; ++iteration) {
        const linearised map = linearise(row);
        double a[3][4];
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                a[i][j] = map.slope[i + 1][j + 1] - (i == j ? 1.0 : 0.0);
            a[i][3] = number(row.columns[i + 1]) - map.state[i + 1];
        }
        for (std::size_t k = 0; k < 3; ++k) {  // Gauss-Jordan with row pivots
            std::size_t best = k;
            for (std::size_t i = k; i < 3; ++i) {
                if (std::abs(a[i][k]) > std::abs(a[best][k])) best = i;
            }
            std::swap(a[k], a[best]);
            for (std::size_t i = 0; i < 3; ++i) {
                const double share = i == k ? 0.0 : a[i][k] / a[k][k];
                for (std::size_t j = k; j < 4; ++j) a[i][j] -= share * a[k][j];
            }
        }
        for (std::size_t i = 0; i < 3; ++i) {
            row.columns[i + 1] = print_real(number(row.columns[i + 1]) + a[i][3] / a[i][i]);
        }
    }
    return row;
}

/// Coefficients p of x^4 + p[3] x^3 + ... + p[0], the characteristic polynomial (Faddeev,
/// Leverrier).
std::array<double, 4> characteristic(const matrix& m) {
    std::array<double, 4> p{};
    matrix product = m;
    for (std::size_t k = 1; k <= 4; ++k) {
        double trace = 0.0;
        for (std::size_t i = 0; i < 4; ++i) trace += product[i][i];
        p[4 - k] = -trace / static_cast<double>(k);
        matrix shifted = product;
        for (std::size_t i = 0; i < 4; ++i) shifted[i][i] += p[4 - k];
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                product[i][j] = 0.0;
                for (std::size_t l = 0; l < 4; ++l) product[i][j] += m[i][l] * shifted[l][j];
            }
        }
    }
    return p;
}

/// x^3 + q[2] x^2 + q[1] x + q[0]: what is left without the multiplier 1, and the remainder there.
struct reduced_polynomial {
    std::array<double, 3> q;
    double at_one;
    double operator()(double x) const { return ((x + q[2]) * x + q[1]) * x + q[0]; }
};

reduced_polynomial without_one(const matrix& m) {
    const std::array<double, 4> p = characteristic(m);
    reduced_polynomial r{};
    r.q[2] = p[3] + 1.0;
    r.q[1] = p[2] + r.q[2];
    r.q[0] = p[1] + r.q[1];
    r.at_one = p[0] + r.q[0];
    return r;
}

double real_root(const reduced_polynomial& p, double x) {
    for (int i = 0; i < 8; ++i) x -= p(x) / ((3.0 * x + 2.0 * p.q[2]) * x + p.q[1]);
    return x;
}

/// The gait exists to the page's digits, the conserved energy gives the multiplier 1.
reduced_polynomial expect_gait(const published_gait& gait, double unity) {
    const model_row row = polished(gait_row(gait));
    EXPECT_NEAR(number(row.columns[1]), gait.angle, gait.tolerance[0]);
    EXPECT_NEAR(number(row.columns[2]), gait.pitch, gait.tolerance[1]);
    EXPECT_NEAR(number(row.columns[3]), gait.pitch_rate, gait.tolerance[2]);
    const linearised map = linearise(row);
    EXPECT_NEAR(map.state[0], number(gait.speed), unity);
    const reduced_polynomial rest = without_one(map.slope);
    EXPECT_NEAR(rest.at_one, 0.0, unity);
    return rest;
}

TEST(slip_pitching, has_the_weakly_unstable_gait_of_figure_5a) {
    // multipliers 1, -0.22527, 0.37836 +- 0.92598 i of modulus 1.000297: not on the unit circle
    const reduced_polynomial rest = expect_gait(fig5a, 1e-12);
    const double single = real_root(rest, -0.22527);
    EXPECT_NEAR(single, -0.22527, 5e-6);
    const double half_sum = 0.5 * (-rest.q[2] - single);
    const double square = -rest.q[0] / single;
    EXPECT_NEAR(half_sum, 0.37836, 5e-6);
    EXPECT_NEAR(std::sqrt(square), 1.000297, 5e-7);
    EXPECT_NEAR(std::sqrt(square - half_sum * half_sum), 0.92598, 5e-6);
}

TEST(slip_pitching, has_the_gait_of_figure_5a_with_the_leg_placed_relative_to_the_body) {
    // multipliers 1, -0.4811 and a pair of modulus 1.147
    const reduced_polynomial rest = expect_gait(fig5a_body, 1e-12);
    const double single = real_root(rest, -0.4811);
    EXPECT_NEAR(single, -0.4811, 5e-5);
    EXPECT_NEAR(std::sqrt(-rest.q[0] / single), 1.147, 5e-4);
}

TEST(slip_pitching, has_the_unstable_gaits_of_figure_5b) {
    // entries of the matrix reach 1500, so that the coefficients are good to 1e-8
    const reduced_polynomial first = expect_gait(fig5b, 1e-7);
    EXPECT_NEAR(real_root(first, 4.880), 4.880, 5e-4);
    EXPECT_NEAR(real_root(first, -3.496), -3.496, 5e-4);
    EXPECT_NEAR(real_root(first, -0.0467), -0.0467, 5e-5);
    const reduced_polynomial other = expect_gait(fig5b_other, 1e-7);
    EXPECT_NEAR(real_root(other, -11.96), -11.96, 5e-3);
    EXPECT_NEAR(real_root(other, 0.510), 0.510, 5e-4);
    EXPECT_NEAR(real_root(other, -0.381), -0.381, 5e-4);
}

TEST(slip_pitching, is_far_more_unstable_with_the_hip_below_the_centre) {
    // the page's sign check: d = -0.015, symmetric gait with a multiplier of modulus 3.1
    published_gait below = fig5a;
    below.hip = "-0.015";
    below.pitch = 0.0103;  // the gait's pitch changes its sign with d
    below.pitch_rate = 0.0871;
    const model_row row = polished(gait_row(below));
    EXPECT_NEAR(number(row.columns[1]), 0.147, 0.02);
    const reduced_polynomial rest = without_one(linearise(row).slope);
    double largest = 0.0;
    for (double guess : {-5.0, 5.0}) largest = std::max(largest, std::abs(real_root(rest, guess)));
    EXPECT_NEAR(largest, 3.1, 0.05);
}

TEST(slip_pitching, stays_close_to_the_weakly_unstable_gait_for_500_strides) {
    // page, case 9: e-fold growth takes 3400 strides, so 500 strides grow the page's rounding by 16
    // %; the eigenbasis is skew, hence the factor
    model_row row = gait_row(fig5a);
    row.returns = 500;
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::ok);
    EXPECT_NEAR(number(answer.columns[1]), fig5a.angle, 1e-5);
    EXPECT_NEAR(number(answer.columns[2]), fig5a.pitch, 1e-5);
    EXPECT_EQ(answer.events, 1000u);
}

TEST(slip_pitching, makes_the_body_swing_four_times_in_a_stance_of_figure_5b) {
    // page, section 6: 8 extrema of the pitch per stance
    struct extrema : orbit_observer {
        void phase(const char* mode, double, double duration, const sampler& at) override {
            if (std::string(mode) != "stance") return;
            double columns[most_columns];
            for (int i = 0; i <= 50; ++i) {
                at.state_at(duration * i / 50.0, columns);
                if (rate * columns[5] < 0.0) ++count;
                rate = columns[5];
            }
        }
        void event(const char*, double, const char*, const char*, const double*, const double*,
                   double) override {}
        double rate = 0.0;
        int count = 0;
    } seen;
    const model_row row = polished(gait_row(fig5b));
    const std::vector<int> options = chosen_options<model>(row);
    const std::vector<std::string> parameters = all_parameters<model>(row);
    orbit_row orbit{.section = 0, .options = options.data()};
    orbit.columns = row.columns;
    orbit.parameters = parameters;
    orbits_of<model>().trace(orbit, seen);
    EXPECT_EQ(seen.count, 8);
}

}  // namespace
}  // namespace hopscotch
