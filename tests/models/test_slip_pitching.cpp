// The pitching spring-mass runner against its page (models/slip.md section 6, Fig. 5 rows of section 11, cases
// 9 and 12 of section 13), the runner without pitching, and 50-digit runs.
#include "kernels/models/slip.hpp"
#include "kernels/models/slip_pitching.hpp"

#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace testing_models;
using names = std::vector<std::pair<std::string, std::string>>;
using model = slip_pitching;

constexpr double pi_double = 3.14159265358979323846;
constexpr double weight = 9.81;
const names inertial{};
const names body{{"leg_placement", "body"}};
const names air{{"spring", "air"}};
const names air_body{{"spring", "air"}, {"leg_placement", "body"}};

/// A gait of Fig. 5 (k = 100, m = 1, eta0 = 1.5, beta = 1) as the page prints it.
struct published_gait {
    const char* hip;
    const char* inertia;
    const char* speed;
    names options;
    double angle, pitch, pitch_rate;
    std::array<double, 3> tolerance;  // one unit of the page's last digits (one of them is rounded up)
};
const published_gait fig5a{"0.015", "0.0225", "7.93", inertial, 0.146967, -0.0103113, -0.0871074,
                           {1e-6, 1e-7, 1e-7}};
const published_gait fig5a_body{"0.015", "0.0225", "7.93", body, 0.129579, -0.0087209, -0.0834911,
                                {1e-6, 1e-7, 1e-7}};
const published_gait fig5b{"0.15", "0.000225", "8.26", inertial, 0.124398, -0.318410, -3.04778,
                           {1e-6, 1e-6, 1e-5}};
const published_gait fig5b_other{"0.15", "0.000225", "8.26", inertial, 0.115440, -0.522890, -5.39149,
                                 {1e-6, 1e-6, 1e-5}};

model_row gait_row(const published_gait& gait) {
    return {"touchdown",
            {gait.speed, print_real(gait.angle), print_real(gait.pitch), print_real(gait.pitch_rate)},
            {{"touchdown_angle", "1"}, {"hip_offset", gait.hip}, {"inertia", gait.inertia}},
            gait.options};
}

double energy(double speed, double hip_height, double hip, double inertia, double pitch, double rate) {
    return 0.5 * speed * speed + weight * (hip_height - hip * std::cos(pitch)) + 0.5 * inertia * rate * rate;
}

using matrix = std::array<std::array<double, 4>, 4>;

struct linearised {
    std::array<double, 4> state;
    matrix slope;
};
linearised linearise(model_row row) {
    row.derivative = true;
    const orbit_answer answer = run_row<model>(row);
    EXPECT_EQ(answer.end, outcome::ok);
    linearised result{};
    for (std::size_t i = 0; i < 4; ++i) {
        result.state[i] = number(answer.columns[i]);
        for (std::size_t j = 0; j < 4; ++j) result.slope[i][j] = number(answer.derivative[4 * i + j]);
    }
    return result;
}

