// Paddle and line jugglers by name, for the tests of their regimes.
#pragma once

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hopscotch::testing_models::juggler_maps {

inline named_map paddle(double amplitude, double restitution, double phase, double speed) {
    return {"paddle_juggler",
            "impact",
            {{"amplitude", amplitude},
             {"restitution", restitution},
             {"phase", phase},
             {"relative_velocity", speed}}};
}

inline double sticks_of(const orbit_answer& a) { return std::stod(a.extras[0]); }

/// PERIODIC(q, p): p impacts in q forcing periods without sticking; p = 0 where none up to 16.
struct cycle {
    int q = 0, p = 0;
    auto operator<=>(const cycle&) const = default;
};

}  // namespace hopscotch::testing_models::juggler_maps
