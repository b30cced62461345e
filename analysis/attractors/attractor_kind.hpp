// What an orbit may settle on.
#pragma once

#include <cstdint>

namespace hopscotch {

enum class attractor_kind : std::uint8_t { resting, fixed_point, cycle, chaotic };

}  // namespace hopscotch
