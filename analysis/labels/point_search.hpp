// The search for attractors at one parameter point of a scene: what its axes, samples and limits
// mean to it.
#pragma once

#include "analysis/attractors/search.hpp"
#include "analysis/labels/plan_points.hpp"
#include "host/scene/scene.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hopscotch {

/// Columns of the section that returns end on which the return map conserves, at starts sampled
/// from the scene's first, middle and last parameter point (rising). None where the scene starts on
/// another section.
std::vector<int> conserved_in(const scene& scene);

/// Axes over which attractors change (rising): parameters, and columns that the return map
/// conserves.
std::vector<std::size_t> axes_of_points(const scene& scene);

/// Limits of a search in a scene with so many parameter points: thorough for one, quick for many.
search_limits limits_of(const scene& scene, std::size_t n_points);

/// Cells to start from at every point: the scene's `samples`, else 512 for one point, 32 for more.
std::size_t samples_of(const scene& scene, std::size_t n_points);

/// Typical size of every column at a point: the spread of its starts' first images.
std::vector<double> scale_of(const map_point& map, int section, std::span<const double> starts);

/// The attractors at one point, from starts on the scene's section ([start][column]).
attractor_search search_point(const scene& scene, const plan_points& points, std::size_t point,
                              std::span<const double> starts, const search_limits& limits,
                              std::vector<found_attractor> known = {});

}  // namespace hopscotch
