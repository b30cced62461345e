// The spring-mass runner against its page (models/slip.md): published numbers, hard cases, closed
// forms, 50-digit runs.
#include "kernels/models/slip.hpp"

#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;
using names = std::vector<std::pair<std::string, std::string>>;

constexpr double pi_double = 3.14159265358979323846;
const names gravity_off{{"stance_gravity", "off"}};
const names air_off{{"spring", "air"}, {"stance_gravity", "off"}};
const names linear_on{};
const names air_on{{"spring", "air"}};

/// A start given by the three numbers of the map: leg length, mass and speed 1.
model_row numbers_row(double beta, double stiffness, double gravity, double angle, names options) {
    return {"touchdown",
            {"1", print_real(angle)},
            {{"mass", "1"},
             {"leg_length", "1"},
             {"stiffness", print_real(stiffness)},
             {"gravity", print_real(gravity)},
             {"touchdown_angle", print_real(beta)}},
            std::move(options)};
}

/// A start as the paper gives it: mass 1, g = 9.81.
model_row paper_row(double leg, double stiffness, double beta, double speed, double angle,
                    names options) {
    return {"touchdown",
            {print_real(speed), print_real(angle)},
            {{"leg_length", print_real(leg)},
             {"stiffness", print_real(stiffness)},
             {"touchdown_angle", print_real(beta)}},
            std::move(options)};
}

struct stride {
    outcome end;
    double angle, sweep, time;
};
stride run(const model_row& row, arithmetic kind = arithmetic::plain) {
    const orbit_answer answer = run_row<slip>(row, kind);
    return {answer.end, number(answer.columns[1]), number(answer.extras[0]), number(answer.time)};
}

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

TEST(slip, passes_glancing_touchdowns_whole_inside_the_first_step) {
    const double beta = 1.2;
    for (const names& options : {gravity_off, air_off, linear_on, air_on}) {
        const bool is_air = options == air_off || options == air_on;
        const bool has_gravity = options == linear_on || options == air_on;
        const model_row row = numbers_row(beta, 5.0, 0.2, beta - pi_double / 2 + 1e-6, options);
        const stride answer = run(row);
        EXPECT_EQ(answer.end, outcome::ok);
        // leading order: stance 2 C / (1 - gt sin beta), air + ct in the denominator; sweep = that,
        // times s
        const double denominator =
            1.0 - (has_gravity ? 0.2 * std::sin(beta) : 0.0) + (is_air ? 5.0 : 0.0);
        EXPECT_NEAR(answer.sweep / (2e-6 / denominator), 1.0, 3e-6) << is_air << has_gravity;
        EXPECT_NEAR(answer.sweep, run(row, arithmetic::mp50).sweep, 1e-15);
    }
}

TEST(slip, sweeps_as_the_page_says_into_the_leg) {
    const double stiffness[] = {0.99, 1.0, 1.01};
    const double sweeps[] = {2.362955452679, 2.099461035916, 1.738154571979};
    for (int i = 0; i < 3; ++i) {
        const stride answer = run(numbers_row(1.2, stiffness[i], 0.1, 1.2 - 1e-3, gravity_off));
        EXPECT_NEAR(answer.sweep, sweeps[i], 1e-12);  // 13 digits; delta carries alpha to 1e-16
    }
    EXPECT_NEAR(run(numbers_row(1.2, 0.5, 0.1, 1.2 - 1e-6, gravity_off)).sweep, 3.141555766664,
                1e-11);
}

TEST(slip, collapses_head_on_only_where_the_spring_is_weak) {
    EXPECT_EQ(run(numbers_row(1.2, 0.9, 0.1, 1.2, gravity_off)).end, outcome::ground);
    EXPECT_EQ(run(numbers_row(1.2, 1.0, 0.1, 1.2, gravity_off)).end, outcome::ground);
    const stride hard = run(numbers_row(1.2, 1.5, 0.1, 1.2, gravity_off));
    EXPECT_EQ(hard.end, outcome::reverse);  // thrown straight back
    EXPECT_EQ(hard.sweep, 0.0);
    EXPECT_EQ(run(numbers_row(1.2, 0.2, 0.1, 1.2, air_off)).sweep, 0.0);
}

