// The spring-mass runner: published and illustrative numbers of its page, row by row
// (models/slip.md, sections 11 and 15), and its closed forms.
#include "tests/models/slip_rows.hpp"

#include "kernels/models/slip.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::slip_rows;

/// Largest sweep over all touchdown angles, on a grid refined around its best point.
double largest_sweep(double leg, double stiffness, double beta, double speed,
                     const names& options) {
    double low = beta - pi_double / 2;
    double high = beta;
    double best = 0.0;
    for (int level = 0; level < 4; ++level) {
        double place = low;
        const double step = (high - low) / 60;
        for (int i = 1; i < 60; ++i) {
            const double angle = low + i * step;
            const double sweep = run(paper_row(leg, stiffness, beta, speed, angle, options)).sweep;
            if (sweep > best) best = sweep, place = angle;
        }
        low = place - step;
        high = place + step;
    }
    return best;
}

/// Do touchdown angles in (0, beta) make the runner stumble before they make it reverse?
bool has_gap(double leg, double stiffness, double beta, double speed, const names& options) {
    for (int i = 1; i < 3000; ++i) {
        const outcome end =
            run(paper_row(leg, stiffness, beta, speed, beta * i / 3000.0, options)).end;
        if (end != outcome::ok) return end == outcome::stumble;
    }
    return false;
}

