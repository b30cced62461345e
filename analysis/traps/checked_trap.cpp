// Grows an ellipsoid until a derivative somewhere in it no longer contracts.
#include "analysis/traps/checked_trap.hpp"

#include "analysis/traps/contracting_norm.hpp"

#include <cmath>
#include <vector>

namespace hopscotch {
namespace {

/// Directions on the unit sphere: the axes, the corners, and a fixed spread of others.
std::vector<Eigen::VectorXd> directions(Eigen::Index n) {
    std::vector<Eigen::VectorXd> result;
    for (Eigen::Index i = 0; i < n; ++i) {
        result.push_back(Eigen::VectorXd::Unit(n, i));
        result.push_back(-Eigen::VectorXd::Unit(n, i));
    }
    if (n == 1) return result;
    for (unsigned corner = 0; corner < (1u << n); ++corner) {
        Eigen::VectorXd v(n);
        for (Eigen::Index i = 0; i < n; ++i) v(i) = (corner >> i & 1u) != 0 ? 1.0 : -1.0;
        result.push_back(v.normalized());
    }
    const auto n_spread = 12 * n;
    for (Eigen::Index k = 1; k <= n_spread; ++k) {
        Eigen::VectorXd v(n);
        for (Eigen::Index i = 0; i < n; ++i) {  // irrational turns: no two directions coincide
            const auto turn = static_cast<double>(k * (i + 1)) * std::sqrt(2.0 + double(i));
            v(i) = std::cos(2.0 * M_PI * turn);
        }
        if (v.norm() > 1e-3) result.push_back(v.normalized());
    }
    return result;
}

class contraction_check {
public:
    contraction_check(const map_point& map, const trap_site& site, const Eigen::MatrixXd& norm,
                      const free_derivative& centre)
        : map_(map),
          site_(site),
          norm_(norm),
          inverse_(norm.inverse()),
          events_(centre.events),
          limit_(0.25 * (3.0 + two_norm(norm * centre.matrix * inverse_))),
          directions_(directions(norm.rows())) {}

    /// Every point of the design in |norm offset| <= size contracts.
    bool holds(double size) const {
        for (const double share : {1.0, 0.6, 0.3}) {
            for (const Eigen::VectorXd& direction : directions_) {
                if (!holds_at(inverse_ * direction * (share * size), size)) return false;
            }
        }
        return true;
    }

private:
    bool holds_at(const Eigen::VectorXd& offset, double size) const {
        const auto at = derivative_at(map_, site_, offset);
        if (!at || at->events != events_) return false;
        if (!(two_norm(norm_ * at->matrix * inverse_) <= limit_)) return false;
        Eigen::VectorXd moved = at->image;
        for (Eigen::Index i = 0; i < moved.size(); ++i) {
            moved(i) -= site_.centre[static_cast<std::size_t>(site_.free[std::size_t(i)])];
        }
        return (norm_ * moved).norm() <= limit_ * size;
    }

    const map_point& map_;
    const trap_site& site_;
    const Eigen::MatrixXd& norm_;
    Eigen::MatrixXd inverse_;
    std::uint64_t events_;
    double limit_;  // of the contraction: three quarters of the way from the centre's own to 1
    std::vector<Eigen::VectorXd> directions_;
};

}  // namespace

std::optional<free_derivative> derivative_at(const map_point& map, const trap_site& site,
                                             const Eigen::VectorXd& offset) {
    std::vector<double> x(site.centre.begin(), site.centre.end());
    const auto n = static_cast<Eigen::Index>(site.free.size());
    for (Eigen::Index i = 0; i < n; ++i) {
        x[static_cast<std::size_t>(site.free[std::size_t(i)])] += offset(i);
    }
    const return_jet jet = map.jet(x.data(), static_cast<std::uint32_t>(site.period));
    if (jet.end != outcome::ok) return std::nullopt;
    free_derivative result{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), jet.events};
    for (Eigen::Index i = 0; i < n; ++i) {
        const int row = site.free[std::size_t(i)];
        result.image(i) = jet.state[row];
        for (Eigen::Index j = 0; j < n; ++j) {
            result.matrix(i, j) = jet.derivative[row][site.free[std::size_t(j)]];
        }
    }
    if (!result.matrix.allFinite() || !result.image.allFinite()) return std::nullopt;
    return result;
}

trap_ellipsoid ellipsoid_of(const trap_site& site, const Eigen::MatrixXd& norm) {
    trap_ellipsoid trap{};
    const auto n = static_cast<int>(site.centre.size());
    trap.n_columns = n;
    for (int c = 0; c < n; ++c) trap.centre[c] = site.centre[static_cast<std::size_t>(c)];
    for (std::size_t i = 0; i < site.free.size(); ++i) {
        for (std::size_t j = 0; j < site.free.size(); ++j) {
            trap.shape[site.free[i] * n + site.free[j]] =
                norm(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        }
    }
    return trap;
}

std::optional<trap_ellipsoid> checked_trap(const map_point& map, const trap_site& site,
                                           bool is_quick) {
    const auto n = static_cast<Eigen::Index>(site.free.size());
    const auto centre = derivative_at(map, site, Eigen::VectorXd::Zero(n));
    if (!centre || !(spectral_radius(centre->matrix) < 1.0)) return std::nullopt;
    const Eigen::MatrixXd norm = contracting_norm(centre->matrix, site.scale);
    if (!norm.allFinite()) return std::nullopt;
    const contraction_check check(map, site, norm, *centre);
    constexpr double smallest = 1e-9;
    double passes = 1.0 / 64.0;
    double fails = 0.0;
    while (!check.holds(passes)) {
        fails = passes;
        passes *= 0.25;
        if (passes < smallest) return std::nullopt;
    }
    while (!is_quick && fails == 0.0 && passes < 1e6) {
        if (check.holds(2.0 * passes)) {
            passes *= 2.0;
        } else {
            fails = 2.0 * passes;
        }
    }
    for (int i = 0; i < 4 && fails > 0.0 && !is_quick; ++i) {
        const double middle = 0.5 * (passes + fails);
        (check.holds(middle) ? passes : fails) = middle;
    }
    return ellipsoid_of(site, norm / (passes * 2.0 / 3.0));
}

}  // namespace hopscotch
