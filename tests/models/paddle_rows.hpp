// A ball on a paddle as a test sets it up, by decimals. What the tests of its page
// (models/paddle_juggler.md) share.
#pragma once

#include "kernels/models/paddle_juggler.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace hopscotch::testing_models::paddle_rows {

using model = paddle_juggler;

constexpr double pi_double = std::numbers::pi;

struct paddle {
    std::string amplitude, restitution;
    orbit_answer from(const std::string& phase, const std::string& speed, std::uint32_t returns = 1,
                      arithmetic kind = arithmetic::plain, bool derivative = false) const {
        return run_row<model>({"impact",
                               {phase, speed},
                               {{"amplitude", amplitude}, {"restitution", restitution}},
                               {},
                               returns,
                               derivative},
                              kind);
    }
    /// From the release after sustained contact.
    orbit_answer released(std::uint32_t returns, arithmetic kind = arithmetic::plain) const {
        return from(print_real(std::asin(1.0 / number(amplitude))), "0", returns, kind);
    }
};

inline paddle with(double amplitude, double restitution) {
    return {print_real(amplitude), print_real(restitution)};
}

inline double phase_of(const orbit_answer& answer) { return number(answer.columns[0]); }

inline double speed_of(const orbit_answer& answer) { return number(answer.columns[1]); }

inline double sticks_of(const orbit_answer& answer) { return number(answer.extras[0]); }

}  // namespace hopscotch::testing_models::paddle_rows
