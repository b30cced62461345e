// Edit distance (optimal string alignment) and the choice of the closest name.
#include "host/scene/suggest.hpp"

#include <algorithm>

namespace hopscotch {

int edit_distance(std::string_view one, std::string_view other) {
    const std::size_t width = other.size() + 1;
    std::vector<int> distance((one.size() + 1) * width);
    const auto at = [&](std::size_t i, std::size_t j) -> int& { return distance[i * width + j]; };
    for (std::size_t i = 0; i <= one.size(); ++i) at(i, 0) = static_cast<int>(i);
    for (std::size_t j = 0; j <= other.size(); ++j) at(0, j) = static_cast<int>(j);
    for (std::size_t i = 1; i <= one.size(); ++i) {
        for (std::size_t j = 1; j <= other.size(); ++j) {
            const int replaced = at(i - 1, j - 1) + (one[i - 1] == other[j - 1] ? 0 : 1);
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
            const bool is_swap =
                i > 1 && j > 1 && one[i - 1] == other[j - 2] && one[i - 2] == other[j - 1];
            if (is_swap) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    }
    return at(one.size(), other.size());
}

namespace {

bool is_close(std::string_view name, std::string_view known, int distance) {
    const std::size_t letters = std::max(name.size(), known.size());
    if (static_cast<std::size_t>(distance) * 5 <= letters * 2) return true;
    const bool is_part = known.find(name) != known.npos || name.find(known) != name.npos;
    return is_part && std::min(name.size(), known.size()) >= 3;
}

}  // namespace

std::string closest(std::string_view name, std::span<const std::string_view> known) {
    std::string_view best;
    int least = 0;
    for (const std::string_view candidate : known) {
        const int distance = edit_distance(name, candidate);
        if (!is_close(name, candidate, distance)) continue;
        if (!best.empty() && distance >= least) continue;
        best = candidate;
        least = distance;
    }
    return std::string(best);
}

std::string listed(std::span<const std::string_view> names) {
    std::string text;
    for (const std::string_view name : names) {
        if (!text.empty()) text += ", ";
        text += name;
    }
    return text;
}

std::string suggest(std::string_view name, std::span<const std::string_view> known) {
    if (std::string near = closest(name, known); !near.empty()) return near;
    if (known.empty()) return "";
    return known.size() == 1 ? std::string(known.front()) : "one of " + listed(known);
}

}  // namespace hopscotch
