// Raibert's hopper, rows and hard cases of its page that concern single arcs, curvature of the map
// and loss of digits (models/raibert_hopper.md, sections 8 and 9).
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

using namespace testing_models;

named_map pneumatic(const named_map::values& numbers) {
    return {"raibert_pneumatic", "touchdown", numbers};  // defaults are the settings of Fig. 12
}
named_map ricker(double gain, double energy) {
    return {"raibert_pneumatic_simple", "energy", {{"gain", gain}, {"energy", energy}}};
}

struct bottom_watch final : orbit_observer {
    double compression = 0.0, bottom = 0.0;
    void phase(const char* mode, double, double duration, const sampler&) override {
        if (std::string_view(mode) == "compression") compression += duration;
    }
    void event(const char* name, double, const char*, const char*, const double* before,
               const double*, double) override {
        if (std::string_view(name) == "bottom") bottom = before[0];
    }
};
bottom_watch watch(const named_map& m) {
    bottom_watch seen;
    m.trace(seen);
    return seen;
}

TEST(raibert_hard_cases, schwarzian_of_the_ricker_map_is_that_of_lemma_2) {
    // section 9, row "S(f) < 0": S(f) = -((E - 2)^2 + 2) / (2 (E - 1)^2), by differences in 50
    // digits; h is a power of two, so that all starts are exact: error h^2 = 4e-12 times the fifth
    // derivative
    const double h = 0x1p-19;
    for (const double energy : {0.25, 0.5, 1.75, 3.0}) {
        const auto f = [&](int k) {
            return real50(ricker(6.0, energy + k * h).answer(1, digits::fifty).columns[0]);
        };
        const real50 slope = (f(1) - f(-1)) / (2 * h);
        const real50 bend = (f(1) - f(0) * 2.0 + f(-1)) / (h * h);
        const real50 third = (f(2) - f(1) * 2.0 + f(-1) * 2.0 - f(-2)) / (2 * h * h * h);
        const real50 ratio = bend / slope;
        const double schwarzian = to_double(third / slope - ratio * ratio * 1.5);
        const double lemma = -((energy - 2) * (energy - 2) + 2) / (2 * (energy - 1) * (energy - 1));
        EXPECT_NEAR(schwarzian / lemma, 1.0, 1e-8) << energy;
    }
}

TEST(raibert_hard_cases, cascade_is_5_2e_5_from_its_end_after_eight_doublings) {
    // case 5: alpha_inf - alpha_9, alpha_inf = 14.76661448
    const double gain = 14.76661448 - 5.2e-5;
    const named_map near = periodic_point(ricker(gain - 1e-6, 1.0).after(400000), 256);
    const double flip = point_with_multiplier(near, "gain", -1.0, 256).value("gain");
    EXPECT_NEAR(14.76661448 - flip, 5.2e-5, 6e-7);
}

TEST(raibert_hard_cases, a_double_orbit_leaves_the_exact_one_after_about_36_over_lambda_hops) {
    // case 15: ln 2^52 = 36. Where the exponent is some 0.3, that is about 120 hops
    const double gain = 18.0;
    named_map m = ricker(gain, 1.0).after(50);
    const double start = m.start[0];
    double sum = 0.0;
    const int n = 4000;
    for (int i = 0; i < n; ++i) {
        sum += std::log(std::abs(m.image().jacobian(0, 0)));
        m = m.after(1);
    }
    const double exponent = sum / n;
    EXPECT_GT(exponent, 0.1);
    std::uint32_t hops = 0;
    double apart = 0.0;
    while (apart < 0.5 && hops < 2000) {
        ++hops;
        const named_map from = ricker(gain, start);
        apart = std::abs(std::stod(from.answer(hops).columns[0]) -
                         std::stod(from.answer(hops, digits::fifty).columns[0]));
    }
    EXPECT_GT(hops, 0.6 * 36 / exponent);
    EXPECT_LT(hops, 1.6 * 36 / exponent);
}

TEST(raibert_hard_cases, compression_of_a_tiny_impact_lasts_its_speed_over_the_force) {
    // case 10: v = 2^-15, t = v / (eta1 / chi_l - g) to leading order; the next order is smaller by
    // v
    const double speed = 0x1p-15;
    for (const double friction : {0.0, 2.33}) {
        const double time =
            watch(pneumatic({{"friction", friction}, {"touchdown_speed", speed}})).compression;
        EXPECT_NEAR(time / (speed / (5.81 / 0.5 - 10.0)), 1.0, 100 * speed) << friction;
    }
}

TEST(raibert_hard_cases, legs_are_pressed_to_what_no_double_holds) {
    // case 1: v = 100, ln chi_b = ln chi_l - v^2 / (2 eta1) is about -861: the bottom underflows to
    // 0, the thrust of finite time lifts the body as if from there
    const named_map deep = pneumatic({{"stiffness", 5.8125},
                                      {"friction", 0.0},
                                      {"stance_gravity", 0.0},
                                      {"touchdown_speed", 100.0}});
    EXPECT_NEAR(std::log(0.5) - 1e4 / (2 * 5.8125), -861.0, 0.2);
    const orbit_answer plain = deep.answer();
    const orbit_answer truth = deep.answer(1, digits::fifty);
    ASSERT_EQ(plain.end, outcome::ok);
    ASSERT_EQ(truth.end, outcome::ok);
    EXPECT_NEAR(std::stod(plain.columns[0]) / std::stod(truth.columns[0]), 1.0, 1e-14);
    // chi_et = A delta^2 / 2 and v_et = A delta, with nothing else left of the impact
    const double a = 41.86, delta = 0.01;
    const double chi = 0.5 * a * delta * delta;
    const double lift = std::sqrt(a * delta * a * delta + 2 * a * chi * std::log(0.5 / chi));
    EXPECT_NEAR(std::stod(plain.columns[0]), lift, 1e-13);
}

TEST(raibert_hard_cases, a_creeping_leg_starts_from_a_bottom_below_1e_13) {
    // case 13: gamma = 2.25, g = delta = 0, v = 20; "chi_b ~ 2.5e-14, eta2 ~ 1e-12"
    const named_map m = pneumatic({{"friction", 2.25},
                                   {"stance_gravity", 0.0},
                                   {"thrust_time", 0.0},
                                   {"touchdown_speed", 20.0}});
    EXPECT_EQ(m.answer().end, outcome::creep);
    // w = v^2 / 2 over x = ln chi: w' = eta + gamma sqrt(2 w) e^x, Runge-Kutta until w = 0; its
    // last step has a root in it, steps of 1e-3 are good to some 1e-6
    const auto slope = [](double x, double w) {
        return 5.81 + 2.25 * std::sqrt(std::max(2 * w, 0.0)) * std::exp(x);
    };
    double x = std::log(0.5), w = 200.0;
    const double h = 1e-3;
    while (true) {
        const double a = slope(x, w), b = slope(x - h / 2, w - h / 2 * a);
        const double c = slope(x - h / 2, w - h / 2 * b), d = slope(x - h, w - h * c);
        const double next = w - h / 6 * (a + 2 * b + 2 * c + d);
        if (next <= 0) break;
        w = next;
        x -= h;
    }
    const double expected = std::exp(x - w / 5.81);
    EXPECT_NEAR(expected, 2.5e-14, 0.3e-14);  // the page's value is rounded
    EXPECT_NEAR(41.86 * expected, 1e-12, 0.1e-12);
    EXPECT_NEAR(watch(m).bottom / expected, 1.0, 1e-5);
}

}  // namespace
}  // namespace hopscotch
