#include "analysis/metrics/class_slices.hpp"

#include <algorithm>

namespace hopscotch::metrics {

class_slices::class_slices(const class_grid& grid, std::span<const std::string> axes)
    : grid_(grid), n_named_(axes.size()) {
    for (std::size_t i = 0; i < grid.rank(); ++i) {
        const auto named = std::find(axes.begin(), axes.end(), grid.axes[i].name);
        if (named == axes.end()) {
            kept_.push_back(i);
            continue;
        }
        fixed_.push_back(i);
        place_.push_back(static_cast<std::size_t>(named - axes.begin()));
        n_slices_ *= grid.axes[i].size();
    }
}

std::vector<std::uint64_t> class_slices::indices(std::size_t slice) const {
    std::vector<std::uint64_t> result(fixed_.size());
    for (std::size_t i = fixed_.size(); i-- > 0;) {
        const std::uint64_t n = grid_.axes[fixed_[i]].size();
        result[i] = slice % n;
        slice /= n;
    }
    return result;
}

std::vector<std::uint64_t> class_slices::named_indices(std::size_t slice) const {
    const std::vector<std::uint64_t> at = indices(slice);
    std::vector<std::uint64_t> result(n_named_, 0);
    for (std::size_t i = 0; i < at.size(); ++i) result[place_[i]] = at[i];
    return result;
}

std::uint64_t class_slices::stride(std::size_t which) const {
    std::uint64_t result = 1;
    for (std::size_t i = which + 1; i < grid_.rank(); ++i) result *= grid_.axes[i].size();
    return result;
}

class_grid class_slices::cut(std::size_t slice) const {
    class_grid result;
    result.classes = grid_.classes;
    std::uint64_t n = 1;
    for (const std::size_t i : kept_) {
        result.axes.push_back(grid_.axes[i]);
        n *= grid_.axes[i].size();
    }
    const std::vector<std::uint64_t> at = indices(slice);
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < fixed_.size(); ++i) first += at[i] * stride(fixed_[i]);
    result.cells.reserve(n);
    for (std::uint64_t cell = 0; cell < n; ++cell) {
        std::uint64_t place = first;
        std::uint64_t rest = cell;
        for (std::size_t k = kept_.size(); k-- > 0;) {
            const std::uint64_t extent = grid_.axes[kept_[k]].size();
            place += rest % extent * stride(kept_[k]);
            rest /= extent;
        }
        result.cells.push_back(grid_.cells[place]);
    }
    return result;
}

}  // namespace hopscotch::metrics
