// Which shards of a run have ever begun, and where: what `merge` says about tiles that are missing.
#pragma once

#include "host/map/shard.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

/// Notes that a shard has begun. \error store_error
void record_shard(const std::filesystem::path& directory, const shard& part);

/// Which tiles are missing, by shards where the run was one of shards; one line.
///
/// \param missing  tiles, rising, not empty
/// \param n_tiles  of the whole map
std::string missing_words(const std::filesystem::path& directory,
                          const std::vector<std::uint64_t>& missing, std::uint64_t n_tiles);

/// What to do about them.
std::string missing_remedy(const std::filesystem::path& directory,
                           const std::vector<std::uint64_t>& missing);

}  // namespace hopscotch
