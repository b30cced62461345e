// Decides, before a map is computed, how its cells get their labels: by the model's own certificate
// where that is a proof for the whole scene, else by trap intervals around the attractors found at
// every parameter point. Called by `run`, `attractors`, `verify` and `replay`.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <span>

namespace hopscotch {

/// The plan of a scene's labels, or for exponents the columns that returns conserve; else an empty
/// one. Independent of grid order, threads and backend.
///
/// \param searched  cells (rising) from which to search once more, because a first pass has left
///                  them without a label; only plans by search look at them
label_plan plan_labels(const scene& scene, std::span<const std::uint64_t> searched = {});

/// Positions of the scene's parameter axes.
std::vector<std::size_t> parameter_axes(const scene& scene);

/// The parameter values of every parameter point, points in C order over the axes given.
std::vector<std::vector<double>> parameter_points(const scene& scene,
                                                  const std::vector<std::size_t>& axes);

}  // namespace hopscotch
