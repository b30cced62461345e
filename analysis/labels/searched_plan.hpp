// Labels by search: the attractors of every parameter point of a scene are found, get trap
// ellipsoids (cycles) or covers (chaotic sets), and labels in canonical order.
#pragma once

#include "analysis/attractors/search.hpp"
#include "analysis/labels/plan_points.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <vector>

namespace hopscotch {

/// What was found at every parameter point.
struct found_everywhere {
    plan_points points;
    std::vector<attractor_search> at;  // [parameter point]
};

/// Searches every parameter point from a sample of its cells; then, where `searched` names cells,
/// their points once more from just these cells.
found_everywhere search_everywhere(const scene& scene,
                                   std::span<const std::uint64_t> searched = {});

/// The plan of labels by search. Label 1 is the resting state where the model has one, then come
/// the labels of the model's own certificate, then cycles by period, then chaotic sets. Attractors
/// that only the second search has found are labelled after all others, so that labels of the first
/// pass keep their meaning.
label_plan plan_by_search(const scene& scene, std::span<const std::uint64_t> searched);

}  // namespace hopscotch
