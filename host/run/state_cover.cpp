// Boxes of equal number along every column, two to spare on each side.
#include "host/run/state_cover.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

constexpr std::uint64_t spare = 2;  // boxes beyond the hull, on either side
constexpr std::uint64_t outside = ~std::uint64_t{0};

/// As many boxes along every column as leave several samples to each, were the set to fill its
/// hull.
std::uint64_t boxes_for(std::size_t n_samples, int n_columns) {
    const double most = n_columns == 1 ? 1024.0 : n_columns == 2 ? 128.0 : 32.0;
    const double per_axis = std::pow(static_cast<double>(n_samples), 1.0 / n_columns);
    return static_cast<std::uint64_t>(std::clamp(0.5 * per_axis, 4.0, most));
}

}  // namespace

state_cover::state_cover(std::span<const double> samples, int n_columns)
    : n_columns_(n_columns),
      boxes_along_(boxes_for(samples.size() / static_cast<std::size_t>(n_columns), n_columns)) {
    const auto n = static_cast<std::size_t>(n_columns);
    lowest_.assign(samples.begin(), samples.begin() + n_columns);
    highest_ = lowest_;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        lowest_[i % n] = std::min(lowest_[i % n], samples[i]);
        highest_[i % n] = std::max(highest_[i % n], samples[i]);
    }
    std::uint64_t n_shifts = 1;
    for (int c = 0; c < n_columns; ++c) n_shifts *= 3;
    std::vector<int> shift(n);
    for (std::size_t i = 0; i < samples.size(); i += n) {
        for (std::uint64_t s = 0; s < n_shifts; ++s) {
            std::uint64_t digits = s;
            for (int& along : shift) {
                along = static_cast<int>(digits % 3) - 1;
                digits /= 3;
            }
            boxes_.push_back(box_of(samples.subspan(i, n), shift));
        }
    }
    std::sort(boxes_.begin(), boxes_.end());
    boxes_.erase(std::unique(boxes_.begin(), boxes_.end()), boxes_.end());
}

state_cover::state_cover(std::span<const double> lowest, std::span<const double> highest,
                         std::uint64_t boxes_along, std::span<const double> box_places)
    : n_columns_(static_cast<int>(lowest.size())),
      boxes_along_(boxes_along),
      lowest_(lowest.begin(), lowest.end()),
      highest_(highest.begin(), highest.end()) {
    for (std::size_t i = 0; i < box_places.size(); i += lowest.size()) {
        std::uint64_t key = 0;
        for (const double place : box_places.subspan(i, lowest.size())) {
            key = key * places_along() + static_cast<std::uint64_t>(place);
        }
        boxes_.push_back(key);
    }
}

std::vector<double> state_cover::box_places() const {
    const auto n = static_cast<std::size_t>(n_columns_);
    std::vector<double> places(boxes_.size() * n);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        std::uint64_t key = boxes_[i];
        for (std::size_t c = n; c-- > 0; key /= places_along()) {
            places[i * n + c] = static_cast<double>(key % places_along());
        }
    }
    return places;
}

std::uint64_t state_cover::places_along() const { return boxes_along_ + 2 * spare + 1; }

std::uint64_t state_cover::box_of(std::span<const double> state, std::span<const int> shift) const {
    std::uint64_t key = 0;
    for (std::size_t c = 0; c < state.size(); ++c) {
        const double width = highest_[c] - lowest_[c];
        double place = static_cast<double>(spare);
        if (width > 0.0) {
            place +=
                std::floor((state[c] - lowest_[c]) / width * static_cast<double>(boxes_along_));
        }
        place += static_cast<double>(shift[c]);
        if (!(place >= 0.0 && place < static_cast<double>(places_along()))) return outside;
        key = key * places_along() + static_cast<std::uint64_t>(place);
    }
    return key;
}

bool state_cover::holds(std::span<const double> state) const {
    if (boxes_.empty()) return false;
    const std::vector<int> here(state.size(), 0);
    const std::uint64_t box = box_of(state, here);
    return box != outside && std::binary_search(boxes_.begin(), boxes_.end(), box);
}

}  // namespace hopscotch
