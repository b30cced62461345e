#include "analysis/metrics/distance.hpp"

#include <algorithm>
#include <limits>

namespace hopscotch::metrics {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// min over q of heights[q] + (x[p] - x[q])^2 for every p of one line of cells.
class lower_envelope {
public:
    explicit lower_envelope(const std::vector<double>& x)
        : x_(x), owner_(x.size()), from_(x.size()) {}

    void apply(std::span<double> heights) {
        build(heights);
        if (n_ == 0) return;
        heights_.assign(heights.begin(), heights.end());
        std::size_t k = 0;
        for (std::size_t p = 0; p < x_.size(); ++p) {
            while (k + 1 < n_ && from_[k + 1] < x_[p]) ++k;
            const double d = x_[p] - x_[owner_[k]];
            heights[p] = heights_[owner_[k]] + d * d;
        }
    }

private:
    /// Parabolas that are lowest somewhere, with the position from which on each is.
    void build(std::span<const double> heights) {
        n_ = 0;
        for (std::size_t q = 0; q < x_.size(); ++q) {
            if (heights[q] == infinity) continue;
            double start = -infinity;
            while (n_ > 0) {
                const std::size_t p = owner_[n_ - 1];
                // where the parabolas of p and q meet
                start = 0.5 * (x_[p] + x_[q] + (heights[q] - heights[p]) / (x_[q] - x_[p]));
                if (start > from_[n_ - 1]) break;
                --n_;
                start = -infinity;
            }
            owner_[n_] = q;
            from_[n_++] = start;
        }
    }

    const std::vector<double>& x_;
    std::vector<std::size_t> owner_;
    std::vector<double> from_;
    std::vector<double> heights_;
    std::size_t n_ = 0;
};

}  // namespace

distance_transform::distance_transform(const class_grid& grid, length_unit unit,
                                       const marking& marked) {
    along_first_ = positions_of(grid.axes.front(), unit);
    for (std::size_t i = 1; i < grid.rank(); ++i) {
        along_.push_back(positions_of(grid.axes[i], unit));
        slab_size_ *= grid.axes[i].size();
    }
    nearest_.resize(n_slabs() * slab_size_);
#pragma omp parallel
    {
        std::vector<std::uint8_t> marks(slab_size_);
#pragma omp for schedule(static)
        for (std::uint64_t i = 0; i < n_slabs(); ++i) {
            marked(i, marks);
            std::uint32_t* to = &nearest_[i * slab_size_];
            for (std::uint64_t j = 0; j < slab_size_; ++j) {
                to[j] = marks[j] != 0 ? static_cast<std::uint32_t>(i) : none;
            }
        }
    }
    constexpr std::uint64_t chunk = 1024;  // columns whose running indices stay in the cache
#pragma omp parallel for schedule(dynamic)
    for (std::uint64_t begin = 0; begin < slab_size_; begin += chunk) {
        sweep(begin, std::min(begin + chunk, slab_size_));
    }
}

/// Forward, the last marked cell is carried along; backward, the next one where it is nearer.
void distance_transform::sweep(std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = 1; i < n_slabs(); ++i) {
        std::uint32_t* here = &nearest_[i * slab_size_];
        const std::uint32_t* before = here - slab_size_;
        for (std::uint64_t j = begin; j < end; ++j) {
            here[j] = here[j] == none ? before[j] : here[j];
        }
    }
    std::vector<std::uint32_t> next(end - begin, none);
    for (std::uint64_t i = n_slabs(); i-- > 0;) {
        std::uint32_t* here = &nearest_[i * slab_size_];
        for (std::uint64_t j = begin; j < end; ++j) {
            std::uint32_t& ahead = next[j - begin];
            if (here[j] == i) ahead = here[j];
            if (ahead == none) continue;
            const bool is_nearer = here[j] == none || along_first_[ahead] - along_first_[i] <
                                                          along_first_[i] - along_first_[here[j]];
            if (is_nearer) here[j] = ahead;
        }
    }
}

void distance_transform::squared(std::uint64_t i, std::span<double> result) const {
    const std::uint32_t* nearest = &nearest_[i * slab_size_];
    for (std::uint64_t j = 0; j < slab_size_; ++j) {
        const double d = nearest[j] == none ? infinity : along_first_[nearest[j]] - along_first_[i];
        result[j] = d * d;
    }
    if (along_.empty()) return;
    // the last axis is contiguous; the one before it, if there is one, is copied line by line
    const std::vector<double>& last = along_.back();
    lower_envelope rows(last);
    for (std::uint64_t at = 0; at < slab_size_; at += last.size()) {
        rows.apply(result.subspan(at, last.size()));
    }
    if (along_.size() < 2) return;
    const std::vector<double>& middle = along_.front();
    lower_envelope columns(middle);
    std::vector<double> line(middle.size());
    for (std::uint64_t j = 0; j < last.size(); ++j) {
        for (std::size_t k = 0; k < middle.size(); ++k) line[k] = result[k * last.size() + j];
        columns.apply(line);
        for (std::size_t k = 0; k < middle.size(); ++k) result[k * last.size() + j] = line[k];
    }
}

}  // namespace hopscotch::metrics
