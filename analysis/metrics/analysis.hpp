// Every metric of one map: what `hopscotch analyse` prints.
#pragma once

#include "analysis/metrics/boundary.hpp"
#include "analysis/metrics/box_dimension.hpp"
#include "analysis/metrics/components.hpp"
#include "analysis/metrics/critical_shock.hpp"
#include "analysis/metrics/entropy.hpp"
#include "analysis/metrics/fall_distance.hpp"
#include "analysis/metrics/read_classes.hpp"
#include "analysis/metrics/shares.hpp"
#include "analysis/metrics/slice_shocks.hpp"
#include "analysis/metrics/wada.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace hopscotch::metrics {

struct analysis_wish {
    class_choice classes;
    std::uint64_t box = 0;  // cells along a side of the entropy's boxes; 0: `default_box`
    std::map<std::string, std::pair<double, double>> reference_box;  // axis name -> range
    std::map<std::string, double> plane;  // values of the state columns that are no axis
    slice_choice slices;  // where attractors change along axes: which, and those of each slice
};

struct map_analysis {
    std::string layer;
    class_grid grid;
    basin_shares shares;
    basin_shares stability;  // shares of the reference box; `shares` where none is given
    boundary_counts boundary;
    std::vector<component_count> components;
    basin_entropy entropy;
    scaling_by_class uncertainty;
    scaling_by_class box_counts;
    wada_test wada;
    fall_distances falls_in_axis_units;
    fall_distances falls_in_cells;
    std::vector<critical_shock> shocks;  // one per row of the attractor table
    shocks_over_parameters shocks_of_slices;
    std::vector<std::string> problems;  // tiles that could not be read
};

/// \error store_error as `read_classes`, for an entropy box that does not fit, for a reference box
///        that names no axis or holds no cell
map_analysis analyse_map(const map_reader& map, const analysis_wish& wish = {});

}  // namespace hopscotch::metrics
