// Ranges of parameters and columns as users read them.
#include "host/scene/range_text.hpp"

#include <fmt/format.h>

namespace hopscotch {

std::string written(const range& range) {
    return fmt::format("{}{}, {}{}", range.has_lowest ? '[' : '(', range.lowest, range.highest,
                       range.has_highest ? ']' : ')');
}

}  // namespace hopscotch
