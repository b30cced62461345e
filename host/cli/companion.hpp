// Names of the files that lie beside a map.
#pragma once

#include <filesystem>
#include <string>

namespace hopscotch {

/// A file beside the map, of the same name up to its ending.
inline std::filesystem::path companion(std::filesystem::path map, const std::string& ending) {
    if (map.extension() == ending) return map += ending;
    return map.replace_extension(ending);
}

}  // namespace hopscotch
