// Looks up chaotic sets.
#include "host/run/label_plan.hpp"

#include <algorithm>

namespace hopscotch {

std::int16_t label_plan::chaotic_label(std::size_t point, std::span<const double> state) const {
    const auto [first, last] = std::equal_range(
        chaotic.begin(), chaotic.end(), chaotic_set{point, 0, {}},
        [](const chaotic_set& a, const chaotic_set& b) { return a.point < b.point; });
    for (auto set = first; set != last; ++set) {
        if (set->cover.holds(state)) return set->label;
    }
    return 0;
}

}  // namespace hopscotch
