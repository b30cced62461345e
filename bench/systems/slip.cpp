// The spring-mass runner with gravity in stance and a linear spring, from touchdown to touchdown.
// The flight is a parabola and is not integrated. Source: models/slip.md sections 2, 5.
#include "bench/yardstick_solvers.hpp"

#include <cmath>

namespace hopscotch::bench {
namespace {

struct slip_system {
    using state = std::array<double, 4>;  // x, y about the foothold, and their rates
    static constexpr int n_guards = 2;
    static constexpr double time_scale = 0.01;

    explicit slip_system(const double* p)
        : leg(p[1]), stiffness_per_mass(p[2] / p[0]), gravity(p[3]), touchdown_angle(p[4]) {}

    next_phase start(const double* columns, state& y) {
        const double v = columns[0];
        const double delta = columns[1];
        y = {-leg * std::cos(touchdown_angle), leg * std::sin(touchdown_angle), v * std::cos(delta),
             -v * std::sin(delta)};
        return std::cos(touchdown_angle - delta) > 0.0 ? next_phase::goes_on : next_phase::ended;
    }
    void rates(double, const double* y, double* rate) const {
        const double pull = stiffness_per_mass * (leg / std::hypot(y[0], y[1]) - 1.0);
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = pull * y[0];
        rate[3] = pull * y[1] - gravity;
    }
    void guards(double, const double* y, double* value) const {
        value[0] = leg - std::hypot(y[0], y[1]);  // lift-off
        value[1] = y[1];                          // the body reaches the ground
    }
    bool starts_above(int) const { return true; }
    double stop_time() const { return unbounded_time; }
    next_phase event(int guard, double, state& y) {
        if (guard == 1) return next_phase::ended;
        const double rise = y[1] - leg * std::sin(touchdown_angle);
        const double square = y[3] * y[3] + 2.0 * gravity * rise;
        if (square < 0.0 || (rise < 0.0 && y[3] <= 0.0)) return next_phase::ended;
        skipped_time = (y[3] + std::sqrt(square)) / gravity;
        y[3] = -std::sqrt(square);
        return y[2] > 0.0 ? next_phase::returned : next_phase::ended;
    }
    void result(const state& y, double* columns) const {
        columns[0] = std::hypot(y[2], y[3]);
        columns[1] = std::atan2(-y[3], y[2]);
    }

    double leg, stiffness_per_mass, gravity, touchdown_angle;
    double skipped_time = 0.0;  // of the flight
};

const bool known = compare_with<slip_system>(
    {.name = "slip, gravity in stance",
     .model = "slip",
     .section = "touchdown",
     .parameters = {{"leg_length", 1.5}, {"stiffness", 100.0}, {"touchdown_angle", 1.0}},
     .starts = {{8.0, 12.0}, {0.05, 0.6}},
     .target_error = 1e-9,
     .is_integrated = true,
     .invariant = [](const double* columns, const double*) { return columns[0]; }});

}  // namespace
}  // namespace hopscotch::bench
