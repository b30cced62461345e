// What the values of the layer `uncertain` mean.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hopscotch {

enum class certainty : std::uint8_t {
    certain,
    answer_changes,  // another label, outcome, motion (or number of steps to a fall)
    events_change,   // the same answer with another number of events: a guard was passed that close
};

inline constexpr std::array<std::string_view, 3> certainty_names{"certain", "answer_changes",
                                                                 "events_change"};

}  // namespace hopscotch
