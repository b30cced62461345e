// Which cells the arithmetic cannot decide: those whose answer changes when their start moves by a
// few roundings. The layer `uncertain`, and the audit's share of such cells.
//
// Every cell is computed again by the same kernel from moved starts: each axis by itself, up and
// down, and all fixed numbers at once. An orbit's roundings act like a small displacement of its
// start, unless it contracts so fast that a displaced start is forgotten before it reaches the
// boundary; moving the parameters acts at every return, as roundings do. Four ulp are too few: of
// cells one ulp apart at boundaries, wrong labels went unflagged where orbits dwell on a ghost of a
// fixed point (tests/hard/test_wrong_labels.cpp). Looking only at cells with
// neighbours of another label would be cheaper and miss filaments thinner than a cell.
#pragma once

#include "host/map/certainty.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/labelled_run.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hopscotch {

/// How far a number moves: 16 ulp of the larger of |x| and `scale`, and where a flow is integrated
/// to `tolerance` > 0 at least 100 (1/4 + that size) tolerances, ten times what a return may be off
/// by (kernels/integrators/taylor.hpp).
double displacement_of(double x, double scale, double tolerance);

/// The certainty of every cell of a request.
///
/// \param results  an earlier run of the request, its results bound: outcome, returns and events;
///                 label where the question has labels; motion instead of events where it asks for
///                 exponents
/// \return         codes of `certainty`
std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run, const ensemble_request& results);

/// The certainty of some cells of the map, by index in C order.
std::vector<std::uint8_t> certainty_of(const scene& scene, const label_plan& plan,
                                       const kernel_run& run, std::span<const std::uint64_t> cells);

}  // namespace hopscotch
