// Labels that a model gives by itself in a plan by search.
#pragma once

#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {

/// Adds the labels of the model's own certificate, or else of its resting state, if it has one:
/// label 1 is where orbits end stuck or at rest.
void add_own_labels(const scene& scene, label_plan& plan);

}  // namespace hopscotch
