// Shapes from the multiplier matrix, sizes by proof and bisection.
#include "analysis/traps/proved_trap.hpp"

#include "analysis/traps/contracting_norm.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace hopscotch {
namespace {

constexpr double smallest_size = 1e-9;
constexpr double largest_size = 1e6;
constexpr double largest_condition = 1e6;  // of an eigenbasis that is used as it is
constexpr double size_precision = 1.05;    // sizes are found to this factor

/// Rows that turn a displacement into coordinates in which the multiplier nearly is its spectral
/// radius; rows that belong together (a complex pair) share a group.
struct shape_basis {
    Eigen::MatrixXd rows;
    std::vector<int> group;
};

/// Real and imaginary parts of eigenvectors as columns, or nothing where they are nearly dependent.
std::optional<shape_basis> eigenbasis(const Eigen::EigenSolver<Eigen::MatrixXd>& solver) {
    const Eigen::Index n = solver.eigenvalues().size();
    Eigen::MatrixXd vectors(n, n);
    shape_basis basis;
    int group = 0;
    for (Eigen::Index i = 0; i < n; ++i, ++group) {
        const Eigen::VectorXcd v = solver.eigenvectors().col(i);
        vectors.col(i) = v.real();
        basis.group.push_back(group);
        if (solver.eigenvalues()(i).imag() == 0.0) continue;
        if (++i == n) return std::nullopt;
        vectors.col(i) = v.imag();
        basis.group.push_back(group);
    }
    basis.rows = vectors.inverse();
    if (!(vectors.norm() * basis.rows.norm() < largest_condition)) return std::nullopt;
    return basis;
}

/// The norm of Stein's equation, for multipliers without a good eigenbasis.
std::optional<shape_basis> lyapunov_basis(const Eigen::MatrixXd& multiplier) {
    const Eigen::Index n = multiplier.rows();
    shape_basis basis{contracting_norm(multiplier, Eigen::VectorXd::Ones(n)), {}};
    if (!basis.rows.allFinite()) return std::nullopt;
    for (int i = 0; i < n; ++i) basis.group.push_back(i);
    return basis;
}

class searcher {
public:
    searcher(const stable_point& at, const trap_search& search) : at_(at), search_(search) {
        for (std::size_t i = 0; i < at.point.size(); ++i) {
            if (at.is_fixed.empty() || !at.is_fixed[i]) free_.push_back(static_cast<int>(i));
        }
        query_.section = at.map->section;
        query_.options = at.map->options.data();
        query_.variant = at.map->variant;
        query_.parameters = at.map->parameters;
        query_.returns = at.period;
        query_.most_pieces = search.most_pieces;
        query_.trap.n_columns = static_cast<std::int32_t>(at.point.size());
        std::copy(at.point.begin(), at.point.end(), query_.trap.centre);
    }

    std::optional<proved_trap> run() {
        const Eigen::MatrixXd multiplier = multiplier_of_free();
        const Eigen::Index n = multiplier.rows();
        why = contraction_verdict::not_contracting;
        if (n == 0 || !multiplier.allFinite()) return std::nullopt;
        const Eigen::EigenSolver<Eigen::MatrixXd> solver(multiplier);
        if (solver.info() != Eigen::Success) return std::nullopt;
        const double radius = solver.eigenvalues().cwiseAbs().maxCoeff();
        if (!(radius < 1.0)) return std::nullopt;
        auto basis = eigenbasis(solver);
        if (!basis) basis = lyapunov_basis(multiplier);
        if (!basis) return std::nullopt;
        basis_ = *basis;
        normalise();
        stretch_.assign(free_.size(), 1.0);
        if (!find_size()) return std::nullopt;
        reshape();
        return best_;
    }

    contraction_verdict why = contraction_verdict::not_contracting;

private:
    const stable_point& at_;
    const trap_search& search_;
    std::vector<int> free_;
    contraction_query query_;
    shape_basis basis_;
    std::vector<double> stretch_;  // of the semi-axes
    double size_ = 0.0;            // of the largest proved one
    std::optional<proved_trap> best_;

