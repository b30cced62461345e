// The little JSON that this program writes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// In quotes, with everything escaped that must be.
std::string json_text(std::string_view text);
std::string json_texts(const std::vector<std::string>& texts);

/// 17 significant digits; null where JSON has no word for it.
std::string json_number(double x);
std::string json_numbers(std::span<const double> numbers);

}  // namespace hopscotch
