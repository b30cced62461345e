// Finds invariant intervals by sign changes on refined samples and bisection to the last bit.
#include "analysis/labels/interval_trap.hpp"

#include "analysis/labels/sampling.hpp"
#include "analysis/traps/proved_interval.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr int n_transient = 20000;
constexpr int longest_period = 64;
constexpr double periodic_distance = 1e-9;  // relative, with every proper divisor clearly away

/// The unstable fixed point left of the base, where added energy has put it; the base itself
/// without.
std::optional<double> lower_end(const return_map_samples& map, const map_branch& branch,
                                double floor) {
    if (branch.base == 0.0) {  // the resting state itself is no hop; the smallest hops decide
        constexpr double smallest = 1e-9;
        return map.at(smallest) > smallest ? std::optional(0.0) : std::nullopt;
    }
    const double gain = map.at(branch.base) - branch.base;
    if (std::isnan(gain)) return std::nullopt;
    // next to a semi-stable base the map falls short of the identity by rounding only
    if (std::abs(gain) <= 4e-15 * branch.base) return branch.base;
    if (gain < 0.0) return std::nullopt;
    const auto rises = [&](double x) { return map.at(x) > x; };
    const std::vector<double> left = points_towards(branch.base, floor);
    const std::vector<double> images = map.at(left);
    double inside = branch.base;
    for (std::size_t i = 0; i < left.size(); ++i) {
        if (!(images[i] > left[i])) return last_inside(inside, left[i], rises);
        inside = left[i];
    }
    return std::nullopt;
}

double slope_at(const return_map_samples& map, double x, int returns) {
    const double h = 1e-6 * std::max(1.0, std::abs(x));
    const auto count = static_cast<std::uint32_t>(returns);
    return (map.at(x + h, count) - map.at(x - h, count)) / (2.0 * h);
}

}  // namespace

std::string interval_trap::evidence() const {
    if (!is_proved) return "sampled and bisected";
    if (unproved_length == 0.0) return "proved by enclosures";
    return fmt::format("proved by enclosures, but for a length of {:.1g} where events change order",
                       unproved_length);
}

void prove(const map_point& map, interval_trap& trap) {
    const auto proved = prove_interval_trap(map, trap.lowest, trap.highest);
    if (!proved) return;
    trap.lowest = proved->lowest;
    trap.highest = proved->highest;
    trap.is_proved = true;
    trap.unproved_length = proved->uncovered;
}

void identify_attractor(const return_map_samples& map, double start, interval_trap& trap) {
    double x = map.at(start, n_transient);
    std::vector<double> orbit{x};
    for (int i = 0; i < 4 * longest_period; ++i) orbit.push_back(map.at(orbit.back()));
    for (int p = 1; p <= longest_period; ++p) {
        double distance = 0.0;
        for (int i = 0; i < 2 * longest_period; ++i) {
            distance = std::max(distance, std::abs(orbit[static_cast<std::size_t>(i + p)] -
                                                   orbit[static_cast<std::size_t>(i)]));
        }
        if (distance > periodic_distance * std::abs(x)) continue;
        trap.period = p;
        trap.kind = p == 1 ? attractor_kind::fixed_point : attractor_kind::cycle;
        trap.points.assign(orbit.begin(), orbit.begin() + p);
        std::sort(trap.points.begin(), trap.points.end());
        trap.multiplier = slope_at(map, trap.points.front(), p);
        return;
    }
    trap.period = 0;
    trap.kind = attractor_kind::chaotic;
    const auto [low, high] = std::minmax_element(orbit.begin(), orbit.end());
    trap.points = {*low, *high};
    double sum = 0.0;
    for (const double point : orbit) sum += std::log(std::abs(slope_at(map, point, 1)));
    trap.multiplier = sum / static_cast<double>(orbit.size());
}

std::optional<interval_trap> find_interval_trap(const return_map_samples& map,
                                                const map_branch& branch, double floor) {
    const std::optional<double> lowest = lower_end(map, branch, floor);
    if (!lowest) return std::nullopt;
    const auto stays = [&](double x) { return map.at(x) >= *lowest; };
    const std::vector<double> right = points_towards(branch.base, branch.end);
    const std::vector<double> images = map.at(right);
    double highest = branch.base;
    double top = *lowest;
    double top_at = right.front();
    for (std::size_t i = 0; i < right.size(); ++i) {
        if (!(images[i] >= *lowest)) {
            highest = last_inside(highest, right[i], stays);
            break;
        }
        highest = right[i];
        if (images[i] > top) {
            top = images[i];
            top_at = right[i];
        }
    }
    if (!(highest > branch.base) || top > highest) return std::nullopt;
    interval_trap trap{*lowest, highest, attractor_kind::fixed_point, 1, {*lowest}, 1.0};
    if (*lowest < branch.base || branch.base == 0.0) identify_attractor(map, top_at, trap);
    return trap;
}

}  // namespace hopscotch
