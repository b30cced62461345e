// The starts of one yardstick case with their true returns in 50 digits: what every solver's and
// every kernel's error is measured against.
#pragma once

#include "bench/model_returns.hpp"
#include "bench/yardstick_case.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace hopscotch::bench {

/// What one method at one tolerance made of all starts.
struct accuracy {
    std::vector<double> errors;       // relative, largest column, where the outcome is right
    std::vector<double> time_errors;  // of the return's time, relative; where times are wanted
    std::vector<double> drifts;       // of what a return conserves, relative; where it does
    double n_wrong = 0.0;             // outcomes
    double n_starts = 0.0;

    double middle() const;
    double wrong_share() const { return n_wrong / n_starts; }
};

class known_returns {
public:
    static constexpr std::size_t n_starts = 240;
    static constexpr std::size_t n_copies = 8;  // of the starts in one kernel call: lanes stay full

    known_returns(const yardstick_case& what, bool wants_time);

    std::size_t size() const { return n_; }
    model_returns& work() { return work_; }

    /// The fastest kernel at a tolerance (0: its own).
    accuracy of_kernel(double tolerance);
    accuracy of_solver(const yardstick& solver) const;

    /// Double-double against 50 digits, over the first `n` starts.
    accuracy of_double_double(std::size_t n) const;

    /// Microseconds per return of a pass over `copies` copies of the starts.
    double per_return(double seconds, std::size_t copies) const {
        return 1e6 * seconds / static_cast<double>(copies * n_);
    }

private:
    struct true_state {
        bool returns = false;
        double time = 0.0;
        double columns[most_columns] = {};
    };

    /// Largest error of a state, each column over the larger of its true size and its typical one.
    void book(accuracy& result, std::size_t i, bool returned, const double* columns, double time,
              double loss) const;

    bool wants_time_;
    std::function<double(const double*, const double*)> invariant_;
    model_returns work_;
    std::size_t n_ = 0;
    std::vector<true_state> truth_;
    std::vector<double> scale_;  // typical size of each column
};

}  // namespace hopscotch::bench
