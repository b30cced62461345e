// The spring-mass runner's return map by name: runners of the figures and by the map's three
// numbers, the exponent of an orbit, states of a stance. What the tests of its folds, gaps and
// invariants share.
#pragma once

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch::testing_models::slip_map {

using choices = named_map::choices;

inline const choices linear_off{{"stance_gravity", "off"}};

inline const choices air_off{{"spring", "air"}, {"stance_gravity", "off"}};

inline const choices linear_on{};

inline const choices air_on{{"spring", "air"}};

inline named_map runner(double leg, double stiffness, double beta, double speed, double angle,
                        const choices& options) {
    return named_map("slip", "touchdown",
                     {{"leg_length", leg},
                      {"stiffness", stiffness},
                      {"touchdown_angle", beta},
                      {"speed", speed},
                      {"angle", angle}},
                     options)
        .in({"angle"});
}

/// In the three numbers of the map: leg, mass and speed are 1.
inline named_map by_numbers(double beta, double stiffness, double gravity, double angle,
                            const choices& options) {
    return runner(1.0, stiffness, beta, 1.0, angle, options).with("gravity", gravity);
}

inline double angle_of(const named_map& m) { return m.start[1]; }

inline named_map figure_12(double speed, double angle = 0.3) {
    return runner(0.173, 0.01839, 0.961, speed, angle, air_off);
}

inline named_map figure_9(double speed, double angle = 0.3) {
    return runner(1.5, 10.0, M_PI / 4, speed, angle, linear_off);
}

}  // namespace hopscotch::testing_models::slip_map
