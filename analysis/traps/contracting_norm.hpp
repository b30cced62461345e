// The norm in which a stable periodic orbit attracts: a linear change of coordinates in which the
// multiplier matrix itself shrinks every vector, however far from normal it is.
#pragma once

#include <Eigen/Dense>

namespace hopscotch {

/// A with |A M A^-1|_2 <= (1 + rho) / 2, rho < 1 the spectral radius of M.
///
/// \param multipliers  M = DP^p at the periodic point, n x n
/// \param scale        typical size of every column, > 0: A is near diag(1 / scale) for small M
/// \return  upper triangular A with A^T A = sum over k of (M^T)^k D^2 M^k / rate^(2 k), D = diag(1
/// /
///          scale), the discrete Lyapunov equation's solution
/// \error   rho >= 1 gives a matrix that is not finite
Eigen::MatrixXd contracting_norm(const Eigen::MatrixXd& multipliers, const Eigen::VectorXd& scale);

/// Largest absolute eigenvalue.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// Largest singular value.
double two_norm(const Eigen::MatrixXd& matrix);

}  // namespace hopscotch
