// When an orbit has a section state to show: not where the start was refused, and from a section
// that only starts orbits not before the first return.
#pragma once

#include "kernels/contract/info.hpp"

#include <cstdint>

namespace hopscotch {

inline bool has_state(const model_info& info, int section, outcome end, std::uint32_t returns) {
    if (end == outcome::invalid_start) return false;
    const bool is_start_only =
        info.sections[static_cast<std::size_t>(section)].returns_to != section;
    return !is_start_only || returns > 0;
}

}  // namespace hopscotch
