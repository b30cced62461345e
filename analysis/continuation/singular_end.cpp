// Neville's scheme on orbits whose multipliers are well apart.
#include "analysis/continuation/singular_end.hpp"

#include <array>
#include <cmath>

namespace hopscotch {
namespace {

constexpr double least_growth = 1e3;    // of the multiplier: less is no singularity
constexpr double well_apart = 1.5;      // ratio of multipliers that are used together
constexpr double least_multiplier = 3;  // further away nothing is known of the end
constexpr std::size_t most_orbits = 9;
constexpr std::size_t fewest_orbits = 5;
constexpr double accepted = 1e-8;
constexpr std::array exponents{1.0, 2.0 / 3.0, 0.5};
constexpr std::array largest_used{1e2, 3e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

/// The polynomial through (u, y) at u = 0.
double at_zero(std::span<const double> u, std::span<const double> y) {
    std::vector<double> value(y.begin(), y.end());
    for (std::size_t k = 1; k < value.size(); ++k) {
        for (std::size_t i = value.size(); i-- > k;) {
            value[i] = (u[i - k] * value[i] - u[i] * value[i - 1]) / (u[i - k] - u[i]);
        }
    }
    return value.back();
}

/// Orbits with multipliers below a bound, from the end outward.
std::vector<const approach*> chosen(std::span<const approach> way, double largest) {
    std::vector<const approach*> orbits;
    double last = largest * well_apart;
    for (std::size_t i = way.size(); i-- > 0 && orbits.size() < most_orbits;) {
        const double multiplier = std::abs(way[i].multiplier);
        if (multiplier < least_multiplier) break;
        if (!(multiplier <= last / well_apart)) continue;
        orbits.push_back(&way[i]);
        last = multiplier;
    }
    return orbits;
}

struct estimate {
    double value = 0.0;
    double error = 1e300;
};

/// One of the orbits' numbers at the end.
estimate extrapolated(const std::vector<const approach*>& orbits, std::size_t number,
                      double exponent) {
    std::vector<double> u;
    std::vector<double> y;
    for (const approach* orbit : orbits) {
        u.push_back(std::pow(std::abs(orbit->multiplier), -exponent));
        y.push_back(orbit->numbers[number]);
    }
    const std::size_t fewer = u.size() - 1;
    const auto without = [&](std::size_t first) {
        return at_zero(std::span(u).subspan(first, fewer), std::span(y).subspan(first, fewer));
    };
    const double value = at_zero(u, y);
    return {value, std::abs(value - without(0)) + std::abs(value - without(1))};
}

estimate best_estimate(std::span<const approach> way, std::size_t number) {
    estimate best;
    for (const double largest : largest_used) {
        const std::vector<const approach*> orbits = chosen(way, largest);
        if (orbits.size() < fewest_orbits) continue;
        for (const double exponent : exponents) {
            const estimate found = extrapolated(orbits, number, exponent);
            if (found.error < best.error) best = found;
        }
    }
    return best;
}

}  // namespace

std::optional<singular_end> find_singular_end(std::span<const approach> way) {
    if (way.empty() || !(std::abs(way.back().multiplier) > least_growth)) return std::nullopt;
    singular_end end;
    for (std::size_t number = 0; number < way.back().numbers.size(); ++number) {
        const estimate best = best_estimate(way, number);
        if (number == 0 && !(best.error <= accepted * std::abs(best.value))) return std::nullopt;
        end.numbers.push_back(best.value);
        end.errors.push_back(best.error);
    }
    return end;
}

}  // namespace hopscotch
