// Decides, before a map is computed, how its cells get their labels: by the model's own certificate where
// that is a proof for the whole scene, else by trap intervals around the attractors found at every
// parameter point. Called by `run`, `attractors`, `verify` and `replay`.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {

/// The plan of a scene's labels. Independent of grid order, threads and backend.
///
/// \error scene_error where the question needs labels and the model offers neither a certificate for
///        this scene nor the branches of a one-dimensional return map
label_plan plan_labels(const scene& scene);

}  // namespace hopscotch
