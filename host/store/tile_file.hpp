// One finished tile of an unfinished map: a small HDF5 file with one chunk per layer, complete from
// the moment it has its name. Used by map_run while computing and by map_reader on a run directory.
#pragma once

#include "host/map/layout.hpp"
#include "host/store/compressed_tile.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hopscotch {

std::filesystem::path tile_path(const std::filesystem::path& directory, std::uint64_t tile);

/// Reason of the store_error for a tile with another fingerprint: it is sound, but not ours to
/// remove.
inline constexpr const char* another_scene = "a tile of another scene";

/// The tile a file name stands for, if any.
std::optional<std::uint64_t> tile_of(const std::filesystem::path& file);

/// \error  store_error; an older file of the tile stays as it was
void write_tile(const std::filesystem::path& directory, const map_layout& layout,
                const std::string& fingerprint, const compressed_tile& tile);

/// Reads the chunks and the checksums that were stored with them; nothing is decoded.
/// \error  store_error where the file is missing, truncated, or of another map or scene
compressed_tile read_tile(const std::filesystem::path& directory, const map_layout& layout,
                          const std::string& fingerprint, std::uint64_t tile);

/// Decodes a tile and compares it with its checksums.
/// \error  store_error naming `place` where they do not agree
tile_data checked_tile(const map_layout& layout, const compressed_tile& tile,
                       const std::string& place);

}  // namespace hopscotch
