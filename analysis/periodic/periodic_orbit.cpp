// Damped Newton's method on P^period(x) = x, minimal period and multipliers.
#include "analysis/periodic/periodic_orbit.hpp"

#include "analysis/periodic/multipliers.hpp"
#include "analysis/periodic/return_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>
#include <Eigen/SVD>

namespace hopscotch {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

std::vector<double> scale_of(std::span<const double> guess, const newton_limits& limits) {
    if (!limits.scale.empty()) return limits.scale;
    std::vector<double> scale;
    for (const double x : guess) scale.push_back(x == 0.0 ? 1.0 : std::abs(x));
    return scale;
}

std::vector<int> free_columns_of(const map_point& map, std::span<const double> guess,
                                 const newton_limits& limits) {
    if (!limits.free_columns.empty()) return limits.free_columns;
    const std::vector<int> conserved = conserved_columns(map, guess);
    std::vector<int> columns;
    for (int c = 0; c < map.n_columns(); ++c) {
        if (std::find(conserved.begin(), conserved.end(), c) == conserved.end())
            columns.push_back(c);
    }
    return columns;
}

/// One search: the equation in scaled unknowns.
class newton {
public:
    newton(const map_point& map, int period, std::vector<int> columns, std::vector<double> scale)
        : map_(map), period_(period), columns_(std::move(columns)) {
        scale_.resize(static_cast<Eigen::Index>(columns_.size()));
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            scale_[static_cast<Eigen::Index>(i)] = scale[static_cast<std::size_t>(columns_[i])];
        }
    }

    /// Moves x to a root; the value there, or a failed one.
    return_value solve(std::vector<double>& x, int most_steps) const {
        return_value here = evaluate(x);
        for (int step = 0; here.is_ok() && step < most_steps; ++step) {
            if (norm(here) == 0.0 || !improve(x, here)) break;
        }
        return here;
    }

    double norm(const return_value& value) const {
        return value.gap.cwiseQuotient(scale_).cwiseAbs().maxCoeff();
    }

    /// Smallest singular value of DP^period - 1 in the scale.
    double smallest_singular_value(const return_value& value) const {
        return Eigen::JacobiSVD<Eigen::MatrixXd>(system(value)).singularValues().minCoeff();
    }

    const std::vector<int>& columns() const { return columns_; }

private:
    const map_point& map_;
    int period_;
    std::vector<int> columns_;
    Eigen::VectorXd scale_;

    return_value evaluate(const std::vector<double>& x) const {
        return evaluate_return(map_, x, period_, columns_);
    }

    Eigen::MatrixXd system(const return_value& value) const {
        Eigen::MatrixXd matrix =
            value.derivative - Eigen::MatrixXd::Identity(scale_.size(), scale_.size());
        return scale_.cwiseInverse().asDiagonal() * matrix * scale_.asDiagonal();
    }

    /// One damped step; false where none lessens the gap.
    bool improve(std::vector<double>& x, return_value& here) const {
        constexpr double singular = 1e-12;  // of an invariant: least-norm steps then
        constexpr int most_halvings = 8;
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
        solver.setThreshold(singular);
        solver.compute(system(here));
        const Eigen::VectorXd step =
            solver.solve(-here.gap.cwiseQuotient(scale_)).cwiseProduct(scale_);
        double share = 1.0;
        for (int i = 0; i <= most_halvings; ++i, share *= 0.5) {
            std::vector<double> moved = x;
            for (Eigen::Index c = 0; c < step.size(); ++c) {
                moved[static_cast<std::size_t>(columns_[static_cast<std::size_t>(c)])] +=
                    share * step[c];
            }
            return_value there = evaluate(moved);
            if (!there.is_ok() || !(norm(there) < norm(here))) continue;
            x = std::move(moved);
            here = std::move(there);
            return true;
        }
        return false;
    }
};

/// Whether the orbit already closes after some proper divisor of its period.
bool has_smaller_period(const map_point& map, const periodic_orbit& orbit,
                        std::span<const double> scale, double uncertainty) {
    for (int divisor = 1; divisor < orbit.period; ++divisor) {
        if (orbit.period % divisor != 0) continue;
        if (distance_of(map, orbit.point(0), orbit.point(divisor), scale) <= uncertainty)
            return true;
    }
    return false;
}

}  // namespace

double distance_of(const map_point& map, std::span<const double> a, std::span<const double> b,
                   std::span<const double> scale) {
    double distance = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c) {
        double apart = b[c] - a[c];
        if (const double turn = turn_of(map, static_cast<int>(c)); turn > 0.0) {
            apart -= turn * std::nearbyint(apart / turn);
        }
        distance = std::max(distance, std::abs(apart) / scale[c]);
    }
    return distance;
}

std::vector<std::complex<double>> multipliers_at(const map_point& map, std::span<const double> x,
                                                 int period, std::span<const int> columns) {
    const return_value value = evaluate_return(map, x, period, columns);
    if (!value.is_ok()) return {};
    return multipliers_of(value.derivative);
}

std::optional<periodic_orbit> refine_periodic_orbit(const map_point& map,
                                                    std::span<const double> guess, int period,
                                                    const newton_limits& limits) {
    constexpr double least_apart = 1e-8;  // closer points of one orbit are not told apart
    constexpr double safety = 1e3;
    const std::vector<double> scale = scale_of(guess, limits);
    const newton search(map, period, free_columns_of(map, guess, limits), scale);
    if (search.columns().empty()) return std::nullopt;
    std::vector<double> x(guess.begin(), guess.end());
    const return_value value = search.solve(x, limits.most_steps);
    if (!value.is_ok() || !(search.norm(value) <= limits.residual)) return std::nullopt;

    wrap_phases(map, x);
    periodic_orbit orbit{.period = period, .n_columns = map.n_columns()};
    orbit.residual = search.norm(value);
    orbit.multipliers = multipliers_of(value.derivative);
    orbit.points = x;
    for (int i = 1; i < period; ++i) {
        const return_jet next = map.jet(x.data(), static_cast<std::uint32_t>(i));
        if (next.end != outcome::ok) return std::nullopt;
        orbit.points.insert(orbit.points.end(), next.state, next.state + map.n_columns());
    }
    // below 1e-8 a singular value may be an invariant's
    const double hardness = std::max(search.smallest_singular_value(value), 1e-8);
    const double uncertainty =
        std::max(least_apart, safety * (rounding + orbit.residual) / hardness);
    if (has_smaller_period(map, orbit, scale, uncertainty)) return std::nullopt;
    return orbit;
}

}  // namespace hopscotch
