// One model's comparison with general ODE solvers: which returns, from which starts, at which
// error. Every file in bench/systems/ describes a hybrid system and registers its cases here; the
// driver is yardsticks.cpp.
#pragma once

#include "bench/hybrid_system.hpp"
#include "bench/model_returns.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hopscotch::bench {

/// One return from a row of columns.
using yardstick = std::function<yardstick_return(const double* columns)>;
/// Sets a solver up for a system's parameters at a tolerance.
using yardstick_maker = std::function<yardstick(const double* parameters, double tolerance)>;

struct yardstick_case {
    std::string name;
    std::string model;
    std::string section;
    named_numbers parameters;
    named_words options;
    std::vector<std::pair<double, double>> starts;  // limits of each column
    std::uint32_t settled_after = 0;                // returns before the measurement
    double target_error = 1e-10;                    // at which the solvers are compared
    double fixed_tolerance = 0.0;                   // one more comparison, at this tolerance
    bool is_integrated = false;                     // then the kernel too is run at that error
    bool wants_time = false;
    /// What every return leaves as it is but for the model's extra `loss`, where there is
    /// something: of a section's columns and the model's parameters.
    std::function<double(const double* columns, const double* parameters)> invariant{};

    struct solver {
        std::string name;
        yardstick_maker make;
    };
    std::vector<solver> solvers;  // filled in by `compare_with` (yardstick_solvers.hpp)
};

/// All cases registered.
std::vector<yardstick_case>& all_cases();

}  // namespace hopscotch::bench
