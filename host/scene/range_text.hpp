// Ranges of parameters and columns as users read them.
#pragma once

#include "kernels/contract/info.hpp"

#include <string>

namespace hopscotch {

/// "(0, inf)", "[0, 1]".
std::string written(const range& range);

}  // namespace hopscotch
