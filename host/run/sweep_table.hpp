// The table of a sweep: from what is known of every map to the columns of the index.
#pragma once

#include "host/run/run_sweep.hpp"
#include "host/store/sweep_index.hpp"

namespace hopscotch {

/// Dimensions and columns of the index for these maps; what is not there is NaN, -1 or "".
void add_table(sweep_index& index, const std::vector<swept_map>& maps);

/// Gives a layer of labels the attractors' names where every map means the same by each label; else
/// only the table can tell.
void name_labels(map_layout& layout, const std::vector<swept_map>& maps);

}  // namespace hopscotch
