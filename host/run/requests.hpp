// From a scene and a rectangle of its cells (or a list of single cells) to the plain request that
// kernels understand. The tables are borrowed from scene, plan and layout, which must outlive the
// request.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/kernel_in_use.hpp"
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

/// The kernel that computes the scene's map: with the tangent map where exponents are asked for.
/// \error device_error as choose_kernel
kernel_choice kernel_of(const scene& scene, std::string_view wanted_backend);

/// The same for a whole map: with `auto` a GPU comes first. \error device_error
kernel_in_use map_kernel_of(const scene& scene, std::string_view wanted_backend);

/// Does the scene ask for Lyapunov exponents?
bool is_chaos_map(const scene& scene);

/// Is a plan made before the map: for labels, or for what exponents have to know.
bool has_plan(const scene& scene);

/// Returns that an orbit of the map runs for, a transient included.
std::uint32_t most_returns_of(const scene& scene);

/// How the scene's Lyapunov exponents are estimated, those at fixed conserved columns first;
/// results are not set.
exponent_request exponents_of(const scene& scene, const label_plan& plan);

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