TEST(slip, resolves_the_stumble_next_to_the_gap) {
    // the page's v_GP = 1.715498 setting has its own g, so the edge is bisected here; D =
    // (angle')^2
    const auto at = [](double share) {
        static const double edge = [] {
            double low = 1.7150, high = 1.7160;
            for (int i = 0; i < 50; ++i) {
                const double middle = 0.5 * (low + high);
                const model_row row = paper_row(0.173, 0.01839, 0.961, middle, 0.36359030, air_off);
                (run(row).end == outcome::stumble ? high : low) = middle;
            }
            return low;
        }();
        return run(paper_row(0.173, 0.01839, 0.961, edge * (1.0 + share), 0.36359030, air_off));
    };
    const stride near = at(-1e-6);
    EXPECT_EQ(near.end, outcome::ok);
    EXPECT_NEAR(near.angle, 9.46e-4, 1e-6);
    const stride nearer = at(-1e-12);
    EXPECT_EQ(nearer.end, outcome::ok);
    EXPECT_NEAR(nearer.angle, 9.463e-7,
                3e-9);  // D is known to 1e-16, angle' to 1e-16 / (2 angle') = 5e-11
    EXPECT_EQ(at(1e-12).end, outcome::stumble);
}

TEST(slip, falls_to_the_ground_through_a_weak_spring) {
    const stride without = run(paper_row(1.5, 50.0, 0.8, 11.0, 0.79, gravity_off));
    EXPECT_EQ(without.end, outcome::ground);
    EXPECT_NEAR(without.sweep, 2.482337, 6e-7);
    const stride with = run(paper_row(1.5, 50.0, 0.8, 11.0, 0.79, linear_on));
    EXPECT_EQ(with.end, outcome::ground);
    EXPECT_NEAR(with.time * 11.0 / 1.5, 1.097, 5e-4);
}

TEST(slip, applies_the_physical_gap_not_the_papers) {
    // k = 10, eta0 = 1.5, beta = pi/4, v = 8: (2.26) "holds" again on (0.756, pi/4), below ground
    // level
    EXPECT_EQ(run(paper_row(1.5, 10.0, pi_double / 4, 8.0, 0.3, gravity_off)).end,
              outcome::stumble);
    EXPECT_EQ(run(paper_row(1.5, 10.0, pi_double / 4, 8.0, 0.77, gravity_off)).end,
              outcome::ground);
    EXPECT_EQ(run(paper_row(1.5, 10.0, pi_double / 4, 8.0, 0.045, gravity_off)).end, outcome::ok);
}

TEST(slip, reaches_every_outcome) {
    for (const names& options : {gravity_off, linear_on}) {
        EXPECT_EQ(run(numbers_row(1.0, 5.0, 0.1, 1.0 - pi_double / 2 - 0.01, options)).end,
                  outcome::no_contact);
        EXPECT_EQ(run(numbers_row(1.0, 30.0, 0.1, 0.99, options)).end, outcome::reverse);
    }
    // a gravity-free stance that ends higher than the energy allows: delta = -0.5, weak sweep, gt =
    // 5
    EXPECT_EQ(run(numbers_row(0.5, 2.0, 5.0, 0.0, gravity_off)).end, outcome::energy_deficit);
    const model_row low{"apex", {"1.0", "3"}, {}, gravity_off};  // below eta0 sin beta = 1.42
    EXPECT_EQ(run(low).end, outcome::stumble);
    const model_row still{"touchdown", {"0", "0.1"}, {}, gravity_off};
    EXPECT_EQ(run_row<slip>(still).end, outcome::invalid_start);
}

TEST(slip, stands_the_same_at_apex_and_touchdown) {
    for (const names& options : {gravity_off, linear_on}) {
        const double h = 1.5 * std::sin(1.0), v = 8.4, angle = 0.15;
        const model_row down = paper_row(1.5, 100.0, 1.0, v, angle, options);
        const model_row apex{
            "apex",
            {print_real(h + v * v * std::sin(angle) * std::sin(angle) / (2 * 9.81)),
             print_real(v * std::cos(angle))},
            {{"touchdown_angle", "1"}},
            options};
        const orbit_answer one = run_row<slip>(down);
        const orbit_answer other = run_row<slip>(apex);
        ASSERT_EQ(one.end, outcome::ok);
        ASSERT_EQ(other.end, outcome::ok);
        const double next = number(one.columns[1]);
        EXPECT_NEAR(number(other.columns[0]),
                    h + v * v * std::sin(next) * std::sin(next) / (2 * 9.81), 1e-14);
        EXPECT_NEAR(number(other.columns[1]), v * std::cos(next), 1e-14);
        EXPECT_NEAR(number(other.time),
                    number(one.time) + v * (std::sin(angle) - std::sin(next)) / 9.81, 1e-14);
    }
}

