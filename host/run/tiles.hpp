// Computes one tile: request, kernel, and the layers that follow from the kernel's results.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/kernel_in_use.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/layers.hpp"
#include "host/scene/scene.hpp"

#include <vector>

namespace hopscotch {

/// What every tile of a run needs; borrowed, and read only while tiles are computed.
struct tile_job {
    const scene& what;
    const label_plan& plan;
    const map_layout& layout;
    const std::vector<layer_plan>& layers;
    kernel_in_use& kernel;
};

struct tile_result {
    tile_data data;
    lane_statistics lanes;
    double seconds = 0.0;
    std::uint64_t n_computed = 0;  // cells; fewer than the tile has where the map is refined
};

/// All layers of some cells, by index in the map, in the given order. Thread safe.
std::vector<std::vector<std::byte>> compute_cells(const tile_job& job,
                                                  const std::vector<std::uint64_t>& cells,
                                                  lane_statistics& lanes);

/// Every cell of a tile. Thread safe.
tile_result compute_tile(const tile_job& job, const tile_box& box);

}  // namespace hopscotch
