// Hits of every class at every scale in every part of a map, as uncertainty and box counting
// collect them.
#pragma once

#include "analysis/metrics/class_grid.hpp"
#include "analysis/metrics/scaling_fit.hpp"

#include <bit>

namespace hopscotch::metrics {

class class_counts {
public:
    class_counts(std::size_t n_parts, std::size_t n_scales, std::size_t n_classes)
        : n_scales_(n_scales),
          n_classes_(n_classes),
          hits_(n_parts * n_scales * (n_classes + 1), 0),
          trials_(n_parts * n_scales, 0) {}

    /// One trial: the classes that meet there, none where it shows no boundary.
    void add(std::size_t part, std::size_t scale, class_set meeting) {
        const std::size_t at = part * n_scales_ + scale;
        ++trials_[at];
        if (meeting == 0) return;
        std::uint64_t* const hits = &hits_[at * (n_classes_ + 1)];
        ++hits[n_classes_];
        for (class_set rest = meeting; rest != 0; rest &= rest - 1) ++hits[std::countr_zero(rest)];
    }

    void add(const class_counts& other) {
        for (std::size_t i = 0; i < hits_.size(); ++i) hits_[i] += other.hits_[i];
        for (std::size_t i = 0; i < trials_.size(); ++i) trials_[i] += other.trials_[i];
    }

    /// The power laws of all boundaries and of each class.
    ///
    /// \param scales  in cells
    scaling_by_class fit(const std::vector<std::uint64_t>& scales) const {
        const std::vector<double> lengths(scales.begin(), scales.end());
        scaling_by_class result;
        result.whole = fit_power_law(lengths, of(n_classes_));
        for (std::size_t k = 0; k < n_classes_; ++k) {
            result.classes.push_back(fit_power_law(lengths, of(k)));
        }
        return result;
    }

private:
    /// [part][scale] of one class; `n_classes` stands for all boundaries.
    std::vector<std::vector<hit_count>> of(std::size_t which) const {
        std::vector<std::vector<hit_count>> result;
        for (std::size_t at = 0; at < trials_.size(); at += n_scales_) {
            std::vector<hit_count>& part = result.emplace_back();
            for (std::size_t i = at; i < at + n_scales_; ++i) {
                part.push_back({hits_[i * (n_classes_ + 1) + which], trials_[i]});
            }
        }
        return result;
    }

    std::size_t n_scales_;
    std::size_t n_classes_;
    std::vector<std::uint64_t> hits_;
    std::vector<std::uint64_t> trials_;
};

}  // namespace hopscotch::metrics
