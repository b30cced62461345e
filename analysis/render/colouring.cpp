#include "analysis/render/colouring.hpp"

#include "analysis/render/palette.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch::picture {

namespace {

constexpr std::size_t most_names = 12;  // of an integer layer without flags

/// Share of every value among the cells shown.
std::map<int, double> shares_of(const image_data& data) {
    std::map<int, double> shares;
    for (const double value : data.values) shares[static_cast<int>(value)] += 1.0;
    for (auto& [value, share] : shares) share /= static_cast<double>(data.values.size());
    return shares;
}

bool is_integer(const layer& what) {
    return what.type == number_type::int16 || what.type == number_type::int8;
}

std::string name_of_value(const layer& what, int value) {
    for (const auto& [flag, name] : what.flags) {
        if (flag == value) return name;
    }
    return std::to_string(value);
}

/// The share over the whole map where the table knows it better than the cells shown.
double share_of(const attractor_row* row, double shown, bool is_every_cell) {
    return row != nullptr && row->share > 0.0 && !is_every_cell ? row->share : shown;
}

}  // namespace

colouring::colouring(const image_data& data, const std::vector<attractor_row>& attractors)
    : fill_(data.what.fill) {
    if (is_integer(data.what)) {
        const std::map<int, double> shares = shares_of(data);
        is_categorical_ = !data.what.flags.empty() || shares.size() <= most_names;
        if (is_categorical_) name_values(data, shares, attractors);
    }
    if (!is_categorical_) choose_scale(data);
}

void colouring::name_values(const image_data& data, const std::map<int, double>& shares,
                            const std::vector<attractor_row>& attractors) {
    const bool is_label = data.what.name == "label";
    std::size_t n_named = 0;
    for (const auto& [value, share] : shares) {
        if (value == static_cast<int>(fill_)) {
            legend_.push_back({not_computed, "not computed", share});
            colours_[value] = not_computed;
            continue;
        }
        const auto found =
            std::find_if(attractors.begin(), attractors.end(),
                         [&, value = value](const auto& row) { return row.label == value; });
        const attractor_row* row = is_label && found != attractors.end() ? &*found : nullptr;
        const std::string name = name_of_value(data.what, value);
        rgb colour = row != nullptr && row->colour != 0 ? rgb::of(row->colour)
                                                        : outcome_colour(name, n_named);
        if (value == 0 && row == nullptr && (is_label || data.what.name == "period")) {
            colour = undecided;
        } else {
            ++n_named;
        }
        colours_[value] = colour;
        legend_.push_back({colour, name, share_of(row, share, data.is_every_cell)});
    }
    std::stable_sort(legend_.begin(), legend_.end(),
                     [](const auto& a, const auto& b) { return a.share > b.share; });
}

void colouring::choose_scale(const image_data& data) {
    std::vector<double> sorted;
    for (const double value : data.values) {
        if (!data.is_fill(value) && std::isfinite(value)) sorted.push_back(value);
    }
    has_empty_cells_ = sorted.size() < data.values.size();
    if (sorted.empty()) return;
    std::sort(sorted.begin(), sorted.end());
    const auto quantile = [&](double share) {
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    lowest_ = sorted.front();
    highest_ = sorted.back();
    // Counts and times with a long tail are read on a logarithmic scale.
    const auto positive = std::upper_bound(sorted.begin(), sorted.end(), 0.0);
    const bool is_count = data.what.type == number_type::int32;
    if ((lowest_ > 0.0 || is_count) && positive != sorted.end()) {
        is_log_ = highest_ > 30.0 * quantile(0.5) && highest_ > 100.0 * *positive;
        if (is_log_) lowest_ = *positive;  // a count of 0 takes the scale's lowest colour
    }
    if (!is_log_) {
        // A few extreme cells must not bleach all others.
        const double low = quantile(0.002);
        const double high = quantile(0.998);
        const double spread = high - low;
        has_cells_below_ = spread > 0.0 && low - lowest_ > 0.5 * spread;
        has_cells_above_ = spread > 0.0 && highest_ - high > 0.5 * spread;
        if (has_cells_below_) lowest_ = low;
        if (has_cells_above_) highest_ = high;
    }
    is_diverging_ =
        lowest_ < 0.0 && highest_ > 0.0 && -lowest_ > 0.05 * highest_ && highest_ > -0.05 * lowest_;
    if (is_diverging_) {
        highest_ = std::max(highest_, -lowest_);
        lowest_ = -highest_;
    }
    if (lowest_ == highest_) highest_ = lowest_ + std::max(1.0, std::abs(lowest_) * 1e-3);
}

rgb colouring::of(double value) const {
    // Beside a scale that is light in its middle, an empty cell needs a darker grey.
    if (std::isnan(value) || (!is_categorical_ && value == fill_)) {
        return is_diverging_ ? no_value : not_computed;
    }
    if (is_categorical_) {
        const auto found = colours_.find(static_cast<int>(value));
        return found == colours_.end() ? not_computed : found->second;
    }
    const double share = is_log_ ? std::log(value / lowest_) / std::log(highest_ / lowest_)
                                 : (value - lowest_) / (highest_ - lowest_);
    return is_diverging_ ? diverging(share) : sequential(share);
}

}  // namespace hopscotch::picture
