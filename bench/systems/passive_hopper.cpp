// The passive hopper: flights and contact, plastic impacts. Source: models/passive_hopper.md
// section 2, CPRR Eqs (2), (5).
#include "bench/yardstick_solvers.hpp"

#include <cmath>
#include <limits>

namespace hopscotch::bench {
namespace {

/// \tparam Timed  contact integrated to lift-off; otherwise its end follows from energy
template <bool Timed>
struct passive_hopper_system {
    using state = std::array<double, 4>;  // y1, v1, y2, v2
    static constexpr int n_guards = 2;
    static constexpr double time_scale = 0.1;

    explicit passive_hopper_system(const double* parameters) : mass_ratio(parameters[0]) {}

    next_phase start(const double* columns, state& y) {
        y = {1.0, columns[0], 0.0, 0.0};
        loss = 0.0;
        is_flying = true;
        return next_phase::goes_on;
    }
    void rates(double, const double* y, double* rate) const {
        const double spring = y[0] - y[2];
        const double share = 1.0 / (1.0 + mass_ratio);
        rate[0] = y[1];
        rate[1] = -(1.0 + mass_ratio * spring) * share;
        rate[2] = y[3];
        rate[3] = is_flying ? (spring - 1.0) * share : 0.0;
    }
    void guards(double, const double* y, double* value) const {
        value[0] = is_flying ? y[2] : 1.0 - y[0];  // impact; lift-off
        value[1] = is_flying ? 1.0 : y[1];         // the body turns below the lift-off height
    }
    bool starts_above(int guard) const { return guard == 0; }
    double stop_time() const { return unbounded_time; }
    next_phase event(int guard, double, state& y) {
        if (!is_flying) return guard == 0 ? next_phase::returned : next_phase::ended;
        loss += mass_ratio * y[3] * y[3];
        y[2] = y[3] = 0.0;
        if (y[0] > 1.0) return next_phase::goes_on;
        is_flying = false;
        if constexpr (Timed) return next_phase::goes_on;
        const double square =
            y[1] * y[1] + (y[0] - 1.0) * (mass_ratio * (y[0] + 1.0) + 2.0) / (1.0 + mass_ratio);
        y[1] = std::sqrt(std::fmax(square, 0.0));
        return square > 0.0 ? next_phase::returned : next_phase::ended;
    }
    void result(const state& y, double* columns) const { columns[0] = y[1]; }

    double mass_ratio;
    double skipped_time = Timed ? 0.0 : std::numeric_limits<double>::quiet_NaN();  // of the contact
    double loss = 0.0;  // of twice the energy over the upper mass
    bool is_flying = true;
};

yardstick_case hopper(std::string name, double mass_ratio, bool timed) {
    return {
        .name = std::move(name),
        .model = "passive_hopper",
        .section = "liftoff",
        .parameters = {{"mass_ratio", mass_ratio}},
        .starts = {{0.0, 15.0}},
        .fixed_tolerance = 1e-12,
        .wants_time = timed,
        .invariant = [](const double* columns, const double*) { return columns[0] * columns[0]; }};
}

const bool known[] = {
    compare_with<passive_hopper_system<false>>(hopper("passive_hopper M=1", 1.0, false)),
    compare_with<passive_hopper_system<false>>(hopper("passive_hopper M=20", 20.0, false)),
    compare_with<passive_hopper_system<true>>(hopper("passive_hopper M=1, times", 1.0, true)),
    compare_with<passive_hopper_system<true>>(hopper("passive_hopper M=20, times", 20.0, true))};

}  // namespace
}  // namespace hopscotch::bench
