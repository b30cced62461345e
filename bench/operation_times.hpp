// Nanoseconds per element of single operations and elementary functions, per target: measured in
// the process that needs them, because absolute times drift.
#pragma once

#include "bench/counted_kernels.hpp"
#include "kernels/ensemble/request.hpp"

namespace hopscotch::bench {

/// Nanoseconds per element.
struct operation_times {
    double fused = 0.0;
    double plain = 0.0;
    double comparison_and_selection = 0.0;  // one of each
    double rounding = 0.0;
    double division = 0.0;
    double square_root = 0.0;
    std::array<double, n_counted_functions> functions{};  // in the order of counted_work

    /// What a trajectory's work takes at these rates: elementary functions, divisions and square
    /// roots alone.
    double costly_floor(const counted_work& work) const;
    /// And every sum, product, comparison, selection and rounding outside of elementary functions
    /// as well, one after the other.
    double whole_floor(const counted_work& work) const;
};

operation_times measure_operations(backend which);

}  // namespace hopscotch::bench
