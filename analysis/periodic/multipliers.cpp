// Eigenvalues, sorted.
#include "analysis/periodic/multipliers.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace hopscotch {

std::vector<std::complex<double>> multipliers_of(const Eigen::MatrixXd& derivative) {
    std::vector<std::complex<double>> multipliers;
    if (derivative.size() == 0) return multipliers;
    const Eigen::VectorXcd values =
        Eigen::EigenSolver<Eigen::MatrixXd>(derivative, false).eigenvalues();
    multipliers.assign(values.begin(), values.end());
    std::sort(multipliers.begin(), multipliers.end(), [](const auto& a, const auto& b) {
        if (std::abs(a) != std::abs(b)) return std::abs(a) > std::abs(b);
        return a.imag() > b.imag();
    });
    return multipliers;
}

}  // namespace hopscotch
