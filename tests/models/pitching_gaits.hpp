// Gaits of the pitching spring-mass runner as the page prints them (models/slip.md, Fig. 5 rows of
// section 11), and its linearised return map. What the tests of that runner share.
#pragma once

#include "kernels/models/slip.hpp"
#include "kernels/models/slip_pitching.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hopscotch::testing_models::pitching_gaits {

using names = std::vector<std::pair<std::string, std::string>>;
using model = slip_pitching;

constexpr double weight = 9.81;

inline const names inertial{};

inline const names body{{"leg_placement", "body"}};

/// A gait of Fig. 5 (k = 100, m = 1, eta0 = 1.5, beta = 1) as the page prints it.
struct published_gait {
    const char* hip;
    const char* inertia;
    const char* speed;
    names options;
    double angle, pitch, pitch_rate;
    std::array<double, 3>
        tolerance;  // one unit of the page's last digits (one of them is rounded up)
};

inline const published_gait fig5a{"0.015",  "0.0225",   "7.93",     inertial,
                                  0.146967, -0.0103113, -0.0871074, {1e-6, 1e-7, 1e-7}};

inline const published_gait fig5a_body{"0.015",  "0.0225",   "7.93",     body,
                                       0.129579, -0.0087209, -0.0834911, {1e-6, 1e-7, 1e-7}};

inline const published_gait fig5b{"0.15",   "0.000225", "8.26",   inertial,
                                  0.124398, -0.318410,  -3.04778, {1e-6, 1e-6, 1e-5}};

inline model_row gait_row(const published_gait& gait) {
    return {
        "touchdown",
        {gait.speed, print_real(gait.angle), print_real(gait.pitch), print_real(gait.pitch_rate)},
        {{"touchdown_angle", "1"}, {"hip_offset", gait.hip}, {"inertia", gait.inertia}},
        gait.options};
}

inline double energy(double speed, double hip_height, double hip, double inertia, double pitch,
                     double rate) {
    return 0.5 * speed * speed + weight * (hip_height - hip * std::cos(pitch)) +
           0.5 * inertia * rate * rate;
}

using matrix = std::array<std::array<double, 4>, 4>;

struct linearised {
    std::array<double, 4> state;
    matrix slope;
};

inline linearised linearise(model_row row) {
    row.derivative = true;
    const orbit_answer answer = run_row<model>(row);
    EXPECT_EQ(answer.end, outcome::ok);
    linearised result{};
    for (std::size_t i = 0; i < 4; ++i) {
        result.state[i] = number(answer.columns[i]);
        for (std::size_t j = 0; j < 4; ++j)
            result.slope[i][j] = number(answer.derivative[4 * i + j]);
    }
    return result;
}

}  // namespace hopscotch::testing_models::pitching_gaits
