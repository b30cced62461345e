// What a proof asks of one model: a set of starts and how many returns, and bounds of where they
// lead and of the derivatives, over the whole set. Plain numbers, filled in per model by the
// generated units (analysis/orbit/enclose.hpp).
#pragma once

#include "kernels/contract/info.hpp"

#include <cstdint>
#include <span>

namespace hopscotch {

/// The starts x = centre + frame (from + v) of one section, v in the ball about 0 of that radius or
/// in the cube of that half width.
struct start_region {
    int n_columns = 0;
    int n_directions = 0;  // of v; fewer where columns are held fixed
    double centre[most_columns] = {};
    double frame[most_columns * most_columns] = {};  // n_columns x n_directions, row by row
    double from[most_columns] = {};
    bool is_ball = true;
    double radius = 0.0;
};

struct enclosed_query {
    int section = 0;  // returns to itself
    const int* options = nullptr;
    int variant = 0;
    std::span<const double> parameters;
    int returns = 1;
    double max_steps = 1e4;  // per return
    start_region starts;
};

enum class enclosed_end : std::uint8_t {
    returned,              // every start of the region comes back; the bounds hold
    undecided_comparison,  // starts of the region take different ways (or end the orbit)
    ended,                 // every start ends before its last return
    event_not_unique,      // an event's first time could not be bounded
    not_supported,         // an integrated flow, or more than the arithmetic can follow
};

/// Bounds over all starts of the region, in the section's columns.
struct enclosed_returns {
    enclosed_end end = enclosed_end::not_supported;
    double centre_low[most_columns] = {};  // image of v = 0
    double centre_high[most_columns] = {};
    double low[most_columns] = {};
    double high[most_columns] = {};
    double slope_low[most_columns * most_columns] = {};  // d(image i)_d(v j), row by row
    double slope_high[most_columns * most_columns] = {};
};

}  // namespace hopscotch
