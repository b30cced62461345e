// One rank's part in a pass over tiles: draw, compute and compress in parallel, write one at a
// time. No more than two tiles per thread are in flight, whatever the map's size. Used by run_map.
#pragma once

#include "host/run/stop_condition.hpp"
#include "host/run/tile_queue.hpp"
#include "host/run/tiles.hpp"
#include "host/store/map_run.hpp"

#include <functional>
#include <optional>

namespace hopscotch {

/// What a pass does with a tile; nothing comes back where it stays as it is. Thread safe.
using tile_work = std::function<std::optional<tile_result>(const tile_box&)>;

/// Works on tiles of the queue until it is dry or the run has to stop. A signal, or an error here,
/// halts the queue for all ranks.
/// \error  store_error, device_error; finished tiles stay
void compute_tiles(const tile_job& job, const tile_work& work, tile_queue& queue, map_run& run,
                   const stop_condition& stop, int n_threads);

}  // namespace hopscotch
