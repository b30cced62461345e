// The picture of an orbit diagram: a dot per recorded state over the parameter, sweeps and starts
// in colours of their own.
#pragma once

#include "analysis/render/canvas.hpp"
#include "host/store/map_reader.hpp"

#include <string>

namespace hopscotch::picture {

/// Does the map hold recorded states (axes parameter, orbit, sample)?
bool is_diagram(const map_layout& layout);

/// \param layer  of states; empty: the first one
/// \error        store_error where the map has no such layer
canvas draw_diagram(const map_reader& map, const std::string& layer, const std::string& title);

}  // namespace hopscotch::picture
