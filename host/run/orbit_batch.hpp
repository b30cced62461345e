// Orbits of one scene that are followed together, return by return, each at its own parameters.
// Used by orbit diagrams, which record where they are.
#pragma once

#include "host/run/kernel_in_use.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace hopscotch {

class orbit_batch {
public:
    /// \param section  that the starts lie on
    orbit_batch(const scene& scene, kernel_in_use& kernel, int section);

    void add(const cell_start& start);

    /// Orbits that have ended stay as they are. \error device_error
    void advance(std::uint32_t returns);

    std::size_t size() const { return ends_.size(); }
    bool goes_on(std::size_t orbit) const {
        return ends_[orbit] == static_cast<std::uint8_t>(outcome::ok);
    }
    std::uint8_t end(std::size_t orbit) const { return ends_[orbit]; }
    /// Of the section below the last return, or of the start where there was none.
    double state(std::size_t column, std::size_t orbit) const { return columns_[column][orbit]; }
    const lane_statistics& lanes() const { return lanes_; }

private:
    const scene& scene_;
    kernel_in_use& kernel_;
    int section_;
    std::vector<std::vector<double>> columns_;  // [column][orbit]
    std::vector<std::vector<double>> parameters_;
    std::vector<std::uint8_t> ends_;
    std::vector<std::vector<double>> next_columns_;  // kept, so that a return allocates nothing
    std::vector<std::uint8_t> next_ends_;
    lane_statistics lanes_;
};

}  // namespace hopscotch
