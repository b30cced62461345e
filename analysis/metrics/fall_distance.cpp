#include "analysis/metrics/fall_distance.hpp"

#include "analysis/metrics/distance.hpp"

#include <limits>

namespace hopscotch::metrics {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Counts of squared distances in bins of 0.1 % of the distance, per class.
class log_histogram {
public:
    log_histogram(std::size_t n_classes, double shortest, double longest)
        : log_shortest_(std::log(shortest * shortest)),
          n_bins_(static_cast<std::size_t>((std::log(longest * longest) - log_shortest_) / width) +
                  2),
          counts_(n_classes * n_bins_, 0),
          shortest_(n_classes, std::numeric_limits<double>::infinity()) {}

    void add(std::size_t k, double squared) {
        const double bin = (std::log(squared) - log_shortest_) / width + 0.5;
        const auto at = static_cast<std::size_t>(std::max(bin, 0.0));
        ++counts_[k * n_bins_ + std::min(at, n_bins_ - 1)];
        shortest_[k] = std::min(shortest_[k], squared);
    }

    void add(const log_histogram& other) {
        for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
        for (std::size_t k = 0; k < shortest_.size(); ++k) {
            shortest_[k] = std::min(shortest_[k], other.shortest_[k]);
        }
    }

    distance_summary of(std::size_t k) const {
        std::uint64_t n = 0;
        for (std::size_t i = 0; i < n_bins_; ++i) n += counts_[k * n_bins_ + i];
        if (n == 0) return {nan, nan};
        std::uint64_t below = 0;
        std::size_t bin = 0;
        while (2 * (below + counts_[k * n_bins_ + bin]) < n) below += counts_[k * n_bins_ + bin++];
        const double median = log_shortest_ + width * static_cast<double>(bin);
        return {std::sqrt(shortest_[k]), std::exp(0.5 * median)};
    }

private:
    static constexpr double width = 2e-3;  // of the squared distance's logarithm
    double log_shortest_;
    std::size_t n_bins_;
    std::vector<std::uint64_t> counts_;
    std::vector<double> shortest_;
};

/// The shortest step of any axis, and the map's diagonal.
std::pair<double, double> range_of(const class_grid& grid, length_unit unit) {
    double shortest = std::numeric_limits<double>::infinity();
    double diagonal = 0.0;
    for (const axis& each : grid.axes) {
        const std::vector<double> x = positions_of(each, unit);
        for (std::size_t i = 1; i < x.size(); ++i) shortest = std::min(shortest, x[i] - x[i - 1]);
        diagonal = std::hypot(diagonal, x.back() - x.front());
    }
    return {shortest, diagonal};
}

}  // namespace

fall_distances distances_to_falls(const class_grid& grid, length_unit unit) {
    fall_distances result;
    std::array<std::uint8_t, 256> is_fall{};
    bool has_falls = false;
    for (std::size_t k = 0; k < grid.classes.size(); ++k) {
        is_fall[k] = grid.classes[k].is_fall ? 1 : 0;
        has_falls = has_falls || grid.classes[k].is_fall;
    }
    if (!has_falls) {
        result.why = "no cell fails";
        return result;
    }
    result.is_defined = true;
    const std::uint64_t size = grid.cells.size() / grid.axes.front().size();
    const distance_transform distances(grid, unit,
                                       [&](std::uint64_t i, std::span<std::uint8_t> marks) {
                                           for (std::uint64_t j = 0; j < size; ++j)
                                               marks[j] = is_fall[grid.cells[i * size + j]];
                                       });
    const auto [shortest, diagonal] = range_of(grid, unit);
    log_histogram total(grid.classes.size(), shortest, diagonal);
#pragma omp parallel
    {
        log_histogram own(grid.classes.size(), shortest, diagonal);
        std::vector<double> squared(size);
#pragma omp for schedule(dynamic)
        for (std::uint64_t i = 0; i < distances.n_slabs(); ++i) {
            distances.squared(i, squared);
            for (std::uint64_t j = 0; j < size; ++j) {
                const class_index k = grid.cells[i * size + j];
                if (k != no_class && is_fall[k] == 0) own.add(k, squared[j]);
            }
        }
#pragma omp critical
        total.add(own);
    }
    for (std::size_t k = 0; k < grid.classes.size(); ++k) result.classes.push_back(total.of(k));
    return result;
}

}  // namespace hopscotch::metrics
