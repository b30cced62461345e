// The grid of an orbit diagram's map: parameter x orbit x sample, made from a scene whose own axes
// are a parameter and starts. Used by layout_of and by the run of a diagram.
#pragma once

#include "host/map/layout.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {

/// Places of a diagram's axes; the parameter comes first.
inline constexpr std::size_t orbit_axis = 1;
inline constexpr std::size_t sample_axis = 2;

/// Orbits of sweeps; those of starts follow.
inline constexpr std::uint64_t rising_orbit = 0;
inline constexpr std::uint64_t falling_orbit = 1;
inline constexpr std::uint64_t first_start = 2;

/// Starts followed together, so that lanes are full while memory stays bounded.
inline constexpr std::uint64_t orbits_at_once = 512;

bool is_orbit_diagram(const scene& scene);

/// Does the diagram carry orbits along its parameter, up and down?
bool has_sweeps(const scene& scene);

/// Orbits are numbered 0 (sweep up), 1 (sweep down), 2 and above (the starts, in C order over the
/// grid's other axes); samples are consecutive returns.
std::vector<axis> diagram_axes(const scene& scene, axis parameter);

/// Tiles divide the parameter, and the orbits such that each sweep has tiles of its own. The first
/// number of `output.tile` is the parameter's extent where the scene chooses one.
std::vector<std::uint64_t> diagram_tile(const scene& scene);

/// \error  scene_error where an axis after the first is a parameter, or the first no column that a
///         sweep could carry
void check_diagram(const scene& scene);

}  // namespace hopscotch
