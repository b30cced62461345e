// Multipliers of a periodic orbit: the eigenvalues of its return map's derivative, in one order.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace hopscotch {

/// Multipliers of DP^period, largest modulus first.
std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative);

}  // namespace hopscotch
