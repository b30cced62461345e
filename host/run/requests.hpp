// From a scene and a rectangle of its cells (or a list of single cells) to the plain request that
// kernels understand. The tables are borrowed from scene, plan and layout, which must outlive the
// request.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"
#include "kernels/ensemble/request.hpp"

#include <span>
#include <vector>

namespace hopscotch {

/// A request with the tables that only it needs. Movable; the request points into `tables`.
struct cell_request {
    ensemble_request request;
    std::vector<std::vector<double>> tables;
};

/// What the kernel chooses its variant by, for the whole map.
int variant_of(const scene& scene);

/// The cells of one tile, in C order within the box. Results are not set.
cell_request request_of(const scene& scene, const label_plan& plan, const map_layout& layout,
                        const tile_box& box);

/// Any cells of the map, by index in C order.
cell_request request_of(const scene& scene, const label_plan& plan,
                        std::span<const std::uint64_t> cells);

/// Which of the plan's parameter points a cell belongs to.
std::uint64_t point_index(const scene& scene, const label_plan& plan,
                          std::span<const std::uint64_t> coordinates);

}  // namespace hopscotch
