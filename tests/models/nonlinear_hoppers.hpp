// Random hoppers with nonlinear springs and gravity, for the tests of that variant.
#pragma once

#include "analysis/truth/decimal.hpp"
#include "analysis/truth/real50.hpp"
#include "tests/models/nonlinear_rows.hpp"
#include "tests/models/passive_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch::testing_models::nonlinear_hoppers {

using nonlinear_rows::terms;

class random_hoppers {
public:
    explicit random_hoppers(unsigned seed) : random_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<>(low, high)(random_);
    }
    /// Mild terms: the force rises everywhere (q^2 < 3 c).
    terms mild() {
        terms of;
        of.mass_ratio = std::pow(10.0, between(-1.0, 1.0));
        of.cubic = between(0.0, 0.03);
        of.quadratic = between(-1.0, 1.0) * std::sqrt(of.cubic);
        of.gradient = between(-0.01, 0.03);
        return of;
    }

private:
    std::mt19937_64 random_;
};

}  // namespace hopscotch::testing_models::nonlinear_hoppers
