// Draws a map file as a PNG picture: axes with names and units, title, legend of the labels (with
// their shares) or colour bar. Used by the command `render` and at the end of `run`.
#pragma once

#include <filesystem>
#include <string>

namespace hopscotch {

/// \param map    a map file or run directory
/// \param png    the picture; replaced where it exists
/// \param layer  name of the layer; empty: `label`, else the first layer
/// \error        store_error (no such file or layer, picture cannot be written)
///
/// The first axis runs to the right, the second one upward. Large maps are read with a stride
/// (memory stays bounded), small ones magnified; of maps with more axes the others stay at their
/// first cell, which the title says; a map with one axis is drawn as a curve or as a strip of
/// colours.
void render_map(const std::filesystem::path& map, const std::filesystem::path& png,
                const std::string& layer = {});

}  // namespace hopscotch
