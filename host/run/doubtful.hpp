// Which cells need the second look that the layer `uncertain` takes; all others are certain without
// one. What is doubtful depends on the map's cells alone, not on its tiles.
//
// A surface at which the answer changes, a few roundings from a cell, separates the cell's two
// neighbours along every axis that it is not parallel to. So cells are doubtful first that differ
// from one of their 2 d nearest neighbours by label, outcome, number of returns or events (or last
// state, if all returns are spent), and cells at the grid's edge, which lack neighbours. Of these
// only those stay doubtful that differ from one of two further starts, 1/64 of the cells' distance
// away on either side, in a direction to whose ratios no surface has reason to be parallel. A
// surface parallel to all axes is one of the fixed numbers: whether moving one of these changes an
// answer is tried at one cell of every block of 64 (8 x 8), and a change there makes the whole
// block doubtful.
//
// Left out is what lies between two surfaces less than a cell (1/64 of it, next to other answers)
// apart that leave no trace in the neighbours' numbers of returns and events. A cell that itself
// lies between them differs from its neighbours and is looked at.
#pragma once

#include "host/run/answers.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/labelled_run.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hopscotch {

/// Do neighbours tell? Not where cells are closer than 2^14 displacements, nor where the map is
/// refined (its computed cells line boundaries), nor in a chaos map.
bool do_neighbours_tell(const scene& scene, double tolerance);

/// \param cells      by index in the map, rising
/// \param found      their answers
/// \param tolerance  of `tolerance_of`
/// \return           places among `cells` of the doubtful ones, rising
std::vector<std::uint64_t> doubtful_among(const scene& scene, const label_plan& plan,
                                          const kernel_run& run,
                                          std::span<const std::uint64_t> cells,
                                          const answer_view& found, double tolerance);

}  // namespace hopscotch
