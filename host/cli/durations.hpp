// Durations as users type them.
#pragma once

#include <string_view>

namespace hopscotch {

/// Seconds of "H:MM:SS", "M:SS" or "S". \error usage_error
double seconds_of(std::string_view text);

}  // namespace hopscotch
