// Where an axis or colour bar is marked, and with which words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hopscotch::picture {

struct tick {
    double value = 0.0;
    std::string label;  // empty: a small mark between labelled ones
};

/// About n labelled ticks at round numbers in [lowest, highest].
std::vector<tick> linear_ticks(double lowest, double highest, int n);

/// Ticks at powers of ten (or 1, 2, 5 times them where the range is short); lowest > 0.
std::vector<tick> log_ticks(double lowest, double highest, int n);

/// "liftoff_speed", "m s-1" -> "liftoff speed (m s^{-1})"; no unit where it is 1.
std::string axis_title(std::string_view name, std::string_view unit);

/// A number for a title: four significant digits.
std::string short_number(double value);

}  // namespace hopscotch::picture
