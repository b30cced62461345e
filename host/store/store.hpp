// The store: how maps get to disk and back. The scheduler computes tiles, compresses them in its
// worker threads and puts them; `finish` packs the map. Readers see checked numbers only.
//
//   writing   map_run         host/store/map_run.hpp          open, put, finish; kill-safe,
//   resumable
//             compress        host/store/compressed_tile.hpp  shuffle + deflate in the worker
//             threads
//   reading   map_reader      host/store/map_reader.hpp       layout, attributes, attractors, cells
//             verify_file     host/store/verify.hpp           what is wrong with a map
//   both      map_layout ...  host/map/layout.hpp             axes, layers, tiles
//             map_hash        host/map/hash.hpp               one number for a map, whatever its
//             tiles store_error     host/store/store_error.hpp      PLACE (reason); suggestion?
//
// A run, from start to end:
//
//     map_run run(layout, {.map = "basin.h5", .fingerprint = scene.fingerprint,
//                          .attributes = {{"scene", text}}, .existing = if_exists::resume});
//     if (run.complete()) return;
//     for (std::uint64_t tile : run.missing_tiles()) {        // any order, any thread
//         tile_data numbers = compute(box_of(layout, tile));
//         run.put(compress(layout, numbers, 4, seconds));     // compress: parallel; put:
//         serialised
//     }
//     run.finish({.attributes = {{"audit", ...}}, .attractors = rows, .point_columns =
//     {"height"}});
#pragma once

#include "host/map/hash.hpp"
#include "host/map/layout.hpp"
#include "host/store/compressed_tile.hpp"
#include "host/store/map_reader.hpp"
#include "host/store/map_run.hpp"
#include "host/store/store_error.hpp"
#include "host/store/verify.hpp"
