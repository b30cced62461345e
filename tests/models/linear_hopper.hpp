// Raibert's hopper on the linear spring as a test sets it up, with the settings of Figs. 8 and 10.
#pragma once

#include "kernels/models/raibert_linear.hpp"
#include "kernels/models/raibert_linear_simple.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hopscotch::testing_models::linear_hopper {

using model = raibert_linear;

struct hopper {
    double height = 0.0, eta = 46.5, tau = 41.86, delta = 0.05, gamma = 2.33, g = 10.0, leg = 0.0,
           rest = 10.0 / 46.5;
    double thrust_gravity = 10.0;
    bool preloaded = false;

    orbit_answer from(const std::string& section, const std::string& start,
                      std::uint32_t returns = 1, arithmetic kind = arithmetic::plain,
                      bool derivative = false) const {
        return run_row<model>({section,
                               {start},
                               {{"liftoff_height", print_real(height)},
                                {"stiffness", print_real(eta)},
                                {"thrust", print_real(tau)},
                                {"thrust_time", print_real(delta)},
                                {"friction", print_real(gamma)},
                                {"stance_gravity", print_real(g)},
                                {"leg_mass_ratio", print_real(leg)},
                                {"rest_height", print_real(rest)},
                                {"thrust_gravity", print_real(thrust_gravity)}},
                               {{"spring_after_thrust", preloaded ? "preloaded" : "same"}},
                               returns,
                               derivative},
                              kind);
    }
};

inline double state_of(const orbit_answer& answer) { return number(answer.columns[0]); }

inline double cut_of(const orbit_answer& answer) { return number(answer.extras[0]); }

inline const hopper figure_8{.height = 0.5, .rest = 1.0, .preloaded = true};

}  // namespace hopscotch::testing_models::linear_hopper
