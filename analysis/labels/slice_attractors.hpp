// The attractors at one parameter point of a scene: a plan's table gives one example of each, which
// elsewhere has other points.
#pragma once

#include "analysis/metrics/slice_shocks.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// The plan's attractors that are at the parameter point of a cell, with the points they have
/// there: the centres of its traps, the cycles in its trap intervals, or the certificate's points.
/// Attractors without points (chaotic sets, rest without a state) are left out.
std::vector<attractor_row> attractors_at(const scene& scene, const label_plan& plan,
                                         std::span<const std::uint64_t> coordinates);

/// How `analyse` cuts the scene's map. Borrows both.
///
/// \param axes   over which attractors change (see axes_of_points)
/// \param plane  values of the state columns that are no axis
metrics::slice_choice slices_of(const scene& scene, const label_plan& plan,
                                const std::vector<std::size_t>& axes,
                                std::map<std::string, double> plane);

}  // namespace hopscotch
