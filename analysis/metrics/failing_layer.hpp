// The layer `failing_distance` of a map whose orbits have all been computed: how far every cell is
// from the nearest one that fails. Called at the end of a run; other layers stay as they are.
#pragma once

#include "host/scene/scene.hpp"
#include "host/store/map_run.hpp"

namespace hopscotch::metrics {

/// Does the scene ask for the layer?
bool wants_failing_distance(const scene& scene);

/// Fills the layer in every finished tile: exact Euclidean distances from cell centre to cell
/// centre in cells of the grid, 0 at failing cells, infinite where no cell fails. What fails is
/// what `analyse` counts as a fall. Memory: 5 bytes per cell of the map and one row of tiles.
/// \error store_error
void fill_failing_distances(const scene& scene, map_run& run);

}  // namespace hopscotch::metrics
