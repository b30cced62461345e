// The second answer to the question one_sided, beside its map: for every attractor, parameter point
// and side what `analysis/labels/orbit_sides.hpp` tells, as a CSV table and as a map file over
// parameters, orbits and sides.
#pragma once

#include "analysis/labels/orbit_sides.hpp"
#include "host/map/layout.hpp"

#include <filesystem>
#include <string>

namespace hopscotch {

/// One row per parameter point, orbit and side; what is not known is empty.
std::string side_csv(const side_table& table, const scene& scene);

/// The same as a map: parameters, `orbit` (labels), `side` or `direction`.
map_layout side_layout(const side_table& table, const scene& scene);

/// Writes MAP_sides.csv and MAP_sides.h5 from a finished map; existing ones are replaced. Nothing
/// where no attractor has a point.
///
/// \return  lines that name them
/// \error   store_error
std::string write_sides(const std::filesystem::path& map);

}  // namespace hopscotch