/// Newton's method on the gait at constant touchdown speed: three columns, three unknowns.
model_row polished(model_row row) {
    for (int iteration = 0; iteration < 6; ++iteration) {
        const linearised map = linearise(row);
        double a[3][4];
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) a[i][j] = map.slope[i + 1][j + 1] - (i == j ? 1.0 : 0.0);
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

/// Coefficients p of x^4 + p[3] x^3 + ... + p[0], the characteristic polynomial (Faddeev, Leverrier).
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

TEST(slip_pitching, is_the_runner_without_pitching_where_the_hip_is_the_centre) {
    for (const names& options : {inertial, air}) {
        const bool is_air = !options.empty();
        for (const char* angle : {"0.1", "0.16", "0.3", "0.6", "0.9"}) {
            const model_row row{"touchdown",
                                {"8", angle, "0.3", "0"},
                                {{"touchdown_angle", "1"}, {"hip_offset", "0"}, {"stiffness", is_air ? "60" : "100"}},
                                options};
            model_row plain{"touchdown", {"8", angle}, {row.set[0], row.set[2]}, options};
            const orbit_answer pitching = run_row<model>(row);
            const orbit_answer without = run_row<slip>(plain);
            ASSERT_EQ(pitching.end, without.end) << angle;
            EXPECT_EQ(pitching.events, without.events);
            EXPECT_NEAR(number(pitching.time), number(without.time), 1e-13);  // both some six Taylor steps
            EXPECT_NEAR(number(pitching.columns[0]), 8.0, 1e-14);
            EXPECT_NEAR(number(pitching.columns[1]), number(without.columns[1]), 1e-12);
            EXPECT_EQ(number(pitching.columns[2]), 0.3);
        }
    }
}

TEST(slip_pitching, ignores_pitch_and_turning_where_the_hip_is_the_centre) {
    // inertial: a body that turns evenly changes nothing, and turns through the whole stride
    model_row row{"touchdown", {"8", "0.16", "0.3", "0"}, {{"touchdown_angle", "1"}, {"hip_offset", "0"}}, {}};
    const orbit_answer still = run_row<model>(row);
    row.columns[3] = "7";
    const orbit_answer turning = run_row<model>(row);
    EXPECT_NEAR(number(turning.columns[1]), number(still.columns[1]), 1e-13);
    EXPECT_NEAR(number(turning.columns[2]), 0.3 + 7.0 * number(turning.time), 1e-13);
    EXPECT_NEAR(number(turning.columns[3]), 7.0, 1e-13);
}

/// Random starts near gaits, both springs and placements.
struct random_rows {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> unit{0.0, 1.0};

    model_row next(const names& options) {
        const bool is_air = !options.empty() && options[0].second == "air";
        return {"touchdown",
                {print_real(5.0 + 4.0 * unit(random)), print_real(0.05 + 0.3 * unit(random)),
                 print_real(0.4 * (unit(random) - 0.5)), print_real(4.0 * (unit(random) - 0.5))},
                {{"touchdown_angle", print_real(0.9 + 0.3 * unit(random))},
                 {"hip_offset", print_real(0.2 * (unit(random) - 0.3))},
                 {"inertia", print_real(0.02 + 0.2 * unit(random))},
                 {"stiffness", print_real(is_air ? 30.0 + 60.0 * unit(random) : 60.0 + 100.0 * unit(random))}},
                options};
    }
};

double energy_of(const model_row& row, const std::vector<std::string>& columns) {
    const double beta = number(row.set[0].second);
    const bool is_body = !row.options.empty() && row.options.back().second == "body";
    const double pitch = number(columns[2]);
    return energy(number(columns[0]), 1.5 * std::sin(is_body ? beta - pitch : beta), number(row.set[1].second),
                  number(row.set[2].second), pitch, number(columns[3]));
}

TEST(slip_pitching, conserves_the_energy_of_touchdown) {
    random_rows rows;
    for (const names& options : {inertial, body, air, air_body}) {
        int completed = 0;
        for (int i = 0; i < 40; ++i) {
            model_row row = rows.next(options);
            const orbit_answer answer = run_row<model>(row);
            if (answer.end != outcome::ok) continue;
            ++completed;
            const double before = energy_of(row, row.columns);
            EXPECT_NEAR(energy_of(row, answer.columns), before, 4e-15 * before);  // some ulps
        }
        EXPECT_GT(completed, 5);
    }
    // nothing drifts over many strides next to the weakly unstable gait (page, case 8)
    model_row row = gait_row(fig5a);
    row.returns = 500;
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::ok);
    EXPECT_NEAR(energy_of(row, answer.columns), energy_of(row, row.columns), 4e-15 * energy_of(row, row.columns));
}

TEST(slip_pitching, stays_close_to_the_weakly_unstable_gait_for_500_strides) {
    // page, case 9: e-fold growth takes 3400 strides, so 500 strides grow the page's rounding by 16 %; the
    // eigenbasis is skew, hence the factor
    model_row row = gait_row(fig5a);
    row.returns = 500;
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::ok);
    EXPECT_NEAR(number(answer.columns[1]), fig5a.angle, 1e-5);
    EXPECT_NEAR(number(answer.columns[2]), fig5a.pitch, 1e-5);
    EXPECT_EQ(answer.events, 1000u);
}

TEST(slip_pitching, goes_on_from_what_it_printed) {
    for (const names& options : {inertial, body}) {
        model_row row = gait_row(options == inertial ? fig5a : fig5a_body);
        row.returns = 6;
        const orbit_answer whole = run_row<model>(row);
        ASSERT_EQ(whole.end, outcome::ok);
        row.returns = 3;
        const orbit_answer half = run_row<model>(row);
        row.columns = half.columns;
        const orbit_answer rest = run_row<model>(row);
        // the conserved energy is found anew from the columns: one rounding of the speed
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(number(rest.columns[i]), number(whole.columns[i]), 2e-14) << i;
        }
        EXPECT_NEAR(number(half.time) + number(rest.time), number(whole.time), 1e-14);
    }
}

TEST(slip_pitching, agrees_with_fifty_digits_on_random_strides) {
    random_rows rows;
    for (const names& options : {inertial, body, air, air_body}) {
        for (int i = 0; i < 4; ++i) {
            const model_row row = rows.next(options);
            const orbit_answer plain = run_row<model>(row);
            const orbit_answer truth = run_row<model>(row, arithmetic::mp50);
            ASSERT_EQ(plain.end, truth.end) << i;
            EXPECT_EQ(plain.events, truth.events);
            // some ten steps of local error 7e-15, times the stride's own slopes (up to about 10)
            EXPECT_NEAR(number(plain.time), number(truth.time), 2e-13) << i;
            for (std::size_t c = 0; c < 4; ++c) {
                EXPECT_NEAR(number(plain.columns[c]), number(truth.columns[c]), 1e-12) << i << " column " << c;
            }
        }
    }
}

