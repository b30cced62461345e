// A hybrid system as someone with a general ODE solver would write it: right-hand sides, guards,
// resets. bench/systems/ has one per model; the solver is the caller's (yardstick_odeint.hpp,
// yardstick_cvode.hpp). Closed forms that such a user would not integrate (a ballistic flight
// between two stances, say) are jumped over inside `event`.
#pragma once

#include <array>
#include <limits>

namespace hopscotch::bench {

/// What follows an event.
enum class next_phase { goes_on, returned, ended };

/// A phase without an end in time.
inline constexpr double unbounded_time = std::numeric_limits<double>::infinity();

/// What a system offers; `state` is the largest of its modes' states, the rest has rate 0.
template <class System>
concept hybrid_system = requires(System system, const System& fixed, typename System::state y,
                                 const double* numbers, double* results, double t, int guard) {
    System(numbers);  // the model's parameters, in its order
    { System::n_guards } -> std::convertible_to<int>;
    { System::time_scale } -> std::convertible_to<double>;     // first step of a phase
    { system.start(numbers, y) } -> std::same_as<next_phase>;  // the section's columns
    fixed.rates(t, y.data(), results);
    fixed.guards(t, y.data(), results);                   // fall through zero at their events
    { fixed.starts_above(guard) } -> std::same_as<bool>;  // a guard that is zero at a phase's start
    { fixed.stop_time() } -> std::same_as<double>;        // end of the phase by the clock
    { system.event(guard, t, y) } -> std::same_as<next_phase>;  // guard -1: the stop time
    system.result(y, results);                                  // the section's columns
};

/// One return of a system from section to section.
struct yardstick_return {
    bool returned = false;
    bool lost = false;  // the solver found no event
    int events = 0;
    double time = 0.0;  // NaN where the system leaves out phases without knowing their time
    double loss = 0.0;  // of what the return conserves else, where the system books it
    std::array<double, 8> columns{};
};

/// A solver offers  int advance(System&, state&, double& time): integrates to the first guard or
/// the stop time (-1); -2 where there is neither.
template <hybrid_system System, class Solver>
yardstick_return one_return(System& system, Solver& solver, const double* columns) {
    constexpr int most_events = 10000;
    yardstick_return result;
    typename System::state y{};
    next_phase next = system.start(columns, y);
    while (next == next_phase::goes_on && result.events < most_events) {
        const int guard = solver.advance(system, y, result.time);
        result.lost = guard == -2;
        if (result.lost) return result;
        ++result.events;
        next = system.event(guard, result.time, y);
    }
    result.returned = next == next_phase::returned;
    result.lost = next == next_phase::goes_on;
    if (result.returned) system.result(y, result.columns.data());
    if constexpr (requires { system.loss; }) result.loss = system.loss;
    if constexpr (requires { system.skipped_time; }) result.time += system.skipped_time;
    return result;
}

}  // namespace hopscotch::bench
