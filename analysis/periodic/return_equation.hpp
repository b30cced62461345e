// The equation of a periodic orbit, P^period(x) = x, with its exact derivatives: what Newton's
// method on periodic points and the continuation of branches solve.
#pragma once

#include "analysis/periodic/map_point.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace hopscotch {

/// Length of a full turn of a column that is a phase; 0 where it does not wrap.
double turn_of(const map_point& map, int column);

/// x with every phase inside [0, turn).
void wrap_phases(const map_point& map, std::span<double> x);

/// Columns that the map returns unchanged near x, whatever the other columns are (a runner's speed,
/// say): dP_c/dx_j is 1 for j = c and 0 otherwise, to the last bits.
std::vector<int> conserved_columns(const map_point& map, std::span<const double> x);

/// P^period at one point, over some of the columns.
struct return_value {
    outcome end = outcome::ok;     // the numbers below mean nothing unless it is ok
    Eigen::VectorXd gap;           // P^period(x) - x, phases to the nearest turn
    Eigen::MatrixXd derivative;    // of P^period by these columns
    Eigen::MatrixXd by_column;     // of P^period's columns given, by every column
    Eigen::VectorXd by_parameter;  // of the gap
    std::uint64_t events = 0;
    double time = 0.0;

    bool is_ok() const { return end == outcome::ok; }
};

/// \param x             one number per column of the section; phases may lie outside one turn
/// \param columns       the unknown ones
/// \param by_parameter  also differentiate by this parameter (-1: none)
return_value evaluate_return(const map_point& map, std::span<const double> x, int period,
                             std::span<const int> columns, int by_parameter = -1);

}  // namespace hopscotch
