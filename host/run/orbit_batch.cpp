// One kernel call per step.
#include "host/run/orbit_batch.hpp"

#include <algorithm>

namespace hopscotch {

orbit_batch::orbit_batch(const scene& scene, kernel_in_use& kernel, int section)
    : scene_(scene),
      kernel_(kernel),
      section_(section),
      columns_(scene.info().sections[static_cast<std::size_t>(section)].columns.size()),
      parameters_(scene.parameters.size()) {}

void orbit_batch::add(const cell_start& start) {
    for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].push_back(start.columns[c]);
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
        parameters_[p].push_back(start.parameters[p]);
    }
    ends_.push_back(static_cast<std::uint8_t>(outcome::ok));
}

void orbit_batch::advance(std::uint32_t returns) {
    const std::size_t n = size();
    ensemble_request request;
    request.n_cells = n;
    request.section = section_;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        request.columns[c] = {columns_[c].data(), 1, n};
    }
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
        request.parameters[p] = {parameters_[p].data(), 1, n};
    }
    std::copy(scene_.options.begin(), scene_.options.end(), request.options);
    request.max_returns = returns;
    request.max_steps = static_cast<double>(scene_.accuracy.max_events);
    request.tolerance = scene_.accuracy.tolerance;
    next_ends_.resize(n);
    request.outcome = next_ends_.data();
    next_columns_.resize(scene_.end_section().columns.size());
    for (std::size_t c = 0; c < next_columns_.size(); ++c) {
        next_columns_[c].resize(n);
        request.state[c] = next_columns_[c].data();
    }
    lanes_ += kernel_.run(request);
    for (std::size_t i = 0; i < n; ++i) {
        if (goes_on(i)) ends_[i] = next_ends_[i];
    }
    columns_.swap(next_columns_);
    section_ = scene_.start_section().returns_to;
}

}  // namespace hopscotch
