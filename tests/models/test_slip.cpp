// The spring-mass runner: hard cases of its page (models/slip.md, section 13), outcomes, sections,
// and 50-digit runs.
#include "tests/models/slip_rows.hpp"

#include "kernels/models/slip.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::slip_rows;

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
