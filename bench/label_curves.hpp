// Speed against the share of wrong answers, over whole orbits: every kernel, tolerance and
// precision and every general solver on the cells of one scene. Part of work_precision.
#pragma once

#include "bench/labelled_cells.hpp"

namespace hopscotch::bench {

/// Measures one scene and prints its lines.
void put_label_curves(const labelled_scene& which);

}  // namespace hopscotch::bench