TEST(slip, keeps_its_speed_for_ever) {
    model_row row = paper_row(1.5, 100.0, 1.25, 4.5, 0.2, gravity_off);
    row.returns = 2000;
    const orbit_answer answer = run_row<slip>(row);
    EXPECT_EQ(answer.end, outcome::ok);
    EXPECT_EQ(number(answer.columns[0]), 4.5);
    EXPECT_EQ(answer.events, 4000u);
}

/// Random starts and their answers in double and 50 digits.
void compare_with_truth(const names& options, int n, double tolerance) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const bool is_air = !options.empty() && options[0].second == "air";
    int completed = 0;
    for (int i = 0; i < n; ++i) {
        const double beta = 0.6 + 0.8 * unit(random);
        const double angle = (beta - 0.05) * unit(random);
        const double stiffness = is_air ? 0.2 + 2.0 * unit(random) : 1.2 + 12.0 * unit(random);
        const model_row row =
            numbers_row(beta, stiffness, 0.01 + 0.3 * unit(random), angle, options);
        const stride plain = run(row);
        const stride truth = run(row, arithmetic::mp50);
        ASSERT_EQ(plain.end, truth.end) << i;
        EXPECT_NEAR(plain.sweep, truth.sweep, tolerance) << i;
        EXPECT_NEAR(plain.time, truth.time, 20 * tolerance * truth.time)
            << i;  // 1 / gt in the flight
        if (truth.end != outcome::ok) continue;
        ++completed;
        // D is good to the tolerance, its root to that over 2 angle'
        EXPECT_NEAR(plain.angle, truth.angle, tolerance * (1 + 1 / truth.angle)) << i;
    }
    EXPECT_GT(completed, n / 8);
}

TEST(slip, agrees_with_fifty_digits_on_random_strides) {
    compare_with_truth(air_off, 60, 5e-15);      // closed form: a few rounding errors
    compare_with_truth(gravity_off, 12, 2e-14);  // 16 nodes
    compare_with_truth(linear_on, 12, 2e-14);    // some six steps of local error 7e-15
    compare_with_truth(air_on, 12, 2e-14);
}

TEST(slip, differentiates_its_map_exactly) {
    for (const names& options : {gravity_off, air_off, linear_on, air_on}) {
        const bool is_air = !options.empty() && options[0].second == "air";
        model_row row = numbers_row(1.0, is_air ? 0.8 : 8.0, 0.1, 0.25, options);
        row.derivative = true;
        const orbit_answer exact = run_row<slip>(row);
        ASSERT_EQ(exact.end, outcome::ok);
        row.derivative = false;
        const real50 h("1e-20");  // central differences: error h^2, rounding 1e-50 / h
        for (int column = 0; column < 2; ++column) {
            model_row shifted = row;
            const real50 middle = parse_real<real50>(row.columns[static_cast<std::size_t>(column)]);
            shifted.columns[static_cast<std::size_t>(column)] = print_real(middle + h);
            const real50 above(run_row<slip>(shifted, arithmetic::mp50).columns[1]);
            shifted.columns[static_cast<std::size_t>(column)] = print_real(middle - h);
            const real50 below(run_row<slip>(shifted, arithmetic::mp50).columns[1]);
            const double expected = to_double((above - below) / (h + h));
            EXPECT_NEAR(number(exact.derivative[static_cast<std::size_t>(2 + column)]), expected,
                        1e-12)
                << is_air << " column " << column;
        }
        EXPECT_EQ(number(exact.derivative[0]), 1.0);  // the speed is a constant
        EXPECT_EQ(number(exact.derivative[1]), 0.0);
    }
}

TEST(slip, rejects_numbers_that_are_not_finite) {
    for (const names& options : {gravity_off, air_off, linear_on, air_on}) {
        const model_row row{"touchdown", {"nan", "0.1"}, {}, options};
        EXPECT_EQ(run_row<slip>(row).end, outcome::invalid_start);
        const model_row angle{"touchdown", {"5", "nan"}, {}, options};
        EXPECT_EQ(run_row<slip>(angle).end, outcome::invalid_start);
    }
}

}  // namespace
}  // namespace hopscotch
