// Raibert's hopper on an air spring with friction, from touchdown to touchdown. Thrust and flight
// are closed forms and are not integrated. Source: models/raibert_hopper.md section 3; Koditschek
// and Buehler 1991, (7), (8).
#include "bench/yardstick_solvers.hpp"

#include <cmath>

namespace hopscotch::bench {
namespace {

struct raibert_pneumatic_system {
    using state = std::array<double, 2>;  // chi, chi'
    static constexpr int n_guards = 2;
    static constexpr double time_scale = 0.01;

    explicit raibert_pneumatic_system(const double* p)
        : height(p[0]),
          stiffness(p[1]),
          thrust(p[2]),
          thrust_time(p[3]),
          friction(p[4]),
          gravity(p[5]),
          flight_gravity(p[6]),
          leg_factor(1.0 + p[7]) {}

    next_phase start(const double* columns, state& y) {
        y = {height, -columns[0]};
        is_extending = false;
        spring = stiffness;
        return next_phase::goes_on;
    }
    void rates(double, const double* y, double* rate) const {
        rate[0] = y[1];
        rate[1] = spring / y[0] - friction * y[1] - gravity;
    }
    void guards(double, const double* y, double* value) const {
        value[0] = is_extending ? height - y[0] : -y[1];  // lift-off; bottom
        value[1] = is_extending ? y[1] : 1.0;             // top below lift-off
    }
    bool starts_above(int guard) const { return guard == 0; }
    double stop_time() const { return unbounded_time; }
    next_phase event(int guard, double, state& y) {
        if (is_extending) return guard == 0 ? next_phase::returned : next_phase::ended;
        is_extending = true;
        push(y);
        if (y[0] >= height) return next_phase::ended;  // thrust cut: not among the starts
        spring = thrust * y[0];
        return next_phase::goes_on;
    }
    void result(const state& y, double* columns) {
        columns[0] = y[1] / leg_factor;
        skipped_time = thrust_time + 2.0 * columns[0] / flight_gravity;
    }

    /// The thrust, from rest at the bottom.
    void push(state& y) const {
        const double e1 =
            friction > 0.0 ? -std::expm1(-friction * thrust_time) / friction : thrust_time;
        const double e2 =
            friction > 0.0 ? (thrust_time - e1) / friction : 0.5 * thrust_time * thrust_time;
        y = {y[0] + (thrust - gravity) * e2, (thrust - gravity) * e1};
    }

    double height, stiffness, thrust, thrust_time, friction, gravity, flight_gravity, leg_factor;
    double skipped_time = 0.0;  // of thrust and flight
    double spring = 0.0;
    bool is_extending = false;
};

const bool known = compare_with<raibert_pneumatic_system>({.name = "raibert_pneumatic",
                                                           .model = "raibert_pneumatic",
                                                           .section = "touchdown",
                                                           .starts = {{0.8, 4.0}},
                                                           .target_error = 1e-9,
                                                           .is_integrated = true});

}  // namespace
}  // namespace hopscotch::bench
