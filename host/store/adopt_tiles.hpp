// Takes tiles of the same map from other run directories, e.g. those of shards that ran on machines
// without a common file system. Used when a run is opened to be merged.
#pragma once

#include "host/map/layout.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

/// Copies the sound tiles that `directory` lacks, and the records of shards.
///
/// \return  what the user should read: damaged tiles that were not taken
/// \error   store_error where `other` is no run directory, of another scene or grid, or cannot be
///          read
std::vector<std::string> adopt_tiles(const std::filesystem::path& directory,
                                     const std::filesystem::path& other, const map_layout& layout,
                                     const std::string& fingerprint);

/// \error  store_error where the run directory is one of another scene, grid or tiling
void require_same_run(const std::filesystem::path& directory, const map_layout& layout,
                      const std::string& fingerprint);

}  // namespace hopscotch
