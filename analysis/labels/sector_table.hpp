// The one-sided stability of every attractor that a plan by search has found, direction by
// direction.
#pragma once

#include "analysis/attractors/sectors.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <string>
#include <vector>

namespace hopscotch {

struct sector_row {
    std::vector<double> at;     // values of the axes that make the parameter points
    std::string name;           // of the attractor
    std::vector<double> point;  // one point of the orbit
    std::vector<double> scale;  // of every column: distances are in it
    std::vector<stability_sector> sectors;
};

/// Rows for every attractor with a trap, at up to `most_points` parameter points spread evenly.
std::vector<sector_row> sector_table(const scene& scene, const label_plan& plan,
                                     std::size_t most_points = 32);

}  // namespace hopscotch
