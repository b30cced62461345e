// Lyapunov exponents of one orbit from exact derivatives, with their standard errors: tells chaos
// from slow convergence where a search for attractors meets an orbit that no trap has caught.
#pragma once

#include "analysis/periodic/map_point.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace hopscotch {

struct orbit_exponents {
    bool is_complete = false;     // the orbit went on for all returns with finite derivatives
    std::vector<double> mean;     // per return, falling; one per free column
    std::vector<double> error;    // standard error over blocks
    std::vector<double> visited;  // [block][column]: the state at the end of every block

    double returns = 0.0;  // counted

    /// The largest exponent is positive by five standard errors.
    bool is_positive() const { return is_complete && mean[0] > 0.0 && mean[0] > 5.0 * error[0]; }
    /// Negative by as many: the orbit settles, however slowly.
    bool is_negative() const { return is_complete && mean[0] < -5.0 * error[0]; }
    /// Positive, and grown far beyond what shear along a family of neutral orbits gives, whose
    /// tangents grow like the number of returns.
    bool is_chaotic() const { return is_positive() && mean[0] * returns > 4.0 * std::log(returns); }
};

/// \param start  one number per column
/// \param free   columns that the map does not conserve
/// \param n_blocks, block  blocks of so many returns each; the first quarter is transient and not
///                         counted
orbit_exponents exponents_of(const map_point& map, std::span<const double> start,
                             std::span<const int> free, int n_blocks, int block);

}  // namespace hopscotch
