// Writes a picture as a PNG file, under a temporary name first.
#pragma once

#include "analysis/render/canvas.hpp"

#include <filesystem>

namespace hopscotch::picture {

/// \error  store_error where the file cannot be written
void write_png(const std::filesystem::path& path, const canvas& picture);

}  // namespace hopscotch::picture
