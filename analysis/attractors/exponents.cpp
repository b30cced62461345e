// Tangent vectors kept orthogonal by a QR factorisation after every return (Benettin et al. 1980).
#include "analysis/attractors/exponents.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace hopscotch {

orbit_exponents exponents_of(const map_point& map, std::span<const double> start,
                             std::span<const int> free, int n_blocks, int block) {
    const auto n = static_cast<Eigen::Index>(free.size());
    orbit_exponents result;
    std::vector<double> x(start.begin(), start.end());
    Eigen::MatrixXd frame = Eigen::MatrixXd::Identity(n, n);
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, n_blocks);
    const int n_transient = n_blocks / 4;
    for (int b = -n_transient; b < n_blocks; ++b) {
        for (int i = 0; i < block; ++i) {
            const return_jet jet = map.jet(x.data());
            if (jet.end != outcome::ok) return result;
            Eigen::MatrixXd derivative(n, n);
            for (Eigen::Index r = 0; r < n; ++r) {
                for (Eigen::Index c = 0; c < n; ++c) {
                    derivative(r, c) = jet.derivative[free[std::size_t(r)]][free[std::size_t(c)]];
                }
            }
            if (!derivative.allFinite()) return result;
            const Eigen::HouseholderQR<Eigen::MatrixXd> factors(derivative * frame);
            frame = factors.householderQ() * Eigen::MatrixXd::Identity(n, n);
            if (b >= 0) {
                sums.col(b) += factors.matrixQR().diagonal().cwiseAbs().array().log().matrix();
            }
            for (std::size_t c = 0; c < x.size(); ++c) x[c] = jet.state[c];
        }
        if (b >= 0) result.visited.insert(result.visited.end(), x.begin(), x.end());
    }
    sums /= static_cast<double>(block);
    result.is_complete = true;
    result.returns = static_cast<double>(n_blocks) * static_cast<double>(block);
    for (Eigen::Index r = 0; r < n; ++r) {
        const double mean = sums.row(r).mean();
        const double variance = (sums.row(r).array() - mean).square().sum() / (n_blocks - 1.0);
        result.mean.push_back(mean);
        result.error.push_back(std::sqrt(variance / n_blocks));
    }
    return result;
}

}  // namespace hopscotch
