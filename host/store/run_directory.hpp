// The files of an unfinished map: `<map>.tiles/` with `run.h5` (the map without numbers), locks,
// kept texts and one file per finished tile. Knows their names; map_run decides what happens to
// them.
#pragma once

#include "host/map/shard.hpp"
#include "host/store/map_file.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

std::filesystem::path directory_of(const std::filesystem::path& map);
std::filesystem::path description_path(const std::filesystem::path& directory);

/// Makes the directory and those above it. \error store_error
void make_directory(const std::filesystem::path& directory);

/// Removes a file, whether or not it is there. \error store_error
void remove_file(const std::filesystem::path& file);

/// Tiles whose file is there, in ascending order; nothing is read.
std::vector<std::uint64_t> tiles_present(const std::filesystem::path& directory);

/// Those of them that belong to a shard.
std::vector<std::uint64_t> tiles_present(const std::filesystem::path& directory, const shard& part);

/// Removes what a killed run left under temporary names; of a shard only its own tiles'.
void remove_partial_files(const std::filesystem::path& directory, const shard& part = {});

void remove_tiles(const std::filesystem::path& directory, const shard& part = {});

/// Where a run keeps a text under a name.
std::filesystem::path kept_path(const std::filesystem::path& directory, std::string_view name);
void remove_kept(const std::filesystem::path& directory);

/// Copies the kept texts that are not there yet.
void copy_kept(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes tiles, kept texts, description, temporary files and dead shards' locks, and the
/// directory once it is empty.
void remove_directory(const std::filesystem::path& directory);

void write_run_description(const std::filesystem::path& directory, const map_description& map);

/// \error store_error where there is none or it cannot be read
map_description read_run_description(const std::filesystem::path& directory);

/// \error store_error where `there`, the fingerprint found at `place`, is not the scene's
void require_same_scene(const std::filesystem::path& place, const std::string& there,
                        const std::string& fingerprint);

}  // namespace hopscotch
