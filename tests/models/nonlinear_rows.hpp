// Starts of the passive models with nonlinear spring and gravity: through the compiled kernels in
// double, and one by one in any arithmetic.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch::nonlinear_rows {

inline constexpr int nonlinear = 4;  // compile-time variant

struct terms {
    double mass_ratio = 1.0;
    double restitution = 0.0;
    double damping = 0.0;
    double increment = 0.0;
    double quadratic = 0.0;
    double cubic = 0.0;
    double gradient = 0.0;

    std::vector<double> parameters() const {
        return {mass_ratio, restitution, damping, increment, quadratic, cubic, gradient};
    }
};

struct start {
    std::string_view model = "passive_hopper";
    int section = 0;  // 0: lift-off speed, 1: flight
    std::vector<std::string> columns;
    terms of;
    std::uint32_t returns = 1;
    int variant = nonlinear;
    double tolerance = 0.0;
    double max_steps = 1e5;
    bool derivative = false;
};

inline std::string text(double x) { return fmt::format("{:.17g}", x); }
inline double number(const std::string& decimal) { return std::strtod(decimal.c_str(), nullptr); }

/// Fills a row with what `from` says; `parameters` keeps the texts alive.
inline orbit_row row_of(const start& from, std::vector<std::string>& parameters) {
    for (const double p : from.of.parameters()) parameters.push_back(text(p));
    orbit_row row;
    row.section = from.section;
    row.variant = from.variant;
    row.columns = from.columns;
    row.parameters = parameters;
    row.returns = from.returns;
    row.max_steps = from.max_steps;
    row.tolerance = from.tolerance;
    row.derivative = from.derivative;
    return row;
}

inline orbit_answer in_double(const start& from) {
    std::vector<std::string> parameters;
    return find_model(from.model)->orbits().run_double(row_of(from, parameters));
}
inline orbit_answer in_50_digits(const start& from) {
    std::vector<std::string> parameters;
    return find_model(from.model)->orbits().run_mp50(row_of(from, parameters));
}

/// One return of the hopper from lift-off.
inline orbit_answer hop(double alpha, const terms& of, double tolerance = 0.0) {
    return in_double({.columns = {text(alpha)}, .of = of, .tolerance = tolerance});
}
inline double hop_speed(double alpha, const terms& of, double tolerance = 0.0) {
    return number(hop(alpha, of, tolerance).columns[0]);
}

}  // namespace hopscotch::nonlinear_rows
