#include "analysis/metrics/scaling_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

namespace hopscotch::metrics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct line {
    double slope = 0.0;
    double error = 0.0;
};

using numbers_view = std::span<const double>;

/// Student's factor for a confidence of 68 % with few degrees of freedom.
double student_factor(double n_free) {
    constexpr std::array<double, 6> factors{1.84, 1.32, 1.20, 1.14, 1.11, 1.09};
    const double at = std::clamp(std::floor(n_free) - 1.0, 0.0, 5.0);
    return factors[static_cast<std::size_t>(at)];
}

line straight_line(numbers_view x, numbers_view y) {
    const auto n = static_cast<double>(x.size());
    double mean_x = 0.0;
    double mean_y = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / n;
        mean_y += y[i] / n;
    }
    double xx = 0.0;
    double xy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    const double slope = xy / xx;
    double residuals = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double residual = y[i] - mean_y - slope * (x[i] - mean_x);
        residuals += residual * residual;
    }
    // scales less than a factor of 2 apart see the same structures: octaves count, not points
    const double n_octaves = (x.back() - x.front()) / std::numbers::ln2 + 1.0;
    const double n_free = std::max(std::min(n, n_octaves) - 2.0, 1.0);
    const double variance = residuals / n * std::min(n, n_octaves) / n_free;
    const double spread = xx / n * std::min(n, n_octaves);
    return {slope, student_factor(n_free) * std::sqrt(variance / spread)};
}

/// The line through all scales; none where one of them has no hit.
std::optional<line> line_through(const std::vector<double>& scales,
                                 const std::vector<hit_count>& counts) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t i = 0; i < scales.size(); ++i) {
        if (counts[i].hits == 0) return std::nullopt;
        x.push_back(std::log(scales[i]));
        y.push_back(
            std::log(static_cast<double>(counts[i].hits) / static_cast<double>(counts[i].trials)));
    }
    line whole = straight_line(x, y);
    // a bent curve is no power law: the slopes of its two halves disagree
    const std::size_t half = (x.size() + 1) / 2;
    const line small = straight_line(numbers_view(x).first(half), numbers_view(y).first(half));
    const line large = straight_line(numbers_view(x).last(half), numbers_view(y).last(half));
    whole.error = std::max(whole.error, 0.5 * std::abs(large.slope - small.slope));
    return whole;
}

/// Jackknife error of an estimate whose values without each part are given.
double jackknife_error(const std::vector<double>& left_out) {
    const auto n = static_cast<double>(left_out.size());
    if (left_out.size() < 2) return nan;
    double mean = 0.0;
    for (const double value : left_out) mean += value / n;
    double sum = 0.0;
    for (const double value : left_out) sum += (value - mean) * (value - mean);
    return std::sqrt(sum * (n - 1.0) / n);
}

std::vector<hit_count> summed(const std::vector<std::vector<hit_count>>& parts, std::size_t n) {
    std::vector<hit_count> total(n);
    for (const auto& part : parts) {
        for (std::size_t i = 0; i < n; ++i) {
            total[i].hits += part[i].hits;
            total[i].trials += part[i].trials;
        }
    }
    return total;
}

}  // namespace

double power_law::error() const {
    return std::isnan(sampling_error) ? fit_error : std::hypot(fit_error, sampling_error);
}

power_law fit_power_law(const std::vector<double>& scales,
                        const std::vector<std::vector<hit_count>>& parts) {
    power_law result;
    const std::vector<hit_count> total = summed(parts, scales.size());
    result.scales = scales;
    for (const hit_count& each : total) {
        result.fractions.push_back(each.trials == 0 ? nan
                                                    : static_cast<double>(each.hits) /
                                                          static_cast<double>(each.trials));
    }
    if (scales.size() < 3) {
        result.why = "the map is too small for three scales";
        return result;
    }
    const std::optional<line> fit = line_through(scales, total);
    if (!fit) {
        const bool is_uniform = std::all_of(total.begin(), total.end(),
                                            [](const hit_count& each) { return each.hits == 0; });
        result.why = is_uniform ? "there is no boundary" : "at some scale no boundary is seen";
        return result;
    }
    result.is_defined = true;
    result.exponent = fit->slope;
    result.fit_error = fit->error;
    std::vector<double> left_out;
    for (const auto& part : parts) {
        if (part.empty() || part.front().trials == 0) continue;
        std::vector<hit_count> rest = total;
        for (std::size_t i = 0; i < rest.size(); ++i) {
            rest[i].hits -= part[i].hits;
            rest[i].trials -= part[i].trials;
        }
        const std::optional<line> without = line_through(scales, rest);
        left_out.push_back(without ? without->slope : nan);
    }
    result.sampling_error = jackknife_error(left_out);
    return result;
}

ratio_estimate ratio_over_parts(const std::vector<double>& values,
                                const std::vector<double>& weights) {
    double value = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        value += values[i];
        weight += weights[i];
    }
    if (weight == 0.0) return {0.0, nan};
    std::vector<double> left_out;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (weights[i] > 0.0) left_out.push_back((value - values[i]) / (weight - weights[i]));
    }
    return {value / weight, jackknife_error(left_out)};
}

}  // namespace hopscotch::metrics
