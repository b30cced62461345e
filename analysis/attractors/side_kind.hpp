// What an orbit does to starts next to it on one side.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hopscotch {

/// The codes are part of the file format.
enum class side_kind : std::uint8_t {
    attracting,
    neutral,    // starts stay where they are, to rounding
    repelling,  // or the orbits from there end
};

inline constexpr std::array<std::string_view, 3> side_kind_names{"attracting", "neutral",
                                                                 "repelling"};

/// A start at distance d that the map moves by less than this share of d stays where it is.
inline constexpr double neutral_step = 1e-8;

}  // namespace hopscotch
