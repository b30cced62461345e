// Sets every solver that was found at build time up for a hybrid system: what the files in
// bench/systems/ register their cases with.
#pragma once

#include "bench/yardstick_case.hpp"

#ifdef HOPSCOTCH_BENCH_ODEINT
#include "bench/yardstick_odeint.hpp"
#endif
#ifdef HOPSCOTCH_BENCH_CVODE
#include "bench/yardstick_cvode.hpp"
#endif

#include <memory>

namespace hopscotch::bench {

template <class Solver, hybrid_system System>
yardstick_case::solver solver_of() {
    return {Solver::name, [](const double* parameters, double tolerance) -> yardstick {
                auto system = std::make_shared<System>(parameters);
                auto solver = std::make_shared<Solver>(tolerance);
                return [system, solver](const double* columns) {
                    return one_return(*system, *solver, columns);
                };
            }};
}

/// Registers a case whose yardsticks integrate `System`.
template <hybrid_system System>
bool compare_with(yardstick_case one) {
#ifdef HOPSCOTCH_BENCH_ODEINT
    one.solvers.push_back(solver_of<odeint_solver<System>, System>());
#endif
#ifdef HOPSCOTCH_BENCH_CVODE
    one.solvers.push_back(solver_of<cvode_solver<System>, System>());
#endif
    all_cases().push_back(std::move(one));
    return true;
}

}  // namespace hopscotch::bench
