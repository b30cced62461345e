// An orbit diagram: over the grid's first axis (a parameter, or a conserved state column), the
// states that orbits settle on, from every start of the other axes and along sweeps up and down.
// Called by run_map.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/run_choices.hpp"
#include "host/run/run_report.hpp"
#include "host/scene/scene.hpp"

namespace hopscotch {

/// Names and places of a diagram's axes: parameter, orbit, sample.
inline constexpr std::size_t orbit_axis = 1;
inline constexpr std::size_t sample_axis = 2;

bool is_orbit_diagram(const scene& scene);

/// Parameter x orbit x sample. Orbits are numbered 0 (sweep up), 1 (sweep down), 2 and above (the
/// starts, in C order over the grid's other axes); samples are consecutive returns.
map_layout diagram_layout(const scene& scene);

/// \error  scene_error where an axis after the first is a parameter
void check_diagram(const scene& scene);

/// Computes, writes and packs the diagram. An interrupted one begins anew.
run_report run_diagram(const scene& scene, const run_choices& choices);

}  // namespace hopscotch
