// Strides of the spring-mass runner from rows as `eval` takes them, by the map's three numbers or
// in the paper's units. What the tests of its page (models/slip.md) share.
#pragma once

#include "kernels/models/slip.hpp"
#include "tests/models/orbit_runner.hpp"

#include <gtest/gtest.h>

namespace hopscotch::testing_models::slip_rows {

using names = std::vector<std::pair<std::string, std::string>>;

constexpr double pi_double = 3.14159265358979323846;

inline const names gravity_off{{"stance_gravity", "off"}};

inline const names air_off{{"spring", "air"}, {"stance_gravity", "off"}};

inline const names linear_on{};

inline const names air_on{{"spring", "air"}};

/// A start given by the three numbers of the map: leg length, mass and speed 1.
inline model_row numbers_row(double beta, double stiffness, double gravity, double angle,
                             names options) {
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
inline model_row paper_row(double leg, double stiffness, double beta, double speed, double angle,
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

inline stride run(const model_row& row, arithmetic kind = arithmetic::plain) {
    const orbit_answer answer = run_row<slip>(row, kind);
    return {answer.end, number(answer.columns[1]), number(answer.extras[0]), number(answer.time)};
}

}  // namespace hopscotch::testing_models::slip_rows
