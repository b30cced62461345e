// The clock-driven hopper from thrust to thrust. Source: models/openloop_hopper.md sections 2, 3;
// Cham and Cutkosky 2007, Eqs (2), (3).
#include "bench/yardstick_solvers.hpp"

namespace hopscotch::bench {
namespace {

struct openloop_hopper_system {
    using state = std::array<double, 2>;  // y, v
    static constexpr int n_guards = 1;
    static constexpr double time_scale = 0.01;

    explicit openloop_hopper_system(const double* parameters)
        : stiffness(parameters[0] * parameters[0]),
          damping(2.0 * parameters[1] * parameters[0]),
          thrust(parameters[2]),
          thrust_time(parameters[3]),
          period(parameters[4]) {}

    next_phase start(const double* columns, state& y) {
        y = {columns[0], columns[1]};
        is_on = true;
        is_airborne = y[0] > 0.0 || (y[0] == 0.0 && y[1] > 0.0);
        return next_phase::goes_on;
    }
    void rates(double, const double* y, double* rate) const {
        rate[0] = y[1];
        rate[1] = -1.0;
        if (!is_airborne) rate[1] += (is_on ? thrust : 0.0) - stiffness * y[0] - damping * y[1];
    }
    void guards(double, const double* y, double* value) const {
        value[0] = is_airborne ? y[0] : -y[0];  // landing; take-off
    }
    bool starts_above(int) const { return true; }
    double stop_time() const { return is_on ? thrust_time : period; }
    next_phase event(int guard, double, state& y) {
        if (guard == 0) {
            y[0] = 0.0;
            is_airborne = !is_airborne;
            return next_phase::goes_on;
        }
        if (!is_on) return next_phase::returned;
        is_on = false;
        return next_phase::goes_on;
    }
    void result(const state& y, double* columns) const {
        columns[0] = y[0];
        columns[1] = y[1];
    }

    double stiffness, damping, thrust, thrust_time, period;
    bool is_on = true;
    bool is_airborne = false;
};

constexpr double w = 30.0;  // the window of Fig. 8 in scaled units: Y in [-4, 2], V in [-3, 3]

const bool known = compare_with<openloop_hopper_system>(
    {.name = "openloop_hopper",
     .model = "openloop_hopper",
     .section = "strobe",
     .parameters = {{"natural_frequency", w},
                    {"damping_ratio", 0.2},
                    {"thrust", 1.55},
                    {"thrust_time", 0.08},
                    {"stride_period", 0.26}},
     .starts = {{-4.0 / (w * w), 2.0 / (w * w)}, {-3.0 / w, 3.0 / w}}});

}  // namespace
}  // namespace hopscotch::bench
