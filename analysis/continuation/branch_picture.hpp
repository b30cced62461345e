// Draws branches over their variable: stable parts as thick lines, unstable ones thin, grey and
// dashed, special points as dots.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hopscotch {

/// \param column  the state column upward
/// \error         store_error where the picture cannot be written
void draw_branches(const branch_family& family, const std::vector<branch>& branches, int column,
                   const std::string& title, const std::filesystem::path& png);

}  // namespace hopscotch
