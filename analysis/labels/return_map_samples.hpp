// Samples of a one-dimensional return map x -> P(x) at one parameter point, computed by the model's
// scalar kernel: the same bits as the map itself. Used to look for fixed points and traps.
#pragma once

#include "host/scene/scene.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hopscotch {

class return_map_samples {
public:
    /// \param parameters  one per parameter of the model
    return_map_samples(const scene& scene, std::vector<double> parameters);

    /// P^returns(x); NaN where the orbit ends before.
    std::vector<double> at(std::span<const double> x, std::uint32_t returns = 1) const;
    double at(double x, std::uint32_t returns = 1) const;

private:
    const scene& scene_;
    std::vector<double> parameters_;
    int variant_ = 0;
};

}  // namespace hopscotch
