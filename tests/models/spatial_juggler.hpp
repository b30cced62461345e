// The spatial mirror-law juggler as a test sets it up. What the tests of its page
// (models/mirror_juggler.md, section 5) share.
#pragma once

#include "tests/models/mirror_juggler.hpp"
#include "tests/models/model_orbits.hpp"
#include "kernels/models/mirror_planar.hpp"
#include "kernels/models/mirror_spatial.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace hopscotch::testing_models::spatial_juggler {

using namespace mirror_juggler;

inline const orbit_functions& table() { return testing_models::orbits_of<mirror_spatial>(); }

using state = std::array<double, 5>;

struct juggler {
    int law = solvable;
    int energy = 0;
    double alpha = 0.75, gravity = 9.81, kappa0 = 1.0 / 7.0, kappa1 = 0.5 / (1.75 * 9.81 * 0.5);
    double radius = 0.5, azimuth = 0.0, height = 0.5, kr0 = 0.1, kr1 = 0.08, kl0 = 0.1, kl1 = 0.08;
    double shoulder = 0.01, bar = 100.0, floor = -100.0;

    std::vector<double> numbers() const {
        return {alpha, gravity, kappa0, kappa1, radius,   azimuth, height,
                kr0,   kr1,     kl0,    kl1,    shoulder, bar,     floor};
    }
    double gain(const state& x) const {
        const double kinetic = energy ? (x[3] * x[3] + x[4] * x[4]) / 2 : 0.0;
        return kappa0 + kappa1 * (gravity * (height - x[2]) - kinetic);
    }
    double speed() const { return std::sqrt(2 * gravity * height); }
    double flight() const { return speed() / gravity; }
};

template <class Numbers>
std::vector<std::string> written(const Numbers& numbers) {
    std::vector<std::string> texts;
    for (double x : numbers) texts.push_back(print_real(x));
    return texts;
}

inline orbit_answer run_texts(const juggler& j, const std::vector<std::string>& columns,
                              std::uint32_t returns, bool derivative, runner how) {
    return with_texts(j.law, j.energy, columns, written(j.numbers()), returns, derivative, how);
}

inline orbit_answer run(const juggler& j, const state& x, std::uint32_t returns = 1,
                        bool derivative = false, runner how = table().run_double) {
    return run_texts(j, written(x), returns, derivative, how);
}

}  // namespace hopscotch::testing_models::spatial_juggler
