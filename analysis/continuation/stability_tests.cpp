// Test functions from determinants and eigenvalues of DP^period.
#include "analysis/continuation/stability_tests.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace hopscotch {
namespace {

double shifted_determinant(const Eigen::MatrixXd& derivative, double shift) {
    const Eigen::Index n = derivative.rows();
    return (derivative + shift * Eigen::MatrixXd::Identity(n, n)).determinant();
}

}  // namespace

double flip_test(const Eigen::MatrixXd& derivative) { return shifted_determinant(derivative, 1.0); }
double fold_test(const Eigen::MatrixXd& derivative) {
    return shifted_determinant(derivative, -1.0);
}

double pair_test(const Eigen::MatrixXd& derivative) {
    if (derivative.rows() == 2) return derivative.determinant() - 1.0;
    const auto multipliers = multipliers_of(derivative);
    std::complex<double> product = 1.0;
    for (std::size_t i = 0; i < multipliers.size(); ++i) {
        for (std::size_t j = i + 1; j < multipliers.size(); ++j) {
            product *= multipliers[i] * multipliers[j] - 1.0;
        }
    }
    return product.real();
}

std::optional<test_values> tests_at(const branch_equation& equation, const curve_point& point) {
    const equation_value value = equation.at(point.unknowns);
    const Eigen::MatrixXd derivative = equation.derivative_at(point.unknowns);
    if (!value.is_ok() || derivative.size() == 0) return std::nullopt;
    const Eigen::Index n = point.unknowns.size();
    Eigen::MatrixXd bordered(n, n);
    bordered << value.jacobian, point.tangent.transpose();
    return test_values{point.tangent[n - 1], flip_test(derivative), pair_test(derivative),
                       bordered.determinant()};
}

std::optional<curve_point> locate(
    const curve_equation& equation, const curve_point& from, double length,
    const std::function<std::optional<double>(const curve_point&)>& test) {
    constexpr int most_evaluations = 80;
    constexpr double closeness = 4e-16;  // of the step's length
    constexpr double close = 1e-3;       // where a chord is taken if Newton's method is singular
    struct end {
        double length;
        curve_point point;
        double value;  // halved where the other end has moved twice
    };
    const auto at = [&](double where) -> std::optional<end> {
        const auto point = step_along(equation, from.unknowns, from.tangent, where).point;
        const auto value = point ? test(*point) : std::nullopt;
        return value ? std::optional(end{where, *point, *value}) : std::nullopt;
    };
    const auto value_here = test(from);
    const auto reached = at(length);
    if (!value_here || !reached || *value_here * reached->value > 0.0) return std::nullopt;
    end low{0.0, from, *value_here};
    end high = *reached;
    int last_side = 0;
    for (int i = 0; i < most_evaluations && high.length - low.length > closeness * length; ++i) {
        const double apart = high.length - low.length;
        double share = low.value / (low.value - high.value);
        if (!(share > 0.0 && share < 1.0) || i % 8 == 7) share = 0.5;
        auto middle = at(low.length + share * apart);
        if (!middle) middle = at(low.length + (share < 0.5 ? 0.6 : 0.4) * apart);
        if (!middle && apart < close * length) {
            const Eigen::VectorXd chord = high.point.unknowns - low.point.unknowns;
            return curve_point{low.point.unknowns + share * chord, low.point.tangent};
        }
        if (!middle) return std::nullopt;
        if (middle->value == 0.0) return middle->point;
        const bool is_high = (middle->value < 0.0) == (high.value < 0.0);
        const int side = is_high ? 1 : -1;
        if (side == last_side) (is_high ? low : high).value *= 0.5;
        (is_high ? high : low) = *middle;
        last_side = side;
    }
    return std::abs(low.value) < std::abs(high.value) ? low.point : high.point;
}

std::optional<special_kind> kind_of_zero(int test,
                                         const std::vector<std::complex<double>>& multipliers) {
    constexpr double near = 1e-4;  // a sign change through infinity is no zero
    const auto closest_to = [&](double target) {
        double distance = 1e300;
        for (const auto& mu : multipliers) distance = std::min(distance, std::abs(mu - target));
        return distance;
    };
    if (test == 0 && closest_to(1.0) < near) return special_kind::fold;
    if (test == 1 && closest_to(-1.0) < near) return special_kind::flip;
    if (test == 3 && closest_to(1.0) < near) return special_kind::branch_point;
    if (test == 2) {
        for (const auto& mu : multipliers) {
            if (std::abs(std::abs(mu) - 1.0) < near && std::abs(mu.imag()) > near)
                return special_kind::neimark_sacker;
        }
    }
    return std::nullopt;
}

}  // namespace hopscotch
