// Solves the discrete Lyapunov equation by doubling.
#include "analysis/traps/contracting_norm.hpp"

#include <cmath>
#include <limits>

namespace hopscotch {

Eigen::MatrixXd contracting_norm(const Eigen::MatrixXd& multipliers, const Eigen::VectorXd& scale) {
    const double rate = 0.5 * (1.0 + spectral_radius(multipliers));
    Eigen::MatrixXd form = scale.cwiseInverse().cwiseAbs2().asDiagonal();
    Eigen::MatrixXd power = multipliers / rate;
    constexpr int n_doublings = 60;  // 2^60 terms
    for (int i = 0; i < n_doublings && power.norm() > 1e-30; ++i) {
        form += power.transpose() * form * power;
        power *= power;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(form);
    if (factor.info() != Eigen::Success) {
        return Eigen::MatrixXd::Constant(form.rows(), form.cols(),
                                         std::numeric_limits<double>::quiet_NaN());
    }
    return factor.matrixU();
}

double spectral_radius(const Eigen::MatrixXd& matrix) {
    return matrix.eigenvalues().cwiseAbs().maxCoeff();
}

double two_norm(const Eigen::MatrixXd& matrix) { return matrix.jacobiSvd().singularValues()(0); }

}  // namespace hopscotch