    Eigen::MatrixXd multiplier_of_free() const {
        const auto n = static_cast<Eigen::Index>(free_.size());
        Eigen::MatrixXd m(n, n);
        return_jet jet;
        if (at_.multiplier.empty())
            jet = at_.map->jet(at_.point.data(), static_cast<std::uint32_t>(at_.period));
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) {
                const auto row = static_cast<std::size_t>(free_[static_cast<std::size_t>(i)]);
                const auto column = static_cast<std::size_t>(free_[static_cast<std::size_t>(j)]);
                m(i, j) = at_.multiplier.empty() ? jet.derivative[row][column]
                                                 : at_.multiplier[row * at_.point.size() + column];
            }
        }
        return m;
    }

    /// Coordinates in which an axis of length 1 moves some column by the point's largest one.
    void normalise() {
        double scale = 0.0;
        for (const int column : free_)
            scale = std::max(scale, std::abs(at_.point[static_cast<std::size_t>(column)]));
        if (!(scale > 0.0)) scale = 1.0;
        const Eigen::MatrixXd axes = basis_.rows.inverse();
        for (Eigen::Index i = 0; i < basis_.rows.rows(); ++i) {
            double longest = axes.col(i).cwiseAbs().maxCoeff();
            for (Eigen::Index k = 0; k < basis_.rows.rows(); ++k) {
                if (basis_.group[static_cast<std::size_t>(k)] ==
                    basis_.group[static_cast<std::size_t>(i)])
                    longest = std::max(longest, axes.col(k).cwiseAbs().maxCoeff());
            }
            basis_.rows.row(i) *= longest / scale;
        }
    }

    /// Asks for a proof with semi-axes size * stretch; keeps it when it is the largest so far.
    bool is_proved(double size, const std::vector<double>& stretch) {
        trap_ellipsoid& trap = query_.trap;
        std::fill(std::begin(trap.shape), std::end(trap.shape), 0.0);
        double volume = 1.0;
        const std::size_t n = at_.point.size();
        for (std::size_t i = 0; i < free_.size(); ++i) {
            const double factor = 1.0 / (size * stretch[i]);
            for (std::size_t j = 0; j < free_.size(); ++j) {
                trap.shape[static_cast<std::size_t>(free_[i]) * n +
                           static_cast<std::size_t>(free_[j])] =
                    factor *
                    basis_.rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            }
            volume /= factor;
        }
        volume /= std::abs(basis_.rows.determinant());
        const contraction_bound bound = prove_contraction(at_.map->model->orbits(), query_);
        if (bound.verdict != contraction_verdict::proved) {
            why = bound.verdict;
            return false;
        }
        if (!best_ || volume > best_->volume) best_ = proved_trap{trap, bound, volume};
        return true;
    }

    /// The largest size with the present stretches, to size_precision.
    bool find_size() {
        double proved = 0.0;
        double refused = unbounded;
        for (double size = search_.first_size; proved == 0.0; size *= 0.1) {
            if (size < smallest_size) return false;
            if (is_proved(size, stretch_)) proved = size;
            if (proved == 0.0) refused = size;
            if (why == contraction_verdict::not_supported) return false;
        }
        while (refused == unbounded && proved < largest_size) {
            const double size = 4.0 * proved;
            (is_proved(size, stretch_) ? proved : refused) = size;
        }
        while (refused > size_precision * proved) {
            const double middle = std::sqrt(refused * proved);
            (is_proved(middle, stretch_) ? proved : refused) = middle;
        }
        size_ = proved;
        return true;
    }

    /// Coordinate search over the axes' lengths: one longer at the others' present size, as long as
    /// that is still proved; then all of them together.
    void reshape() {
        if (free_.size() < 2) return;
        for (int round = 0; round < search_.most_reshapings; ++round) {
            const double before = best_->volume;
            for (int group = 0; group <= basis_.group.back(); ++group) {
                for (const double factor : {2.0, 1.2}) {
                    while (grow(group, factor)) {
                    }
                }
            }
            if (best_->volume < 1.3 * before) {
                if (!trade()) break;
            }
        }
    }

    bool grow(int group, double factor) {
        std::vector<double> longer = stretch_;
        for (std::size_t i = 0; i < longer.size(); ++i) {
            if (basis_.group[i] == group) longer[i] *= factor;
        }
        if (!(longer[0] < 1e9) || !is_proved(size_, longer)) return false;
        stretch_ = longer;
        return true;
    }

    /// Shortens all axes by a third and tries whether one alone may then grow by more.
    bool trade() {
        const double old_size = size_;
        const double old_volume = best_->volume;
        const std::vector<double> old_stretch = stretch_;
        for (int group = 0; group <= basis_.group.back(); ++group) {
            size_ = old_size / 1.5;
            stretch_ = old_stretch;
            while (grow(group, 1.5)) {
            }
            if (best_->volume > 1.05 * old_volume) return true;
        }
        size_ = old_size;
        stretch_ = old_stretch;
        return false;
    }
};

}  // namespace

std::optional<proved_trap> largest_trap(const stable_point& at, contraction_verdict* why,
                                        const trap_search& search) {
    searcher finder(at, search);
    auto found = finder.run();
    if (why != nullptr) *why = found ? contraction_verdict::proved : finder.why;
    return found;
}

}  // namespace hopscotch
