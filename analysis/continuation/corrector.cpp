// Bordered Newton steps.
#include "analysis/continuation/corrector.hpp"

#include <cmath>

#include <Eigen/LU>
#include <Eigen/QR>

namespace hopscotch {
namespace {

constexpr int most_steps = 12;
constexpr double converged = 1e-13;   // step length in scaled unknowns
constexpr double good_enough = 1e-9;  // accepted where rounding stops further progress

Eigen::MatrixXd bordered(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& row) {
    Eigen::MatrixXd matrix(jacobian.cols(), jacobian.cols());
    matrix << jacobian, row.transpose();
    return matrix;
}

}  // namespace

Eigen::VectorXd tangent_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& like) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian.transpose());
    const Eigen::Index n = jacobian.cols();
    Eigen::VectorXd last = Eigen::VectorXd::Unit(n, n - 1);
    last.applyOnTheLeft(qr.householderQ());
    return last.dot(like) < 0.0 ? Eigen::VectorXd(-last) : last;
}

step_result step_along(const curve_equation& equation, const Eigen::VectorXd& from,
                       const Eigen::VectorXd& direction, double length) {
    step_result result;
    Eigen::VectorXd x = from + length * direction;
    double last_step = 1e300;
    for (; result.n_steps < most_steps; ++result.n_steps) {
        const equation_value value = equation.at(x);
        if (!value.is_ok()) {
            result.end = value.end;
            return result;
        }
        Eigen::VectorXd right(x.size());
        right << -value.residual, length - direction.dot(x - from);
        const Eigen::VectorXd step =
            bordered(value.jacobian, direction).partialPivLu().solve(right);
        const double size = step.norm();
        if (!std::isfinite(size) || size > 1e3) return result;
        const bool stagnates = size <= good_enough && size >= 0.5 * last_step;
        if (!stagnates) x += step;
        if (size <= converged || stagnates) {
            result.point = curve_point{x, tangent_of(value.jacobian, direction)};
            return result;
        }
        last_step = size;
    }
    return result;
}

}  // namespace hopscotch
