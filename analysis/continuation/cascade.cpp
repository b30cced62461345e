// Extrapolation of period-doubling cascades.
#include "analysis/continuation/cascade.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

constexpr double feigenbaum = 4.669201609102990672;

/// The flip of `parent` at which `child` begins.
double birth_of(const branch& child) { return child.orbits.front().variable; }

}  // namespace

std::optional<accumulation> accumulation_of(const std::vector<double>& flips) {
    if (flips.size() < 4) return std::nullopt;
    std::vector<double> guesses;
    for (std::size_t k = 1; k < flips.size(); ++k) {
        guesses.push_back(flips[k] + (flips[k] - flips[k - 1]) / (feigenbaum - 1.0));
    }
    const std::size_t last = guesses.size() - 1;
    const double before = guesses[last - 1] - guesses[last - 2];
    const double after = guesses[last] - guesses[last - 1];
    const double correction = after * after / (before - after);
    accumulation result{.flips = flips};
    result.limit = guesses[last] + correction;
    result.error = std::max(std::abs(correction), 0.1 * std::abs(after));
    result.ratio = (flips[last] - flips[last - 1]) / (flips[last + 1] - flips[last]);
    return result;
}

std::vector<accumulation> cascades_of(const std::vector<branch>& branches) {
    std::vector<accumulation> found;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        bool has_child = false;
        for (const branch& other : branches) has_child |= other.parent == static_cast<int>(b);
        if (has_child || branches[b].parent < 0) continue;
        std::vector<double> flips;
        for (int i = static_cast<int>(b); branches[static_cast<std::size_t>(i)].parent >= 0;
             i = branches[static_cast<std::size_t>(i)].parent) {
            flips.insert(flips.begin(), birth_of(branches[static_cast<std::size_t>(i)]));
        }
        for (const special_point& special : branches[b].special) {
            if (special.kind != special_kind::flip) continue;
            flips.push_back(special.orbit.variable);
            break;
        }
        if (const auto limit = accumulation_of(flips)) found.push_back(*limit);
    }
    return found;
}

}  // namespace hopscotch
