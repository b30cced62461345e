// Where to sample a branch of a return map, and bisection to the last point of an interval.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace hopscotch {

inline constexpr int n_geometric = 160;  // samples per side next to the base, from 1e-13 on
inline constexpr int n_even = 800;       // samples over the rest of the branch

/// Bisects between `inside`, where the condition holds, and `outside`, where it does not; returns
/// the last point that still holds.
template <class Condition>
double last_inside(double inside, double outside, const Condition& holds) {
    for (int i = 0; i < 200; ++i) {
        const double middle = inside + 0.5 * (outside - inside);
        if (middle == inside || middle == outside) break;
        (holds(middle) ? inside : outside) = middle;
    }
    return inside;
}

/// Points from `base` towards `end`: geometric next to the base, then even.
inline std::vector<double> points_towards(double base, double end) {
    std::vector<double> points;
    const double length = end - base;
    const double reach = std::min(0.1, std::abs(length));
    for (int i = 0; i < n_geometric; ++i) {
        const double exponent = 13.0 * (1.0 - static_cast<double>(i) / n_geometric);
        points.push_back(base + std::copysign(reach * std::pow(10.0, -exponent), length));
    }
    const double from = base + std::copysign(reach, length);
    for (int i = 1; i <= n_even; ++i) {
        points.push_back(from + (end - from) * (static_cast<double>(i) / n_even));
    }
    return points;
}

/// The end of the interval from `base` towards `end` on which the condition holds at every sample.
template <class Condition>
double last_of_interval(double base, double end, const Condition& holds) {
    double inside = base;
    for (const double x : points_towards(base, end)) {
        if (!holds(x)) return last_inside(inside, x, holds);
        inside = x;
    }
    return inside;
}

}  // namespace hopscotch
