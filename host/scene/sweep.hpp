// A sweep: the same map at many values of parameters or fixed starts. Which points it has, and the
// scene of the map at each of them.
#pragma once

#include "host/map/layout.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// Does the scene stand for many maps? (False for the scene of one of them.)
bool is_sweep(const scene& scene);

/// Points along each dimension: one per axis, or a single one where the axes move together.
std::vector<std::uint64_t> sweep_shape(const scene_sweep& sweep);

/// Coordinates of a point along those dimensions, from its index in C order.
std::vector<std::uint64_t> sweep_coordinates(const scene_sweep& sweep, std::uint64_t point);

/// The value of every axis at a point.
std::vector<double> sweep_values(const scene_sweep& sweep,
                                 std::span<const std::uint64_t> coordinates);

/// The scene of the map at a point: the same numbers and fingerprint as a scene that sets those
/// values itself. It reads again from the same text with `sweep.point` as an override.
scene map_scene(const scene& sweep, std::uint64_t point);

/// The dimensions of an index over the maps: the axes, or `point` where they move together.
std::vector<axis> sweep_dimensions(const scene& scene);

/// Where the axes move together: each of them over `point`. Empty else.
std::vector<axis> sweep_followers(const scene& scene);

}  // namespace hopscotch
