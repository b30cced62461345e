// Boost.odeint as the solver of the physical hopper: Dormand-Prince 5 with dense output, an event
// where the gap's sign has changed between accepted steps, located by bisection on the dense
// output.
#pragma once

#include "bench/physical_hopper.hpp"

#include <boost/numeric/odeint.hpp>

namespace hopscotch::bench {

class odeint_solver {
public:
    static constexpr const char* name = "Boost.odeint dopri5 dense output + bisection";

    odeint_solver(physical_hopper hopper, double tolerance)
        : hopper_(hopper),
          tolerance_(tolerance),
          flight_(boost::numeric::odeint::make_dense_output(
              tolerance, tolerance, boost::numeric::odeint::runge_kutta_dopri5<flight_state>())),
          contact_(boost::numeric::odeint::make_dense_output(
              tolerance, tolerance, boost::numeric::odeint::runge_kutta_dopri5<contact_state>())) {}

    const physical_hopper& model() const { return hopper_; }

    /// The gap is zero at the launch, so the first step's beginning counts as above the ground.
    bool fly(flight_state& y, double& time) {
        const auto rates = [this](const flight_state& at, flight_state& rate, double) {
            hopper_.flight(at.data(), rate.data());
        };
        flight_.initialize(y, 0.0, first_step);
        while (flight_.current_time() < longest_phase) {
            flight_.do_step(rates);
            if (flight_.current_state()[2] > 0.0) continue;
            const double t = bisect(flight_, flight_.previous_time(), flight_.current_time(), y,
                                    [](const flight_state& at) { return at[2] <= 0.0; });
            time += t;
            return true;
        }
        return false;
    }

    return_end stand(contact_state& y, double& time) {
        const auto rates = [this](const contact_state& at, contact_state& rate, double) {
            hopper_.contact(at.data(), rate.data());
        };
        const auto lifts = [](const contact_state& at) { return at[0] >= 1.0; };
        contact_.initialize(y, 0.0, first_step);
        while (contact_.current_time() < longest_phase) {
            contact_.do_step(rates);
            const contact_state& now = contact_.current_state();
            const double before = contact_.previous_time();
            double after = contact_.current_time();
            if (!lifts(now)) {
                if (!(contact_.previous_state()[1] > 0.0 && now[1] <= 0.0)) continue;
                // the body has turned within the step: was it above the lift-off height there?
                after = bisect(contact_, before, after, y,
                               [](const contact_state& at) { return at[1] <= 0.0; });
                if (!lifts(y)) return return_end::stuck;
            }
            time += bisect(contact_, before, after, y, lifts);
            return return_end::lifted;
        }
        return return_end::lost;
    }

private:
    static constexpr double first_step = 0.1;
    using flight_stepper = boost::numeric::odeint::result_of::make_dense_output<
        boost::numeric::odeint::runge_kutta_dopri5<flight_state>>::type;
    using contact_stepper = boost::numeric::odeint::result_of::make_dense_output<
        boost::numeric::odeint::runge_kutta_dopri5<contact_state>>::type;

    /// Time at which `is_after` turns true, to a tenth of the tolerance; `y` is the state there.
    template <class Stepper, class State, class Condition>
    double bisect(Stepper& stepper, double low, double high, State& y, Condition is_after) const {
        const double narrow = 0.1 * tolerance_;
        while (high - low > narrow * std::fmax(high, 1.0)) {
            const double middle = 0.5 * (low + high);
            if (!(middle > low && middle < high)) break;
            stepper.calc_state(middle, y);
            (is_after(y) ? high : low) = middle;
        }
        stepper.calc_state(high, y);
        return high;
    }

    physical_hopper hopper_;
    double tolerance_;
    flight_stepper flight_;
    contact_stepper contact_;
};

}  // namespace hopscotch::bench
