// The passive hopper as someone with a general ODE solver would write it: physical state,
// right-hand sides, events and resets, and one return from lift-off to lift-off. The solver is the
// caller's. Source: models/passive_hopper.md section 2, CPRR Eqs (2), (5).
#pragma once

#include <array>
#include <cmath>

namespace hopscotch::bench {

using flight_state = std::array<double, 4>;   // y1, v1, y2, v2
using contact_state = std::array<double, 2>;  // y1, v1; the foot rests

/// No flight or contact of the benchmark's starts (lift-off speed below 15) takes longer.
inline constexpr double longest_phase = 60.0;

struct physical_hopper {
    double mass_ratio;

    void flight(const double* y, double* rate) const {
        const double spring = y[0] - y[2];
        const double share = 1.0 / (1.0 + mass_ratio);
        rate[0] = y[1];
        rate[1] = -(1.0 + mass_ratio * spring) * share;
        rate[2] = y[3];
        rate[3] = (spring - 1.0) * share;
    }
    void contact(const double* y, double* rate) const {
        rate[0] = y[1];
        rate[1] = -(1.0 + mass_ratio * y[0]) / (1.0 + mass_ratio);
    }
    /// Square of the lift-off speed by energy: contact in closed form.
    double lift_off_energy(const contact_state& y) const {
        return y[1] * y[1] + (y[0] - 1.0) * (mass_ratio * (y[0] + 1.0) + 2.0) / (1.0 + mass_ratio);
    }
};

enum class contact_rule { integrated, by_energy };

enum class return_end { lifted, stuck, lost };

struct physical_return {
    return_end end = return_end::lost;
    double speed = 0.0;
    double time = 0.0;  // of flights, and of contact where it is integrated
    int impacts = 0;
};

/// One return. A solver offers
///   bool fly(flight_state&, double& time)    to the impact; false: none found before longest_phase
///   return_end stand(contact_state&, double& time)  to lift-off
/// and advances state and time.
template <class Solver>
physical_return one_return(Solver& solver, double alpha, contact_rule rule) {
    constexpr int most_impacts = 1000;
    physical_return result;
    flight_state y{1.0, alpha, 0.0, 0.0};
    while (result.impacts < most_impacts) {
        if (!solver.fly(y, result.time)) return result;
        ++result.impacts;
        y[2] = y[3] = 0.0;  // plastic impact
        if (y[0] > 1.0) continue;
        contact_state ground{y[0], y[1]};
        if (rule == contact_rule::by_energy) {
            const double energy = solver.model().lift_off_energy(ground);
            result.end = energy > 0.0 ? return_end::lifted : return_end::stuck;
            result.speed = std::sqrt(std::fmax(energy, 0.0));
        } else {
            result.end = solver.stand(ground, result.time);
            result.speed = ground[1];
        }
        return result;
    }
    return result;
}

}  // namespace hopscotch::bench
