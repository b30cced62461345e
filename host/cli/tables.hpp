// Aligned text for terminals.
#pragma once

#include <string>
#include <vector>

namespace hopscotch {

/// Rows of cells, columns padded to their widest cell, two blanks between them, each line indented.
std::string aligned(const std::vector<std::vector<std::string>>& rows, int indent = 2);

}  // namespace hopscotch
