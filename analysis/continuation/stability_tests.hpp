// Functions that change sign where a branch's stability changes, and the location of their zeros.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/corrector.hpp"
#include "analysis/periodic/multipliers.hpp"

#include <array>
#include <functional>
#include <optional>

namespace hopscotch {

/// det(D + 1): zero where a multiplier is -1.
double flip_test(const Eigen::MatrixXd& derivative);
/// det(D - 1): zero where a multiplier is +1.
double fold_test(const Eigen::MatrixXd& derivative);
/// Product of (mu_i mu_j - 1) over all pairs: zero where a pair has the product 1.
double pair_test(const Eigen::MatrixXd& derivative);

/// All tests at one point of a branch: the variable's share of the tangent, flip, pair, and the
/// determinant of the bordered Jacobian, which vanishes where branches cross.
using test_values = std::array<double, 4>;
std::optional<test_values> tests_at(const branch_equation& equation, const curve_point& point);

/// Zero of a test between `from` and the point at `length` along its tangent, where the test has
/// the other sign; to rounding level (regula falsi with halved end values).
std::optional<curve_point> locate(
    const curve_equation& equation, const curve_point& from, double length,
    const std::function<std::optional<double>(const curve_point&)>& test);

/// What the i-th test's zero is; none where it is of no interest (a neutral saddle).
std::optional<special_kind> kind_of_zero(int test,
                                         const std::vector<std::complex<double>>& multipliers);

}  // namespace hopscotch
