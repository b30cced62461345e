// Colours of pictures: distinct ones for labels and outcomes (Okabe and Ito: told apart with every
// kind of colour vision), scales for numbers (perceptually uniform, monotonic in lightness).
#pragma once

#include "analysis/render/canvas.hpp"

#include <string_view>

namespace hopscotch::picture {

inline constexpr rgb not_computed = rgb::of(0xececec);
inline constexpr rgb no_value = rgb::of(0xb0b0b0);
inline constexpr rgb undecided = rgb::of(0x3a3a3a);  // no label, budget spent, not finite ...

/// The i-th of many distinct colours.
rgb distinct_colour(std::size_t i);

/// The colour of an outcome by its name; outcomes that decide nothing are dark grey.
rgb outcome_colour(std::string_view name, std::size_t i);

/// A sequential scale from dark to light, share in [0, 1] (viridis).
rgb sequential(double share);

/// A diverging scale, 0.5 is neutral: blue below, red above.
rgb diverging(double share);

}  // namespace hopscotch::picture
