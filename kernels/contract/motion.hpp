// What an orbit's largest Lyapunov exponent says about its motion: one value per cell of a chaos
// map. The codes are part of the file format and only ever grow.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hopscotch {

enum class motion : std::uint8_t {
    ended,       // the orbit ended before it could be judged; the outcome says why
    periodic,    // the largest exponent is below zero by more than the scene's standard errors
    chaotic,     // it is above zero by more than that
    undecided,   // neither, or it still drifts
    not_smooth,  // the derivative of the return map is not finite (grazing): no exponent
};

inline constexpr std::array<std::string_view, 5> motion_names{"ended", "periodic", "chaotic",
                                                              "undecided", "not_smooth"};

}  // namespace hopscotch
