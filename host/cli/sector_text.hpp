// One-sided stability by direction as text: what `attractors` prints and writes of sector_table.
#pragma once

#include "analysis/labels/sector_table.hpp"

#include <string>
#include <vector>

namespace hopscotch {

/// One line per attractor: how many directions attract, the nearest and farthest end of its
/// immediate basin, the slowest law. Empty without rows.
std::string sector_text(const scene& scene, const label_plan& plan,
                        const std::vector<sector_row>& rows);

/// A JSON array of all rows and sectors.
std::string sector_json(const std::vector<sector_row>& rows);

}  // namespace hopscotch
