// One-sided stability of a periodic orbit in more than one dimension: along rays from one of its
// points, does it attract next to it, by which law, and how far does the immediate basin reach?
#pragma once

#include "analysis/attractors/side_kind.hpp"
#include "analysis/periodic/map_point.hpp"
#include "kernels/ensemble/request.hpp"

#include <span>
#include <vector>

namespace hopscotch {

/// One ray x* + distance * direction.
struct stability_sector {
    std::vector<double> direction;  // one number per column, of unit length in the columns' scale
    bool attracts = false;          // every start tried next to the point tends to the orbit
    double coefficient = 0.0;       // |P^p(x* + d u) - x*| ~ coefficient d^exponent next to the
    double exponent = 0.0;          // point, in the scale
    double step_coefficient = 0.0;  // the same of |P^p(x) - x|, x = x* + d u
    double step_exponent = 0.0;
    side_kind kind = side_kind::repelling;
    double extent = 0.0;     // distance at which starts first cease to tend to it, in the scale;
                             // to 1e-12 of it, as far as starts were looked at in between
    bool is_bounded = true;  // false: no end found within the farthest distance looked at
};

struct sector_question {
    std::span<const double> point;  // x*
    int period = 1;
    std::span<const int> free;              // columns that the map does not conserve
    std::span<const double> scale;          // of every column
    std::span<const trap_ellipsoid> traps;  // of every attractor, with labels from 1 on
    int label = 1;                          // of the orbit's own traps
    std::uint32_t returns = 4000;           // at most, until a trap is entered
    double farthest = 4.0;                  // in the scale
};

/// Rays: both directions of a single free column; 16 evenly spread over the plane of two; both
/// directions of every column of more.
std::vector<stability_sector> sectors_of(const map_point& map, const sector_question& of);

}  // namespace hopscotch