TEST(slip_pitching, differentiates_its_map_exactly) {
    const published_gait gaits[] = {fig5a, fig5a_body};
    for (const published_gait& gait : gaits) {
        const model_row row = gait_row(gait);
        const linearised exact = linearise(row);
        const real50 h("1e-18");  // central differences: error 1e-36 f''', rounding 1e-48 / h
        for (std::size_t j = 0; j < 4; ++j) {
            model_row shifted = row;
            const real50 middle = parse_real<real50>(row.columns[j]);
            shifted.columns[j] = print_real(middle + h);
            const orbit_answer above = run_row<model>(shifted, arithmetic::mp50);
            shifted.columns[j] = print_real(middle - h);
            const orbit_answer below = run_row<model>(shifted, arithmetic::mp50);
            for (std::size_t i = 0; i < 4; ++i) {
                const double expected = to_double((real50(above.columns[i]) - real50(below.columns[i])) / (h + h));
                EXPECT_NEAR(exact.slope[i][j], expected, 1e-11 * (1 + std::abs(expected))) << i << j;
            }
        }
    }
}

/// Height of the foot held ready by a body that turns evenly, scanned finely: first downward zero after it was
/// above. The truth for flights that turn many times.
double scanned_touchdown(double height, double climb, double pitch, double rate, double hip, double beta,
                         double leg, double end) {
    const auto foot = [&](double t) {
        const double turned = pitch + rate * t;
        return height + climb * t - 0.5 * weight * t * t + hip * std::cos(turned) - leg * std::sin(beta - turned);
    };
    const double step = 1e-3 / std::abs(rate);
    bool above = foot(0.0) > 0.0;
    for (double t = 0.0; t < end; t += step) {
        const double value = foot(t + step);
        if (above && value <= 0.0) {
            double low = t, high = t + step;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (foot(middle) > 0.0 ? low : high) = middle;
            }
            return 0.5 * (low + high);
        }
        above = above || value > 0.0;
    }
    return -1.0;
}

TEST(slip_pitching, finds_the_first_touchdown_of_a_body_that_spins) {
    // page, case 12; the search is asked directly, in units where gravity and the leg are 1
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int found = 0;
    int missed = 0;
    for (int i = 0; i < 60; ++i) {
        const double beta = 0.7 + 0.6 * unit(random);
        const double hip = 0.3 * (unit(random) - 0.3);
        const double height = 0.3 + 1.2 * unit(random);
        const double climb = 2.0 * (unit(random) - 0.4);
        const double pitch = 6.0 * unit(random);
        const double rate = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, 0.5 + 2.0 * unit(random));
        const spring_leg::foot_height<double> foot{
            height, climb, pitch, rate, hip - std::sin(beta), std::cos(beta), 0.0};
        const auto search = spring_leg::first_touchdown(foot, true);
        ASSERT_FALSE(search.unresolved) << i;
        // the scan has g = 9.81: lengths stay, times shrink by sqrt(g)
        const double root = std::sqrt(weight);
        const double end = spring_leg::fall_time(height, climb) / root;
        const double truth = scanned_touchdown(height, climb * root, pitch, rate * root, hip, beta, 1.0, end);
        ASSERT_EQ(search.found, truth >= 0.0) << i;
        if (truth >= 0.0) {
            EXPECT_NEAR(search.time, truth * root, 1e-12) << i;
        }
        ++(search.found ? found : missed);
    }
    EXPECT_GT(found, 20);
    EXPECT_GE(missed, 1);
}

TEST(slip_pitching, resolves_flights_with_hundreds_of_turns_in_both_protocols) {
    for (const char* rate : {"300", "-300", "3000"}) {
        for (const names& options : {inertial, body}) {
            const model_row row{"touchdown",
                                {"7.93", "0.15", "0", rate},
                                {{"touchdown_angle", "1"}, {"hip_offset", "0.015"}},
                                options};
            const orbit_answer plain = run_row<model>(row);
            EXPECT_NE(plain.end, outcome::unresolved_event) << rate;
            EXPECT_NE(plain.end, outcome::budget) << rate;
            EXPECT_NE(plain.end, outcome::not_finite) << rate;
        }
    }
}

