// Boost.odeint as the solver of a hybrid system: Dormand-Prince 5 with dense output, an event where
// a guard's sign has changed between accepted steps, located by bisection on the dense output.
#pragma once

#include "bench/hybrid_system.hpp"

#include <algorithm>
#include <cmath>

#include <boost/numeric/odeint.hpp>

namespace hopscotch::bench {

template <hybrid_system System>
class odeint_solver {
public:
    static constexpr const char* name = "Boost.odeint dopri5 dense output + bisection";

    /// \param tolerance  absolute and relative; events to a tenth of it
    explicit odeint_solver(double tolerance)
        : tolerance_(tolerance),
          stepper_(boost::numeric::odeint::make_dense_output(
              tolerance, tolerance, boost::numeric::odeint::runge_kutta_dopri5<state>())) {}

    int advance(System& system, typename System::state& y, double& time) {
        constexpr int most_steps = 100000;
        const auto rates = [&](const state& at, state& rate, double t) {
            system.rates(t, at.data(), rate.data());
        };
        const double stop = system.stop_time();
        guard_values at_start;
        system.guards(time, y.data(), at_start.data());
        std::array<bool, System::n_guards> is_above;
        for (int i = 0; i < System::n_guards; ++i) {
            is_above[i] = at_start[i] > 0.0 || (at_start[i] == 0.0 && system.starts_above(i));
        }
        stepper_.initialize(y, time, System::time_scale);
        for (int step = 0; step < most_steps; ++step) {
            stepper_.do_step(rates);
            const double before = stepper_.previous_time();
            double after = std::min(stepper_.current_time(), stop);
            int fallen = first_fallen(system, is_above, after, y);
            if (fallen < 0 && after == stop) {
                time = stop;
                return -1;
            }
            if (fallen < 0) continue;
            // another guard may have fallen before it
            for (int others = 0; others < System::n_guards; ++others) {
                const double last_above = bisect(system, fallen, before, after, y);
                const int earlier =
                    last_above > before ? first_fallen(system, is_above, last_above, y) : -1;
                if (earlier < 0) break;
                fallen = earlier;
                after = last_above;
            }
            stepper_.calc_state(after, y);
            time = after;
            return fallen;
        }
        return -2;
    }

private:
    using state = typename System::state;
    using guard_values = std::array<double, System::n_guards>;

    /// A guard that was above zero and is not at t; those above are remembered.
    int first_fallen(const System& system, std::array<bool, System::n_guards>& is_above, double t,
                     state& y) {
        guard_values now;
        stepper_.calc_state(t, y);
        system.guards(t, y.data(), now.data());
        int fallen = -1;
        for (int i = 0; i < System::n_guards; ++i) {
            if (now[i] > 0.0) {
                is_above[i] = true;
            } else if (is_above[i] && fallen < 0) {
                fallen = i;
            }
        }
        return fallen;
    }

    /// Narrows (low, high] down to the guard's fall; `high` moves there, the last time above it is
    /// returned.
    double bisect(const System& system, int guard, double low, double& high, state& y) {
        const double narrow = 0.1 * tolerance_;
        guard_values now;
        while (high - low > narrow * std::fmax(std::fabs(high), System::time_scale)) {
            const double middle = 0.5 * (low + high);
            if (!(middle > low && middle < high)) break;
            stepper_.calc_state(middle, y);
            system.guards(middle, y.data(), now.data());
            (now[guard] <= 0.0 ? high : low) = middle;
        }
        return low;
    }

    double tolerance_;
    typename boost::numeric::odeint::result_of::make_dense_output<
        boost::numeric::odeint::runge_kutta_dopri5<state>>::type stepper_;
};

}  // namespace hopscotch::bench
