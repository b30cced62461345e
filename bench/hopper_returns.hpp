// One return of the passive hopper from many lift-off speeds: the work that the return-map
// benchmarks time, its results, and what they should be (50 digits).
#pragma once

#include "kernels/contract/entry.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace hopscotch::bench {

/// Starts and results of one return each, plastic impacts, no damping.
struct hopper_returns {
    double mass_ratio = 1.0;
    std::vector<double> starts;
    std::vector<double> speeds;  // f(alpha)
    std::vector<double> times;   // of the return, where asked for
    std::vector<double> bounces;
    std::vector<std::uint8_t> ends;  // outcome codes

    hopper_returns(double mass, std::vector<double> speeds_at_lift_off);
    std::size_t size() const { return starts.size(); }

    /// What is timed: f and outcome, with the return's time where `is_timed`.
    void compute(backend which, bool is_timed);
    /// Bounces of every return; gives the number of flights, one more than bounces in each return.
    double count_flights();

private:
    lane_statistics run(backend which, bool is_timed, bool wants_bounces);
};

/// Lift-off speeds, uniform on (0, 15); always the same ones.
std::vector<double> uniform_starts(std::size_t n);

/// Backends built in and able to run here, fastest first.
std::vector<backend> cpu_backends();

/// The truth of one return.
struct true_return {
    bool returns = false;  // otherwise stuck
    double speed = 0.0;    // f(alpha) = speed + speed_rest
    double speed_rest = 0.0;
    double time = 0.0;
    double bounces = 0.0;
    double slope = 0.0;  // f'(alpha)
};
true_return truth_of(double start, double mass_ratio);

/// How far a result is from the truth.
struct return_error {
    double
        relative;  // over the larger of |f| and |f'| alpha: one relative rounding of the start is 1
    double rounding;  // over the larger of ulp(f) and |f'| ulp(alpha)
    double absolute;
};
return_error error_of(double speed, double start, const true_return& truth);

/// Distance from |x| to the next double.
double ulp(double x);

}  // namespace hopscotch::bench
