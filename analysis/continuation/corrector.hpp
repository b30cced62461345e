// One step of pseudo-arclength continuation: tangent of a solution curve and Newton's method in the
// plane perpendicular to it.
#pragma once

#include "analysis/continuation/equation.hpp"

#include <optional>

namespace hopscotch {

/// A solution, and the unit tangent of the curve there.
struct curve_point {
    Eigen::VectorXd unknowns;
    Eigen::VectorXd tangent;
};

/// Unit null vector of an n x (n + 1) Jacobian, on the side of `like`.
Eigen::VectorXd tangent_of(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& like);

/// What became of a step.
struct step_result {
    std::optional<curve_point> point;  // none: Newton's method did not converge
    outcome end = outcome::ok;         // why the equation could not be evaluated, if so
    int n_steps = 0;                   // of Newton's method
};

/// The solution in the plane at `length` along a unit direction.
///
/// \param from       any point (a solution, or a guess where length = 0)
/// \param direction  the plane's normal; also orients the new tangent
step_result step_along(const curve_equation& equation, const Eigen::VectorXd& from,
                       const Eigen::VectorXd& direction, double length);

}  // namespace hopscotch
