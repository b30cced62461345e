// Periodic orbits of a return map, polished by Newton's method with exact derivatives. Used by the
// search for attractors and by the continuation of branches.
#pragma once

#include "analysis/periodic/map_point.hpp"

#include <complex>
#include <optional>
#include <span>
#include <vector>

namespace hopscotch {

struct periodic_orbit {
    int period = 1;
    int n_columns = 1;
    std::vector<double> points;                     // [point][column], in the order of visits
    std::vector<std::complex<double>> multipliers;  // over the free columns, largest modulus first
    double residual = 0.0;  // largest |P^period(x) - x| over the free columns, in their scale

    std::span<const double> point(int i) const {
        const auto n = static_cast<std::size_t>(n_columns);
        return std::span(points).subspan(static_cast<std::size_t>(i) * n, n);
    }
    bool is_stable() const { return multipliers.empty() || std::abs(multipliers[0]) < 1.0; }
};

struct newton_limits {
    std::vector<int> free_columns;  // empty: every column that the map does not conserve
    std::vector<double> scale;      // of every column; empty: the guess's own size
    int most_steps = 40;
    double residual = 1e-10;  // in the scale; Newton goes on to rounding level all the same
};

/// Newton's method on P^period(x) - x, damped.
///
/// \param guess  one number per column of the section
/// \return       none where it does not converge, the orbit fails on the way, or the point found
///               has a smaller period: a proper divisor d counts as one where P^d(x) is as close to
///               x as the orbit's own uncertainty (its residual over the smallest singular value of
///               DP^period - 1) allows to tell. A multiplier near -1 so never passes as period 2.
///
/// Phases are compared to the nearest turn. Where the map has invariants that are no columns (the
/// energy of a pitching runner), the orbit closest to the guess is found.
std::optional<periodic_orbit> refine_periodic_orbit(const map_point& map,
                                                    std::span<const double> guess, int period,
                                                    const newton_limits& limits = {});

/// Multipliers of P^period at a periodic point x over some of the columns, largest modulus first.
std::vector<std::complex<double>> multipliers_at(const map_point& map, std::span<const double> x,
                                                 int period, std::span<const int> columns);

/// Largest distance of two states, column by column in its scale, phases to the nearest turn.
double distance_of(const map_point& map, std::span<const double> a, std::span<const double> b,
                   std::span<const double> scale);

}  // namespace hopscotch
