// The planar mirror-law juggler as a test sets it up: one return, its Jacobian, states in 50
// digits. What the tests of its page (models/mirror_juggler.md, section 4) share.
#pragma once

#include "tests/models/mirror_juggler.hpp"
#include "tests/models/model_orbits.hpp"
#include "kernels/models/mirror_planar.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace hopscotch::testing_models::planar_juggler {

using namespace mirror_juggler;

inline const orbit_functions& table() { return testing_models::orbits_of<mirror_planar>(); }

/// Parameters as decimals, so that 1/7 and its kin can be given to all digits.
struct juggler {
    int law = solvable;
    int energy = 0;
    double alpha = 0.75, gravity = 9.81;
    std::string kappa0 = print_real(real50(1.0) / real50(7.0));
    double kappa1 = 0.05824959953, target_x = 0.5, target_height = 0.5;
    double kappa10 = 0.1, kappa11 = 0.08, shoulder = 0.0, bar = 100.0, floor = -100.0;

    std::vector<std::string> texts() const {
        return {print_real(alpha),   print_real(gravity),  kappa0,
                print_real(kappa1),  print_real(target_x), print_real(target_height),
                print_real(kappa10), print_real(kappa11),  print_real(shoulder),
                print_real(bar),     print_real(floor)};
    }
    double speed() const { return std::sqrt(2 * gravity * target_height); }  // V
    double flight() const { return speed() / gravity; }                      // T
    double gain(double x, double z, double v) const {
        (void)x;
        const double missing = gravity * (target_height - z) - (energy ? v * v / 2 : 0.0);
        return number(kappa0) + kappa1 * missing;
    }
};

template <class Call>
auto with_row(const juggler& j, const std::vector<std::string>& columns, std::uint32_t returns,
              bool derivative, const Call& call) {
    return with_texts(j.law, j.energy, columns, j.texts(), returns, derivative, call);
}

using state = std::array<double, 3>;

inline orbit_answer run(const juggler& j, const state& x, std::uint32_t returns = 1,
                        bool derivative = false, runner how = table().run_double) {
    return with_row(j, {print_real(x[0]), print_real(x[1]), print_real(x[2])}, returns, derivative,
                    how);
}

inline state end_of(const orbit_answer& a) {
    return {number(a.columns[0]), number(a.columns[1]), number(a.columns[2])};
}

using matrix = std::array<std::array<double, 3>, 3>;

inline matrix jacobian(const juggler& j, const state& x) {
    const orbit_answer a = run(j, x, 1, true);
    matrix m{};
    for (std::size_t i = 0; i < 9; ++i) m[i / 3][i % 3] = number(a.derivative[i]);
    return m;
}

/// The scene of the page's examples: B = 0.5, kappa11 = 0.5 bx*/V, kappa10 = 0.4 kappa11/T.
inline juggler example(int law = solvable) {
    juggler j{.law = law};
    j.kappa1 = 0.5 / (1.75 * 9.81 * 0.5);
    j.kappa11 = 0.5 * 0.5 / j.speed();
    j.kappa10 = 0.4 * j.kappa11 / j.flight();
    return j;
}

}  // namespace hopscotch::testing_models::planar_juggler
