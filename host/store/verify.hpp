// Finds what is wrong with a map on disk: missing tiles, checksums that do not match, chunks that
// do not decode, a hash that is not the map's. Used by `verify` and by tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

struct map_problem {
    enum class kind : std::uint8_t { unreadable_file, missing_tile, damaged_tile, wrong_hash };

    kind what;
    std::uint64_t tile = 0;  // where it concerns one tile
    std::string text;        // one line: PLACE (reason); suggestion?
};

/// Reads every tile of a map file or run directory; empty where all is well. Memory: one tile.
std::vector<map_problem> verify_file(const std::filesystem::path& path);

}  // namespace hopscotch
