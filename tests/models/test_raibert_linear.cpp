// Raibert's hopper on the linear spring: Figs. 8 to 10, the simplified model as a limit, an
// integration of the equations, 50 digits (models/raibert_hopper.md, sections 3 and 9).
#include "tests/models/linear_hopper.hpp"

#include "kernels/models/raibert_linear.hpp"
#include "kernels/models/raibert_linear_simple.hpp"
#include "tests/models/orbit_runner.hpp"
#include "tests/models/trace_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace hopscotch::testing_models {
namespace {

using namespace testing_models::linear_hopper;

const hopper figure_10{.rest = 0.215};

TEST(RaibertLinear, figure_8_hops_between_its_two_starts) {
    for (const char* start : {"0.91", "0.98"}) {
        EXPECT_NEAR(state_of(figure_8.from("apex", start, 300)), 0.95572, 1e-5);
    }
    EXPECT_NEAR(state_of(figure_8.from("bottom", "0.3", 300)), 0.29908, 1e-5);
    // without preload the same numbers give an apex of 0.672
    hopper same = figure_8;
    same.preloaded = false;
    EXPECT_NEAR(state_of(same.from("apex", "0.91", 300)), 0.672, 1e-3);
}

TEST(RaibertLinear, figure_10_hops_between_its_two_starts) {
    for (const char* start : {"-0.16", "-0.18"}) {
        EXPECT_NEAR(state_of(figure_10.from("bottom", start, 300)), -0.167585, 1e-6);
    }
    EXPECT_NEAR(state_of(figure_10.from("apex", "0.1", 300)), 0.106024, 1e-6);
    // a thrust not reduced by gravity would give -0.220
    hopper net = figure_10;
    net.thrust_gravity = 0.0;
    EXPECT_NEAR(state_of(net.from("bottom", "-0.2", 300)), -0.220, 1e-3);
}

TEST(RaibertLinear, figure_9_as_printed_reaches_an_apex_of_0_718) {
    const hopper printed{.gamma = 0.58, .g = 5.0, .rest = 0.1, .thrust_gravity = 5.0};
    const auto apex = [](const hopper& h) {
        return run_row<model>({"apex",
                               {"0.44"},
                               {{"liftoff_height", "0"},
                                {"stiffness", "46.5"},
                                {"thrust", "41.86"},
                                {"thrust_time", "0.05"},
                                {"friction", "0.58"},
                                {"stance_gravity", "5"},
                                {"flight_gravity", "5"},
                                {"rest_height", print_real(h.rest)}},
                               {},
                               2000});
    };
    EXPECT_NEAR(state_of(apex(printed)), 0.718, 1e-3);
    EXPECT_NEAR(state_of(apex({.rest = 5.0 / 46.5})), 0.730, 1e-3);
}

TEST(RaibertLinear, reduces_to_the_simplified_model) {
    // chi_l = 0, chi_0 = g / eta, no gravity in thrust: eta = w^2 (1 + b^2), gamma = 2 w b
    const double w = 10.0;
    const double b = 0.25;
    const hopper h{.eta = w * w * (1.0 + b * b),
                   .tau = 10.0,
                   .delta = 0.1,
                   .gamma = 2.0 * w * b,
                   .rest = 10.0 / (w * w * (1.0 + b * b)),
                   .thrust_gravity = 0.0};
    for (const char* start : {"0.2", "0.55", "0.7", "2"}) {
        const auto full = h.from("touchdown", start, 3);
        const auto simple = run_row<raibert_linear_simple>(
            {"touchdown",
             {start},
             {{"frequency", "10"}, {"damping", "0.25"}, {"thrust", "10"}, {"thrust_time", "0.1"}},
             {},
             3});
        EXPECT_NEAR(state_of(full), state_of(simple), 2e-15)
            << start;  // eta chi_0 - g rounds to 1e-15
        EXPECT_NEAR(number(full.time), number(simple.time), 4e-15) << start;
        EXPECT_EQ(cut_of(full), cut_of(simple));
        EXPECT_EQ(full.events, simple.events);
    }
}

/// One hop from touchdown by Runge-Kutta 4; returns the next touchdown speed, or -1 without
/// lift-off.
struct integrated {
    double speed = -1.0, time = 0.0;
};

integrated integrate(const hopper& h, double touchdown) {
    const double dt = 1e-5;
    double x = h.height;
    double v = -touchdown;
    double t = 0.0;
    double eta = h.eta;
    double since_bottom = -1.0;
    bool thrusts = false;
    const auto advance = [&](double step) {
        const auto force = [&](double position, double velocity) {
            return thrusts ? h.tau - h.thrust_gravity - h.gamma * velocity
                           : eta * (h.rest - position) - h.gamma * velocity - h.g;
        };
        const double k1 = force(x, v);
        const double k2 = force(x + 0.5 * step * v, v + 0.5 * step * k1);
        const double k3 = force(x + 0.5 * step * v + 0.25 * step * step * k1, v + 0.5 * step * k2);
        const double k4 = force(x + step * v + 0.5 * step * step * k2, v + step * k3);
        x += step * v + step * step / 6.0 * (k1 + k2 + k3);
        v += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        t += step;
    };
    while (v < 0.0 && t < 5.0) advance(dt);
    for (int i = 0; i < 3; ++i) advance(-v / (eta * (h.rest - x) - h.gamma * v - h.g));  // Newton
    v = 0.0;
    thrusts = true;
    while (thrusts && h.delta > 0.0) {
        const double left = h.delta - (since_bottom < 0.0 ? 0.0 : since_bottom);
        const double step = std::min(dt, left);
        advance(step);
        since_bottom = (since_bottom < 0.0 ? 0.0 : since_bottom) + step;
        if (x > h.height) {
            for (int i = 0; i < 3; ++i) advance(-(x - h.height) / v);
            return {v / (1.0 + h.leg), t};
        }
        if (since_bottom >= h.delta) thrusts = false;
    }
    thrusts = false;
    if (h.preloaded) eta = h.tau / (h.rest - x);
    while (t < 20.0) {
        advance(dt);
        if (x > h.height) break;
        if (v < 0.0) return {-1.0, t};
    }
    for (int i = 0; i < 3; ++i) advance(-(x - h.height) / v);
    return {v / (1.0 + h.leg), t};
}

TEST(RaibertLinear, hops_agree_with_an_integration_of_the_equations) {
    const std::vector<hopper> hoppers{
        figure_8,
        figure_10,
        {.delta = 0.2, .gamma = 0.0, .leg = 0.2},
        {.height = 0.5, .eta = 120.0, .delta = 0.0, .gamma = 1.0, .rest = 0.55, .preloaded = true},
        {.height = 0.5,
         .eta = 46.5,
         .tau = 80.0,
         .delta = 0.1,
         .gamma = 15.0,
         .rest = 1.2},  // overdamped
        {.height = 0.5,
         .eta = 64.0,
         .tau = 90.0,
         .delta = 0.05,
         .gamma = 16.0,
         .rest = 1.2}};  // critical
    for (const hopper& h : hoppers) {
        for (const double speed : {0.4, 1.5, 4.0}) {
            const auto answer = h.from("touchdown", print_real(speed));
            const integrated want = integrate(h, speed);
            if (want.speed < 0.0) {
                EXPECT_EQ(answer.end, outcome::no_liftoff);
                continue;
            }
            ASSERT_EQ(answer.end, outcome::ok) << h.gamma << " " << speed;
            // Runge-Kutta 4 with steps of 1e-5: rounding of 1e5 steps remains
            EXPECT_NEAR(state_of(answer), want.speed, 1e-11) << h.gamma << " " << speed;
            EXPECT_NEAR(number(answer.time), want.time + 2.0 * want.speed / 10.0, 1e-10);
        }
    }
}

TEST(RaibertLinear, sections_show_the_same_orbit) {
    const hopper& h = figure_8;
    const auto touchdown = h.from("touchdown", "2.5", 4, arithmetic::mp50);
    const double v = state_of(touchdown);
    const auto apex = h.from("apex", print_real(0.5 + 2.5 * 2.5 / 20.0), 4);
    EXPECT_NEAR(state_of(apex), 0.5 + v * v / 20.0, 1e-14);
    // the apex section counts half a flight of each end
    EXPECT_NEAR(number(apex.time), number(touchdown.time) + 0.25 - v / 10.0, 1e-13);
    const auto next = h.from("touchdown", "2.5", 1, arithmetic::mp50);
    const auto low = h.from("bottom", "0.28", 1);
    EXPECT_LT(state_of(low), 0.5);
    EXPECT_EQ(low.events, 4u);
    EXPECT_EQ(next.events, 4u);
}

TEST(RaibertLinear, agrees_with_50_digits) {
    std::mt19937_64 bits(12);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int compared = 0;
    for (int i = 0; i < 240; ++i) {
        hopper h{.height = 0.5,
                 .eta = 20.0 + 80.0 * uniform(bits),
                 .tau = 15.0 + 60.0 * uniform(bits),
                 .delta = 0.1 * uniform(bits),
                 .gamma = 25.0 * uniform(bits) * uniform(bits),
                 .leg = 0.3 * uniform(bits),
                 .rest = 0.55 + 0.8 * uniform(bits)};
        h.preloaded = i % 2 == 1;
        const std::string start = print_real(5.0 * uniform(bits));
        const auto plain = h.from("touchdown", start);
        const auto wide = h.from("touchdown", start, 1, arithmetic::wide);
        const auto truth = h.from("touchdown", start, 1, arithmetic::mp50);
        ASSERT_EQ(plain.end, truth.end) << i;
        EXPECT_EQ(cut_of(plain), cut_of(truth));
        if (truth.end != outcome::ok) continue;
        ++compared;
        const double want = state_of(truth);
        // a lift-off slower than the stance amplifies rounding by (stance speed / lift-off speed)^2
        const double worst = 1.0 + std::pow((number(start) + h.tau * 0.3) / want, 2.0);
        EXPECT_NEAR(state_of(plain) / want, 1.0, 1e-14 * worst) << i;
        EXPECT_NEAR(number(plain.time) / number(truth.time), 1.0, 1e-14 * worst) << i;
        const real50 error =
            parse_real<real50>(wide.columns[0]) / parse_real<real50>(truth.columns[0]) -
            real50(1.0);
        EXPECT_LT(to_double(abs(error)), 1e-27 * worst) << i;
    }
    EXPECT_GT(compared, 100);
}

TEST(RaibertLinear, derivatives_agree_with_50_digit_differences) {
    const real50 h(0x1p-70);
    const std::vector<hopper> hoppers{
        figure_8,
        figure_10,
        {.delta = 0.4, .gamma = 0.0},
        {.height = 0.5, .tau = 80.0, .delta = 0.1, .gamma = 15.0, .rest = 1.2}};
    for (const hopper& hop : hoppers) {
        for (const char* section : {"touchdown", "apex"}) {
            const double start = 1.25;
            const auto exact = hop.from(section, print_real(start), 2, arithmetic::mp50, true);
            const auto plain = hop.from(section, print_real(start), 2, arithmetic::plain, true);
            if (exact.end != outcome::ok) continue;
            const auto high =
                hop.from(section, to_string(real50(start) + h, 64), 2, arithmetic::mp50);
            const auto low =
                hop.from(section, to_string(real50(start) - h, 64), 2, arithmetic::mp50);
            const double slope = to_double(
                (parse_real<real50>(high.columns[0]) - parse_real<real50>(low.columns[0])) /
                (h + h));
            EXPECT_NEAR(number(exact.derivative[0]), slope, 1e-13 * (1.0 + std::abs(slope)))
                << section;
            EXPECT_NEAR(number(plain.derivative[0]), slope, 1e-11 * (1.0 + std::abs(slope)))
                << section;
        }
    }
}

}  // namespace
}  // namespace hopscotch::testing_models
