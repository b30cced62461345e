// The pitching spring-mass runner against the runner without pitching, its conserved energy,
// 50-digit runs and differences (models/slip.md, section 6).
#include "tests/models/pitching_gaits.hpp"

#include "kernels/models/slip.hpp"
#include "kernels/models/slip_pitching.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::pitching_gaits;
using model = slip_pitching;

const names air{{"spring", "air"}};

const names air_body{{"spring", "air"}, {"leg_placement", "body"}};

TEST(slip_pitching, is_the_runner_without_pitching_where_the_hip_is_the_centre) {
    for (const names& options : {inertial, air}) {
        const bool is_air = !options.empty();
        for (const char* angle : {"0.1", "0.16", "0.3", "0.6", "0.9"}) {
            const model_row row{"touchdown",
                                {"8", angle, "0.3", "0"},
                                {{"touchdown_angle", "1"},
                                 {"hip_offset", "0"},
                                 {"stiffness", is_air ? "60" : "100"}},
                                options};
            model_row plain{"touchdown", {"8", angle}, {row.set[0], row.set[2]}, options};
            const orbit_answer pitching = run_row<model>(row);
            const orbit_answer without = run_row<slip>(plain);
            ASSERT_EQ(pitching.end, without.end) << angle;
            EXPECT_EQ(pitching.events, without.events);
            EXPECT_NEAR(number(pitching.time), number(without.time),
                        1e-13);  // both some six Taylor steps
            EXPECT_NEAR(number(pitching.columns[0]), 8.0, 1e-14);
            EXPECT_NEAR(number(pitching.columns[1]), number(without.columns[1]), 1e-12);
            EXPECT_EQ(number(pitching.columns[2]), 0.3);
        }
    }
}

TEST(slip_pitching, ignores_pitch_and_turning_where_the_hip_is_the_centre) {
    // inertial: a body that turns evenly changes nothing, and turns through the whole stride
    model_row row{"touchdown",
                  {"8", "0.16", "0.3", "0"},
                  {{"touchdown_angle", "1"}, {"hip_offset", "0"}},
                  {}};
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
                 {"stiffness",
                  print_real(is_air ? 30.0 + 60.0 * unit(random) : 60.0 + 100.0 * unit(random))}},
                options};
    }
};

double energy_of(const model_row& row, const std::vector<std::string>& columns) {
    const double beta = number(row.set[0].second);
    const bool is_body = !row.options.empty() && row.options.back().second == "body";
    const double pitch = number(columns[2]);
    return energy(number(columns[0]), 1.5 * std::sin(is_body ? beta - pitch : beta),
                  number(row.set[1].second), number(row.set[2].second), pitch, number(columns[3]));
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
    EXPECT_NEAR(energy_of(row, answer.columns), energy_of(row, row.columns),
                4e-15 * energy_of(row, row.columns));
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
                EXPECT_NEAR(number(plain.columns[c]), number(truth.columns[c]), 1e-12)
                    << i << " column " << c;
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
                const double expected =
                    to_double((real50(above.columns[i]) - real50(below.columns[i])) / (h + h));
                EXPECT_NEAR(exact.slope[i][j], expected, 1e-11 * (1 + std::abs(expected)))
                    << i << j;
            }
        }
    }
}

TEST(slip_pitching, traces_stances_and_flights_that_join) {
    for (const published_gait& gait : {fig5a, fig5a_body, fig5b}) {
        model_row row = gait_row(gait);
        row.returns = 3;
        // 1e-11: the flight is drawn from lift-off, the new speed comes from the energy
        EXPECT_EQ(trace_row<model>(row, 1e-11), 6);
    }
    model_row row{"touchdown",
                  {"8", "0.16", "0", "0"},
                  {{"touchdown_angle", "1"}, {"stiffness", "60"}, {"hip_offset", "0.01"}},
                  air};
    trace_row<model>(row, 1e-11);
}

}  // namespace
}  // namespace hopscotch
