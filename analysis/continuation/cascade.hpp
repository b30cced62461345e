// Where a cascade of period doublings accumulates.
#pragma once

#include "analysis/continuation/branch.hpp"

#include <optional>
#include <vector>

namespace hopscotch {

struct accumulation {
    std::vector<double> flips;  // of the periods p, 2 p, 4 p, ...
    double limit = 0.0;
    double error = 0.0;  // the last correction, or a tenth of the last change where that is more
    double ratio = 0.0;  // of the last two gaps; 4.669... in the limit
};

/// Extrapolates the flips with Feigenbaum's constant, a_k = b_k + (b_k - b_(k-1)) / (delta - 1),
/// and the a_k, whose errors fall geometrically too, with Aitken's process.
///
/// \return  none for fewer than four flips
std::optional<accumulation> accumulation_of(const std::vector<double>& flips);

/// The same for every cascade among branches that were switched to at flips.
std::vector<accumulation> cascades_of(const std::vector<branch>& branches);

}  // namespace hopscotch
