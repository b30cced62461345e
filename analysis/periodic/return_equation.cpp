// Evaluates P^period(x) - x through jets of the return map.
#include "analysis/periodic/return_equation.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

/// Derivative of a phase's turn by a parameter: turns are parameters themselves or constants.
double turn_slope(const map_point& map, int column, int parameter) {
    if (parameter < 0) return 0.0;
    map_point moved = map;
    double& value = moved.parameters[static_cast<std::size_t>(parameter)];
    const double at = value;
    const double step = at == 0.0 ? 1.0 : 0.5 * at;
    value = at + step;
    return (turn_of(moved, column) - turn_of(map, column)) / step;
}

}  // namespace

double turn_of(const map_point& map, int column) {
    if (map.model->turn == nullptr) return 0.0;
    return map.model->turn(map.section, column, map.parameters.data());
}

void wrap_phases(const map_point& map, std::span<double> x) {
    for (std::size_t c = 0; c < x.size(); ++c) {
        const double turn = turn_of(map, static_cast<int>(c));
        if (turn <= 0.0 || (x[c] >= 0.0 && x[c] < turn)) continue;
        x[c] -= turn * std::floor(x[c] / turn);
        if (!(x[c] < turn)) x[c] = 0.0;  // a tiny negative phase rounds to a full turn
    }
}

std::vector<int> conserved_columns(const map_point& map, std::span<const double> x) {
    constexpr double rounding = 1e-13;
    std::vector<int> conserved;
    const return_jet jet = map.jet(x.data());
    if (jet.end != outcome::ok) return conserved;
    for (int c = 0; c < map.n_columns(); ++c) {
        const double here = x[static_cast<std::size_t>(c)];
        bool is_same = std::abs(jet.state[c] - here) <= rounding * std::abs(here);
        for (int j = 0; j < map.n_columns(); ++j) {
            is_same = is_same && std::abs(jet.derivative[c][j] - (j == c ? 1.0 : 0.0)) <= rounding;
        }
        if (is_same) conserved.push_back(c);
    }
    return conserved;
}

return_value evaluate_return(const map_point& map, std::span<const double> x, int period,
                             std::span<const int> columns, int by_parameter) {
    std::vector<double> start(x.begin(), x.end());
    wrap_phases(map, start);
    const return_jet jet = map.jet(start.data(), static_cast<std::uint32_t>(period), by_parameter);
    return_value value{.end = jet.end};
    if (jet.end != outcome::ok) return value;
    const auto n = static_cast<Eigen::Index>(columns.size());
    value.gap.resize(n);
    value.derivative.resize(n, n);
    value.by_column.resize(n, map.n_columns());
    value.by_parameter.setZero(n);
    value.events = jet.events;
    value.time = jet.time;
    for (Eigen::Index i = 0; i < n; ++i) {
        const int column = columns[static_cast<std::size_t>(i)];
        value.gap[i] = jet.state[column] - start[static_cast<std::size_t>(column)];
        if (by_parameter >= 0) value.by_parameter[i] = jet.parameter_derivative[column];
        if (const double turn = turn_of(map, column); turn > 0.0) {
            const double turns = std::nearbyint(value.gap[i] / turn);
            value.gap[i] -= turns * turn;
            value.by_parameter[i] -= turns * turn_slope(map, column, by_parameter);
        }
        for (Eigen::Index j = 0; j < n; ++j) {
            value.derivative(i, j) = jet.derivative[column][columns[static_cast<std::size_t>(j)]];
        }
        for (int j = 0; j < map.n_columns(); ++j) {
            value.by_column(i, j) = jet.derivative[column][j];
        }
    }
    const bool is_finite = value.gap.allFinite() && value.derivative.allFinite();
    if (!is_finite) value.end = outcome::not_finite;
    return value;
}

}  // namespace hopscotch
