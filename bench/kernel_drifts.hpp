// Drift of what a return conserves, of models that no general solver is compared with. Part of
// work_precision.
#pragma once

#include <functional>
#include <string_view>

namespace hopscotch::bench {

/// Measures the models whose names `is_wanted` says yes to, and prints their lines.
void put_kernel_drifts(const std::function<bool(std::string_view)>& is_wanted);

}  // namespace hopscotch::bench
