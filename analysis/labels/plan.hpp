// Decides, before a map is computed, how its cells get their labels: by the model's own certificate
// where that is a proof for the whole scene, else by trap intervals around the attractors found at
// every parameter point. Called by `run`, `attractors`, `verify` and `replay`.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {

/// The plan of a scene's labels. Independent of grid order, threads and backend.
///
/// \error scene_error where the question needs labels and the model offers neither a certificate
/// for
///        this scene nor the branches of a one-dimensional return map
label_plan plan_labels(const scene& scene);

/// Positions of the scene's parameter axes.
std::vector<std::size_t> parameter_axes(const scene& scene);

/// The parameter values of every parameter point, points in C order over the axes given.
std::vector<std::vector<double>> parameter_points(const scene& scene,
                                                  const std::vector<std::size_t>& axes);

}  // namespace hopscotch
