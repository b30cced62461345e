// The impacting relief valve from one local maximum of the displacement to the next. Source:
// PEERS.md; Hegedus, Hos, Kulesza et al. (MPGOS).
#include "bench/yardstick_solvers.hpp"

#include <cmath>

namespace hopscotch::bench {
namespace {

struct relief_valve_system {
    using state = std::array<double, 3>;  // x, v, p
    static constexpr int n_guards = 2;
    static constexpr double time_scale = 0.01;

    explicit relief_valve_system(const double* p)
        : damping(p[0]), offset(p[1]), gain(p[2]), restitution(p[3]), flow(p[4]) {}

    next_phase start(const double* columns, state& y) {
        y = {columns[0], 0.0, columns[1]};
        return next_phase::goes_on;
    }
    void rates(double, const double* y, double* rate) const {
        rate[0] = y[1];
        rate[1] = -damping * y[1] - (y[0] + offset) + y[2];
        rate[2] = gain * (flow - y[0] * std::sqrt(std::fmax(y[2], 0.0)));
    }
    void guards(double, const double* y, double* value) const {
        value[0] = y[0];  // impact
        value[1] = y[1];  // maximum
    }
    bool starts_above(int guard) const { return guard == 0; }
    double stop_time() const { return unbounded_time; }
    next_phase event(int guard, double, state& y) {
        if (guard == 1) return next_phase::returned;
        y[0] = 0.0;
        y[1] *= -restitution;
        return next_phase::goes_on;
    }
    void result(const state& y, double* columns) const {
        columns[0] = y[0];
        columns[1] = y[2];
    }

    double damping, offset, gain, restitution, flow;
};

const bool known = compare_with<relief_valve_system>({.name = "relief_valve",
                                                      .model = "relief_valve",
                                                      .section = "maximum",
                                                      .starts = {{0.2, 6.0}, {0.0, 20.0}},
                                                      .settled_after = 32,
                                                      .target_error = 1e-9,
                                                      .is_integrated = true});

}  // namespace
}  // namespace hopscotch::bench
