// The impacting relief valve: against Runge-Kutta in the original coordinates, against 50 digits,
// and against what holds in closed form on its seat.
#include "kernels/models/relief_valve.hpp"

#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;

model_row valve_row(double x, double p, double flow, std::uint32_t returns,
                    double restitution = 0.8) {
    return {"maximum",
            {print_real(x), print_real(p)},
            {{"flow_rate", print_real(flow)}, {"restitution", print_real(restitution)}},
            {},
            returns};
}

struct valve_state {
    double x, v, p;
};
valve_state rate(const valve_state& s, double flow) {
    return {s.v, -1.25 * s.v - (s.x + 10.0) + s.p, 20.0 * (flow - s.x * std::sqrt(s.p))};
}
valve_state advanced(const valve_state& s, double h, double flow) {
    const auto at = [](const valve_state& a, const valve_state& k, double f) {
        return valve_state{a.x + f * k.x, a.v + f * k.v, a.p + f * k.p};
    };
    const valve_state a = rate(s, flow);
    const valve_state b = rate(at(s, a, h / 2), flow);
    const valve_state c = rate(at(s, b, h / 2), flow);
    const valve_state d = rate(at(s, c, h), flow);
    return {s.x + h / 6 * (a.x + 2 * b.x + 2 * c.x + d.x),
            s.v + h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v),
            s.p + h / 6 * (a.p + 2 * b.p + 2 * c.p + d.p)};
}

/// The maxima by classical Runge-Kutta in the original equations, events by shrinking the step.
valve_state reference(valve_state s, double flow, int returns, double& time, int& impacts) {
    const double full = 2e-4;
    while (returns > 0) {
        const valve_state next = advanced(s, full, flow);
        const bool hits = next.x < 0.0;
        const bool peaks = s.v > 0.0 && next.v < 0.0;
        if (!hits && !peaks) {
            s = next;
            time += full;
            continue;
        }
        double low = 0.0, high = full;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            const valve_state there = advanced(s, middle, flow);
            (hits ? there.x < 0.0 : there.v < 0.0) ? high = middle : low = middle;
        }
        s = advanced(s, high, flow);
        time += high;
        if (hits) {
            s.x = 0.0;
            s.v = -0.8 * s.v;
            ++impacts;
        } else {
            s.v = -1e-300;
            --returns;
        }
    }
    return s;
}

TEST(relief_valve, agrees_with_runge_kutta_in_the_original_coordinates) {
    for (const double flow : {1.0, 4.0, 7.0}) {
        double time = 0.0;
        int impacts = 0;
        const valve_state expected = reference({2.0, -1e-300, 3.0}, flow, 4, time, impacts);
        const orbit_answer answer = run_row<relief_valve>(valve_row(2.0, 3.0, flow, 4));
        ASSERT_EQ(answer.end, outcome::ok);
        // fourth order, 2e-4: local errors below 1e-14, some 1e4 steps
        EXPECT_NEAR(number(answer.columns[0]), expected.x, 1e-8) << flow;
        EXPECT_NEAR(number(answer.columns[1]), expected.p, 1e-7) << flow;
        EXPECT_NEAR(number(answer.time), time, 1e-8) << flow;
        EXPECT_EQ(number(answer.extras[0]), impacts) << flow;
    }
}

TEST(relief_valve, starts_from_an_empty_chamber) {
    // the benchmark's start (0.2, 0, 0): sqrt p is not differentiable there, the series is
    for (const double flow : {0.2, 3.0, 9.0}) {
        const orbit_answer plain = run_row<relief_valve>(valve_row(0.2, 0.0, flow, 3));
        const orbit_answer truth =
            run_row<relief_valve>(valve_row(0.2, 0.0, flow, 3), arithmetic::mp50);
        ASSERT_EQ(plain.end, outcome::ok);
        EXPECT_NEAR(number(plain.columns[0]), number(truth.columns[0]),
                    1e-12 * number(truth.columns[0]));
        EXPECT_NEAR(number(plain.columns[1]), number(truth.columns[1]),
                    1e-12 * number(truth.columns[1]));
    }
}

TEST(relief_valve, agrees_with_fifty_digits_on_random_orbits) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 12; ++i) {
        const model_row row = valve_row(0.1 + 6.0 * unit(random), 1.0 + 12.0 * unit(random),
                                        0.3 + 9.0 * unit(random), 3);
        const orbit_answer plain = run_row<relief_valve>(row);
        const orbit_answer truth = run_row<relief_valve>(row, arithmetic::mp50);
        ASSERT_EQ(plain.end, truth.end);
        EXPECT_EQ(plain.extras, plain.extras);
        // three returns amplify a rounding error by a few tens at most
        EXPECT_NEAR(number(plain.columns[0]), number(truth.columns[0]), 1e-12) << i;
        EXPECT_NEAR(number(plain.columns[1]), number(truth.columns[1]), 5e-12) << i;
        EXPECT_NEAR(number(plain.time), number(truth.time), 1e-12) << i;
    }
}

