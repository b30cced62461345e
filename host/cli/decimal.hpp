// Decimal numbers in input files: any length, correctly rounded, independent of the locale.
#pragma once

#include <optional>
#include <string_view>

namespace hopscotch {

/// The nearest double; "inf" and "-inf" too. Nothing where the text is no number (NaN is none).
std::optional<double> parse_decimal(std::string_view text);

}  // namespace hopscotch
