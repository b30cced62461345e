// What the values of the layer `uncertain` mean.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hopscotch {

enum class certainty : std::uint8_t {
    certain,
    answer_changes,  // another label, outcome, motion (or number of steps to a fall)
    events_change,   // the same answer after another number of returns or events: a guard, or the
                     // edge of a trap, was passed that close; or no label, in another place
};

inline constexpr std::array<std::string_view, 3> certainty_names{"certain", "answer_changes",
                                                                 "events_change"};

}  // namespace hopscotch