/// A fixed point of the angle's map between two angles, by bisection on angle' - angle.
double fixed_angle(model_row row, double low, double high) {
    const auto excess = [&](double angle) {
        row.columns[1] = print_real(angle);
        return run(row).angle - angle;
    };
    const bool rises = excess(low) < 0.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((excess(middle) < 0.0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double multiplier(model_row row, double angle) {
    row.columns[1] = print_real(angle);
    row.derivative = true;
    return number(run_row<slip>(row).derivative[3]);
}

TEST(slip, gives_the_pages_illustrative_strides) {
    const stride linear = run(numbers_row(1.25, 9.0, 0.5886, 0.3, gravity_off));
    EXPECT_NEAR(linear.sweep, 0.7111474932340515, 2e-15);  // 16 digits on the page
    EXPECT_NEAR(linear.angle, 0.1592899452608366, 1e-15);
    const stride air = run(numbers_row(1.25, 0.5, 0.4, 0.3, air_off));
    EXPECT_NEAR(air.sweep, 0.7470021095121974, 1e-15);
    EXPECT_NEAR(air.angle, 0.08834700602972527, 1e-15);
}

TEST(slip, stumbles_where_the_page_says_with_gravity_in_stance) {
    const stride linear = run(numbers_row(1.25, 9.0, 0.5886, 0.3, linear_on));
    EXPECT_EQ(linear.end, outcome::stumble);
    EXPECT_NEAR(linear.time, 0.903537019880892, 1e-14);  // of lift-off
    EXPECT_NEAR(linear.sweep,
                std::atan2(0.563578981988908, 0.8260621835312074) + pi_double / 2 - 1.25, 1e-14);
    const stride air = run(numbers_row(1.25, 0.5, 0.4, 0.3, air_on));
    EXPECT_EQ(air.end, outcome::stumble);
    EXPECT_NEAR(air.time, 0.960082064274823, 1e-14);
    EXPECT_NEAR(air.sweep,
                std::atan2(0.6058461563691393, 0.7955818215700635) + pi_double / 2 - 1.25, 1e-14);
}

TEST(slip, reproduces_the_largest_sweeps_of_figure_3) {
    const double speeds[] = {1.75, 3.5, 5.0, 6.0};
    const double sweeps[] = {0.2970, 0.5448, 0.7401, 0.8652};  // 4 digits on the page
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(largest_sweep(1.5, 100.0, 1.25, speeds[i], gravity_off), sweeps[i], 6e-5);
    }
}

/// The saddle-node is where the largest sweep equals pi - 2 beta; the page gives its speed to half
/// a unit in the last digit.
void expect_saddle_node(double leg, double stiffness, double beta, double speed, double digit,
                        const names& options) {
    const double wanted = pi_double - 2.0 * beta;
    EXPECT_LT(largest_sweep(leg, stiffness, beta, speed - digit, options), wanted);
    EXPECT_GT(largest_sweep(leg, stiffness, beta, speed + digit, options), wanted);
}

TEST(slip, has_its_saddle_nodes_at_the_reproduced_speeds) {
    expect_saddle_node(1.5, 100.0, 1.25, 4.2325, 1e-4, gravity_off);  // Figs 3, 6
    expect_saddle_node(1.5, 50.0, 0.8, 8.13883, 1e-5, gravity_off);   // Fig 8(a); paper 8.12
    expect_saddle_node(1.25, 23.0, 1.25, 3.94185, 1e-5, air_off);     // Fig 8(b) needs eta0 = 1.25
    expect_saddle_node(1.5, 23.0, 1.25, 3.28487, 1e-5, air_off);      // with the caption's 1.5
    expect_saddle_node(0.173, 0.01839, 0.961, 1.512797, 1e-6, air_off);  // Fig 12
    expect_saddle_node(1.5, 100.0, 1.0, 8.2687, 1e-4, gravity_off);
}

TEST(slip, opens_its_gap_at_the_reproduced_speeds) {
    EXPECT_FALSE(has_gap(1.5, 100.0, 1.25, 5.3560, gravity_off));  // v_GP = 5.3562
    EXPECT_TRUE(has_gap(1.5, 100.0, 1.25, 5.3564, gravity_off));
    EXPECT_FALSE(has_gap(1.25, 23.0, 1.25, 5.2259, air_off));  // 5.2261
    EXPECT_TRUE(has_gap(1.25, 23.0, 1.25, 5.2263, air_off));
    EXPECT_FALSE(has_gap(1.5, 23.0, 1.25, 4.1002, air_off));  // 4.1004
    EXPECT_TRUE(has_gap(1.5, 23.0, 1.25, 4.1006, air_off));
    EXPECT_FALSE(has_gap(0.173, 0.01839, 0.961, 1.71548, air_off));  // 1.715498; paper 1.7162
    EXPECT_TRUE(has_gap(0.173, 0.01839, 0.961, 1.71552, air_off));
    EXPECT_FALSE(has_gap(1.5, 100.0, 1.0, 8.4779, linear_on));  // 8.4781
    EXPECT_TRUE(has_gap(1.5, 100.0, 1.0, 8.4783, linear_on));
    EXPECT_FALSE(has_gap(0.17, 0.03839, 0.961, 1.69612, air_on));  // 1.69616; paper 1.697
    EXPECT_TRUE(has_gap(0.17, 0.03839, 0.961, 1.69620, air_on));
}

TEST(slip, has_the_unstable_two_cycle_of_figure_9) {
    model_row row = paper_row(1.5, 10.0, pi_double / 4, 3.95, 0.148771, gravity_off);
    EXPECT_NEAR(run(row).angle, 0.480899, 2e-6);
    row.returns = 2;
    // Newton's method on the second iterate from the page's 6 digits
    double angle = 0.148771;
    for (int i = 0; i < 4; ++i) {
        row.columns[1] = print_real(angle);
        angle -= (run(row).angle - angle) / (multiplier(row, angle) - 1.0);
    }
    EXPECT_NEAR(angle, 0.148771, 1e-6);
    EXPECT_NEAR(multiplier(row, angle), -1.858, 5e-4);
}

TEST(slip, has_the_gaits_of_figure_4_with_gravity_in_stance) {
    // caption: v 45, 35, 15, 8; beta 0.95 above, 1.0 below
    const double stiffness[] = {2000.0, 1000.0, 250.0, 100.0};
    const double betas[] = {0.95, 0.95, 1.0, 1.0};
    const double speeds[] = {45.0, 35.0, 15.0, 8.0};
    const double angles[] = {0.231712, 0.164726, 0.151585, 0.141161};
    const double multipliers[] = {0.2261, -0.0536, -0.1283, -0.2884};
    for (int i = 0; i < 4; ++i) {
        const model_row row = paper_row(1.5, stiffness[i], betas[i], speeds[i], 0.0, linear_on);
        const double angle = fixed_angle(row, angles[i] - 0.01, angles[i] + 0.01);
        EXPECT_NEAR(angle, angles[i], 6e-7);  // the page's digits
        EXPECT_NEAR(multiplier(row, angle), multipliers[i], 6e-5);
    }
}

TEST(slip, doubles_its_period_with_a_hooke_spring_and_gravity) {
    // against the paper's "no period doubling": beta = 1, gt = 0.6, kt = 5.513 has an attracting
    // 2-cycle
    model_row row = numbers_row(1.0, 5.513, 0.6, 0.015797, linear_on);
    EXPECT_NEAR(run(row).angle, 0.115345,
                5e-5);  // the last digit of 0.015797 is amplified on the way
    row.returns = 400;
    const double settled = run(row).angle;
    row.columns[1] = print_real(settled);
    row.returns = 2;
    EXPECT_NEAR(run(row).angle, settled, 1e-9);
    EXPECT_LT(std::abs(multiplier(row, settled)), 1.0);
    row.returns = 1;
    const double other = run(row).angle;
    EXPECT_NEAR(std::min(settled, other), 0.015797, 6e-7);
    EXPECT_NEAR(std::max(settled, other), 0.115345, 6e-7);
}

TEST(slip, tends_to_the_corrected_high_speed_limit) {
    // k = 10, beta = pi/4, eta0 = 1.5, v = 100: v^2 delta / J = 1.00045, lambda2 = -8.494
    const double beta = pi_double / 4;
    const double limit =
        10.0 * 1.5 * 1.5 * std::sin(beta) * (std::asinh(1.0 / std::tan(beta)) - std::cos(beta));
    const double angle = fixed_angle(paper_row(1.5, 10.0, beta, 100.0, 0.0, gravity_off),
                                     0.9 * limit * 1e-4, 1.1 * limit * 1e-4);
    EXPECT_NEAR(1e4 * angle / limit, 1.00045, 6e-6);
    EXPECT_NEAR(multiplier(paper_row(1.5, 10.0, beta, 100.0, 0.0, gravity_off), angle), -8.494,
                6e-4);
}

TEST(slip, satisfies_the_multiplier_formula) {
    // (2.24): P' = 1 - (1 + gt cos beta cot delta) dpsi/ddelta; air spring, dpsi/dalpha in closed
    // form
    const double alpha = 0.85, gravity = 0.2, stiffness = 0.4;
    const double s = std::sin(alpha), c = std::cos(alpha);
    const double q = std::sqrt(stiffness + s * s);
    const double beta = pi_double / 2 - s / q * std::atan(c / q);  // makes it a fixed point
    const double angle = beta - alpha;
    const double slope = 2 * (stiffness * c / (q * q * q) * std::atan(c / q) - s * s / (q * q));
    const double expected = 1 + (1 + gravity * std::cos(beta) / std::tan(angle)) * slope;
    EXPECT_NEAR(run(numbers_row(beta, stiffness, gravity, angle, air_off)).sweep,
                pi_double - 2 * beta, 1e-14);
    EXPECT_NEAR(multiplier(numbers_row(beta, stiffness, gravity, 0.0, air_off), angle), expected,
                1e-12);
}

}  // namespace
}  // namespace hopscotch
