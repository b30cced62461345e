// Tiles as they lie in a file: shuffled and deflated by our own code, so that worker threads
// compress while the one HDF5 thread only moves finished bytes (the serial HDF5 library is not
// thread safe).
#pragma once

#include "host/map/hash.hpp"
#include "host/map/layout.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace hopscotch {

/// How often each value occurs in a layer.
using value_counts = std::map<int, std::uint64_t>;

/// What is known of a tile without its numbers; one entry per layer.
struct tile_summary {
    std::vector<layer_sum> sums;
    std::vector<value_counts> counts;  // empty for int32 and float64 layers
    double seconds = 0.0;              // spent computing it
};

struct compressed_tile {
    tile_box box;
    std::vector<std::vector<std::byte>>
        chunks;  // one HDF5 chunk per layer: a full tile, edge padded
    tile_summary summary;
};

/// Compresses a tile into HDF5 chunks (shuffle + deflate); every NaN is stored as the same NaN.
/// Thread safe, no HDF5.
///
/// \param level    0 (store only) to 9
/// \param seconds  compute time, kept in the tile table
/// \error          std::invalid_argument where a layer's buffer does not fit the box
compressed_tile compress(const map_layout& layout, const tile_data& tile, int level,
                         double seconds = 0.0);

/// The inverse of `compress`. Thread safe, no HDF5.
/// \error  std::runtime_error with the reason where a chunk does not decode
tile_data decompress(const map_layout& layout, const compressed_tile& tile);

/// One layer of a tile, decoded from its chunk (a full tile), cut to the box.
std::vector<std::byte> decode_chunk(const map_layout& layout, const tile_box& box,
                                    std::size_t layer, std::span<const std::byte> chunk);

/// CRC-32 of a chunk as it lies in a file: finds damage without decoding.
std::uint32_t cyclic_check(std::span<const std::byte> chunk);

/// Checksums and counts of a tile's numbers.
tile_summary summarise(const map_layout& layout, const tile_data& tile);

}  // namespace hopscotch
