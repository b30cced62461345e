// The ball on a sinusoidal paddle, from impact to impact, in the ball's height over the paddle.
// Source: models/paddle_juggler.md sections 1-3.
#include "bench/yardstick_solvers.hpp"

#include <cmath>
#include <numbers>

namespace hopscotch::bench {
namespace {

struct paddle_juggler_system {
    using state = std::array<double, 2>;  // height over the paddle and its rate
    static constexpr int n_guards = 1;
    static constexpr double time_scale = 0.1;

    explicit paddle_juggler_system(const double* parameters)
        : amplitude(parameters[0]), restitution(parameters[1]) {}

    next_phase start(const double* columns, state& y) {
        phase = columns[0];
        y = {0.0, columns[1]};
        return next_phase::goes_on;
    }
    void rates(double t, const double* y, double* rate) const {
        rate[0] = y[1];
        rate[1] = -1.0 + amplitude * std::sin(phase + t);
    }
    void guards(double, const double* y, double* value) const { value[0] = y[0]; }
    bool starts_above(int) const { return true; }
    double stop_time() const { return unbounded_time; }
    next_phase event(int, double t, state& y) {
        phase = std::fmod(phase + t, 2.0 * std::numbers::pi);
        y = {0.0, -restitution * y[1]};
        return next_phase::returned;
    }
    void result(const state& y, double* columns) const {
        columns[0] = phase;
        columns[1] = y[1];
    }

    double amplitude, restitution;
    double phase = 0.0;
};

const bool known =
    compare_with<paddle_juggler_system>({.name = "paddle_juggler",
                                         .model = "paddle_juggler",
                                         .section = "impact",
                                         .parameters = {{"amplitude", 4.0}, {"restitution", 0.8}},
                                         .starts = {{0.0, 2.0 * std::numbers::pi}, {2.0, 12.0}}});

}  // namespace
}  // namespace hopscotch::bench