TEST(relief_valve, differentiates_through_impacts) {
    model_row row = valve_row(2.0, 3.0, 1.5, 2);
    row.derivative = true;
    const orbit_answer exact = run_row<relief_valve>(row);
    ASSERT_GT(number(exact.extras[0]), 0.0);  // the saltation is in it
    row.derivative = false;
    const real50 h("1e-20");
    for (std::size_t start = 0; start < 2; ++start) {
        const real50 middle = parse_real<real50>(row.columns[start]);
        model_row shifted = row;
        shifted.columns[start] = print_real(middle + h);
        const orbit_answer above = run_row<relief_valve>(shifted, arithmetic::mp50);
        shifted.columns[start] = print_real(middle - h);
        const orbit_answer below = run_row<relief_valve>(shifted, arithmetic::mp50);
        for (std::size_t c = 0; c < 2; ++c) {
            const real50 slope = (real50(above.columns[c]) - real50(below.columns[c])) / (h + h);
            const double expected = to_double(slope);
            EXPECT_NEAR(number(exact.derivative[2 * c + start]), expected,
                        1e-10 * (1 + std::abs(expected)));
        }
    }
}

TEST(relief_valve, waits_on_its_seat_until_the_pressure_opens_it) {
    const orbit_answer early = run_row<relief_valve>(valve_row(0.0, 5.0, 2.0, 1));
    const orbit_answer late = run_row<relief_valve>(valve_row(0.0, 9.0, 2.0, 1));
    EXPECT_EQ(early.columns, late.columns);  // both open at p = 10, v = 0
    EXPECT_NEAR(number(early.time) - number(late.time), 4.0 / (20.0 * 2.0), 1e-15);
}

TEST(relief_valve, ends_chatter_on_its_seat_and_forgets_its_start) {
    // infinitely many impacts in finite time: the closed valve then opens from one and the same
    // state
    const orbit_answer from_seat = run_row<relief_valve>(valve_row(0.0, 5.0, 0.2, 1, 0.3));
    model_row row = valve_row(0.2, 0.0, 0.2, 1, 0.3);
    std::uint32_t first = 0;
    for (std::uint32_t n = 1; n < 60 && first == 0; ++n) {
        row.returns = n;
        const orbit_answer answer = run_row<relief_valve>(row);
        ASSERT_EQ(answer.end, outcome::ok);
        if (answer.columns == from_seat.columns) first = n;
    }
    EXPECT_GT(first, 5u);
    row.returns = first;
    row.columns[1] = "1";  // p > 0, where the derivative by p exists
    row.derivative = true;
    const orbit_answer other = run_row<relief_valve>(row);
    const orbit_answer truth = run_row<relief_valve>(row, arithmetic::mp50);
    EXPECT_EQ(other.end, outcome::ok);
    EXPECT_EQ(truth.end, outcome::ok);
}

TEST(relief_valve, closes_at_once_where_the_seat_absorbs_everything) {
    const orbit_answer answer = run_row<relief_valve>(valve_row(0.2, 0.0, 0.2, 1, 0.0));
    const orbit_answer from_seat = run_row<relief_valve>(valve_row(0.0, 5.0, 0.2, 1, 0.0));
    EXPECT_EQ(answer.columns, from_seat.columns);
    EXPECT_EQ(number(answer.extras[0]), 1.0);
}

TEST(relief_valve, rests_at_its_equilibrium) {
    // x sqrt(x + 10) = q: x = 6, p = 16, q = 24 exactly
    EXPECT_EQ(run_row<relief_valve>(valve_row(6.0, 16.0, 24.0, 3)).end, outcome::rest);
    // a stable one is reached from nearby and not iterated in its rounding noise
    const orbit_answer answer = run_row<relief_valve>(valve_row(6.1, 16.0, 24.0, 20000));
    EXPECT_EQ(answer.end, outcome::rest);
    EXPECT_NEAR(number(answer.columns[0]), 6.0, 1e-11);
}

TEST(relief_valve, bounces_for_ever_on_an_elastic_seat) {
    const orbit_answer answer = run_row<relief_valve>(valve_row(2.0, 3.0, 1.0, 300, 1.0));
    EXPECT_EQ(answer.end, outcome::ok);
    EXPECT_GT(number(answer.extras[0]), 100.0);
}

TEST(relief_valve, refuses_states_below_its_seat) {
    EXPECT_EQ(run_row<relief_valve>(valve_row(-0.1, 3.0, 1.0, 1)).end, outcome::invalid_start);
    EXPECT_EQ(run_row<relief_valve>({"maximum", {"nan", "1"}, {}, {}}).end, outcome::invalid_start);
}

}  // namespace
}  // namespace hopscotch