TEST(slip_pitching, ignores_a_foot_below_the_ground_until_it_has_risen) {
    // foot at -0.2, rising through 0 and falling again: y + w t - t^2/2 - 1 from y = 0.8, w = 1
    const spring_leg::foot_height<double> foot{0.8, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    const auto search = spring_leg::first_touchdown(foot, true);
    ASSERT_TRUE(search.found);
    EXPECT_NEAR(search.time, 1.0 + std::sqrt(0.6), 1e-14);
    // never rises: w = 0.5 lifts it by 0.125 only
    const auto never = spring_leg::first_touchdown(
        spring_leg::foot_height<double>{0.8, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0}, true);
    EXPECT_FALSE(never.found);
    EXPECT_FALSE(never.unresolved);
    // launched from the ground itself: the zero at t = 0 is no touchdown
    const auto launched = spring_leg::first_touchdown(
        spring_leg::foot_height<double>{1.0, 0.7, 0.0, 0.0, 0.0, 0.0, 1.0}, true);
    ASSERT_TRUE(launched.found);
    EXPECT_NEAR(launched.time, 1.4, 1e-15);
}

TEST(slip_pitching, reaches_every_outcome) {
    const names leg{{"touchdown_angle", "1"}};
    const auto end_of = [](const model_row& row) { return run_row<model>(row).end; };
    for (const names& options : {inertial, body}) {
        // moving away from the foot; the hip's own velocity counts: d theta' alone undoes the closing
        EXPECT_EQ(end_of({"touchdown", {"8", "-0.6", "0", "0"}, leg, options}), outcome::no_contact);
        EXPECT_EQ(end_of({"touchdown", {"1", "0.2", "0", "100"}, {{"touchdown_angle", "1"}, {"hip_offset", "0.15"}}, options}),
                  outcome::no_contact);
        EXPECT_EQ(end_of({"touchdown", {"11", "0.79", "0", "0"},
                          {{"touchdown_angle", "0.8"}, {"stiffness", "50"}}, options}),
                  outcome::ground);
        EXPECT_EQ(end_of({"touchdown", {"0", "0.1", "0", "0"}, leg, options}), outcome::invalid_start);
        EXPECT_EQ(end_of({"touchdown", {"8", "nan", "0", "0"}, leg, options}), outcome::invalid_start);
        EXPECT_EQ(end_of({"touchdown", {"8", "0.1", "0", "inf"}, leg, options}), outcome::invalid_start);
    }
    EXPECT_EQ(end_of({"touchdown", {"8", "0.45", "0", "0"},
                      {{"touchdown_angle", "1"}, {"hip_offset", "0"}}, inertial}),
              run_row<slip>({"touchdown", {"8", "0.45"}, leg, {}}).end);
    EXPECT_EQ(end_of({"touchdown", {"10", "0.35", "0", "0"}, leg, inertial}), outcome::stumble);
}

TEST(slip_pitching, reports_the_new_touchdown_of_a_reversal) {
    const model_row row{"touchdown", {"8", "0.98", "0", "0"}, {{"touchdown_angle", "1"}, {"stiffness", "500"}}, {}};
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::reverse);
    EXPECT_EQ(answer.returns, 0u);
    EXPECT_GE(number(answer.columns[1]), pi_double / 2);
}

TEST(slip_pitching, keeps_the_last_touchdown_where_a_stride_fails) {
    const model_row row{"touchdown", {"10", "0.35", "0.01", "0.5"}, {{"touchdown_angle", "1"}}, {}};
    const orbit_answer answer = run_row<model>(row);
    ASSERT_EQ(answer.end, outcome::stumble);
    EXPECT_EQ(number(answer.columns[1]), 0.35);
    EXPECT_EQ(number(answer.columns[3]), 0.5);
}

TEST(slip_pitching, traces_stances_and_flights_that_join) {
    for (const published_gait& gait : {fig5a, fig5a_body, fig5b}) {
        model_row row = gait_row(gait);
        row.returns = 3;
        // 1e-11: the flight is drawn from lift-off, the new speed comes from the energy
        EXPECT_EQ(trace_row<model>(row, 1e-11), 6);
    }
    model_row row{"touchdown", {"8", "0.16", "0", "0"},
                  {{"touchdown_angle", "1"}, {"stiffness", "60"}, {"hip_offset", "0.01"}}, air};
    trace_row<model>(row, 1e-11);
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
        void event(const char*, double, const char*, const char*, const double*, const double*, double) override {}
        double rate = 0.0;
        int count = 0;
    } seen;
    const model_row row = polished(gait_row(fig5b));
    const std::vector<int> options = chosen_options<model>(row);
    const std::vector<std::string> parameters = all_parameters<model>(row);
    orbit_row orbit{.section = 0, .options = options.data()};
    orbit.columns = row.columns;
    orbit.parameters = parameters;
    orbit_table<model>.trace(orbit, seen);
    EXPECT_EQ(seen.count, 8);
}

}  // namespace
}  // namespace hopscotch
