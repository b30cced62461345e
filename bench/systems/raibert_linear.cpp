// Raibert's hopper on a linear spring, from touchdown to touchdown. The flight is lossless and is
// not integrated. Source: models/raibert_hopper.md sections 3, 5; Koditschek and Buehler 1991,
// (10).
#include "bench/yardstick_solvers.hpp"

#include <cmath>

namespace hopscotch::bench {
namespace {

struct raibert_linear_system {
    using state = std::array<double, 2>;  // chi, chi'
    static constexpr int n_guards = 2;
    static constexpr double time_scale = 0.01;
    enum class stance { compression, thrust, extension };

    explicit raibert_linear_system(const double* p)
        : height(p[0]),
          stiffness(p[1]),
          thrust(p[2]),
          thrust_time(p[3]),
          friction(p[4]),
          gravity(p[5]),
          flight_gravity(p[6]),
          leg_factor(1.0 + p[7]),
          rest_height(p[8]),
          thrust_gravity(std::isnan(p[9]) ? p[5] : p[9]) {}

    next_phase start(const double* columns, state& y) {
        y = {height, -columns[0]};
        mode = stance::compression;
        return next_phase::goes_on;
    }
    void rates(double, const double* y, double* rate) const {
        rate[0] = y[1];
        rate[1] = mode == stance::thrust
                      ? thrust - friction * y[1] - thrust_gravity
                      : stiffness * (rest_height - y[0]) - friction * y[1] - gravity;
    }
    void guards(double, const double* y, double* value) const {
        value[0] = mode == stance::compression ? -y[1] : height - y[0];  // bottom; lift-off
        value[1] = mode == stance::extension ? y[1] : 1.0;               // top below lift-off
    }
    bool starts_above(int guard) const { return guard == 0; }
    double stop_time() const { return mode == stance::thrust ? thrust_ends : unbounded_time; }
    next_phase event(int guard, double t, state&) {
        if (guard == 1) return next_phase::ended;
        if (mode == stance::compression) {
            mode = stance::thrust;
            thrust_ends = t + thrust_time;
            return next_phase::goes_on;
        }
        if (guard == 0) return next_phase::returned;
        mode = stance::extension;
        return next_phase::goes_on;
    }
    void result(const state& y, double* columns) {
        columns[0] = y[1] / leg_factor;
        skipped_time = 2.0 * columns[0] / flight_gravity;
    }

    double skipped_time = 0.0;  // of the flight
    double height, stiffness, thrust, thrust_time, friction, gravity, flight_gravity, leg_factor,
        rest_height, thrust_gravity;
    stance mode = stance::compression;
    double thrust_ends = 0.0;
};

const bool known = compare_with<raibert_linear_system>(
    {.name = "raibert_linear",
     .model = "raibert_linear",
     .section = "touchdown",
     .parameters = {{"stiffness", 200.0}, {"rest_height", 0.55}},
     .starts = {{1.0, 6.0}}});

}  // namespace
}  // namespace hopscotch::bench
