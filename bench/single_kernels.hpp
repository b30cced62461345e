// The ensemble loops in IEEE binary32: what float32 kernels would answer.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <string_view>

namespace hopscotch::bench {

/// One ensemble function per variant of the model, or null where float32 is not built: models with
/// tables or series made for double alone.
const ensemble_function* single_kernels(std::string_view model);

}  // namespace hopscotch::bench
