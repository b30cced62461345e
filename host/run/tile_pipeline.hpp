// One rank's part in a pass over tiles: draw one after the other, compute, compress and write in
// parallel. Memory is that of the tiles in flight, whatever the map's size. Used by run_map.
#pragma once

#include "host/run/stop_condition.hpp"
#include "host/run/tile_queue.hpp"
#include "host/run/tiles.hpp"
#include "host/store/map_run.hpp"

#include <functional>
#include <optional>

namespace hopscotch {

/// Takes a finished tile: it is compressed, written and counted. Nothing: a tile stays as it is.
/// Thread safe.
using tile_sink = std::function<void(const std::optional<tile_result>&)>;

/// What a pass does with a tile that it has drawn: hands it to the sink, or several that are
/// computed together. Thread safe.
using tile_work = std::function<void(const tile_box&, const tile_sink&)>;

/// Works on tiles of the queue until it is dry or the run has to stop. A signal, or an error here,
/// halts the queue for all ranks.
/// \error  store_error, device_error; finished tiles stay
void compute_tiles(const tile_job& job, const tile_work& work, tile_queue& queue, map_run& run,
                   const stop_condition& stop, int n_threads);

}  // namespace hopscotch
