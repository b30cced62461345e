// Which cells the arithmetic cannot decide: those whose answer changes when their start moves by a
// few roundings. The layer `uncertain`, and the audit's share of such cells.
//
// Cells that are not certain by their neighbours (doubtful.hpp) are computed again by the same
// kernel with one number moved, up and down: each axis, then each fixed start column and parameter.
//
// Why that finds what roundings can change. The error of a return is a few roundings' worth of the
// exact map's own sensitivity to its state and parameters (tests/hard asserts at most 3), so that
// at the guard or trap edge that decides, an orbit's error is a sum over returns and numbers of
// "rounding times effect of that number". A moved start has the effect of roundings of the first
// returns; where the orbit forgets its start only the last returns count, and a moved parameter acts
// at every return. The largest single effect is at least the sum's share of one number, whereas
// numbers moved together can cancel: with all of them moved at once twelve wrong labels of the
// paddle juggler went unflagged. An orbit that passes a guard closer than its error is found in the
// same way: moved ones pass on the other side, with another number of events. Orbits that spend
// their returns undecided are certain to be so only if the moved ones end in the same place.
//
// What it can miss: roundings of many returns that add up where the effects of moved numbers do not
// (they alternate in sign, or turn, for thousands of returns), and effects of numbers that are zero,
// which stay. Sixteen ulp, because four are too few: wrong labels went unflagged where orbits dwell
// on a ghost of a fixed point (tests/hard/test_wrong_labels.cpp, `bench uncertain`).
#pragma once

#include "host/map/certainty.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/labelled_run.hpp"
#include "host/run/moved_starts.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hopscotch {

/// The certainty of every cell of a request by a second look at each.
///
/// \param plan     of the map, or of the one parameter point that all cells belong to
/// \param results  an earlier run of the request, its results bound as answers.hpp asks
/// \return         codes of `certainty`
std::vector<std::uint8_t> second_look(const scene& scene, const label_plan& plan,
                                      const kernel_run& run, const ensemble_request& results);

/// The same for some cells of the map, by index in C order. Computes their answers first.
std::vector<std::uint8_t> second_look(const scene& scene, const label_plan& plan,
                                      const kernel_run& run, std::span<const std::uint64_t> cells);

/// Looks again only where neighbours or fixed numbers ask for it.
///
/// \param plan     of the map, and not one with a plan per point
/// \param results  an earlier run of the cells, bound as answers.hpp asks
/// \param cells    of the map, by index in C order, rising
std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run, const ensemble_request& results,
                                       std::span<const std::uint64_t> cells);

/// The same. Computes the cells' answers first.
std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run, std::span<const std::uint64_t> cells);

}  // namespace hopscotch
