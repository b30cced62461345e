// Walks over the cells and neighbours of boxes of a grid with any number of axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopscotch::refine {

using coordinates = std::vector<std::uint64_t>;
inline constexpr std::size_t most_axes = 8;  // a scene has no more
using cell_index = std::array<std::uint64_t, most_axes>;

inline std::uint64_t ceiling(std::uint64_t n, std::uint64_t size) { return (n + size - 1) / size; }

/// Calls visit(offset) for every offset in {lowest, ..., 1}^n.
template <class Visit>
void for_each_offset(std::size_t n, int lowest, Visit&& visit) {
    std::vector<int> offset(n, lowest);
    while (true) {
        visit(offset);
        std::size_t digit = n;
        while (digit > 0 && offset[digit - 1] == 1) offset[--digit] = lowest;
        if (digit == 0) return;
        ++offset[digit - 1];
    }
}

/// Calls visit(position, k) for every position in a box of that extent, in C order.
template <class Visit>
void for_each_position(const coordinates& extent, Visit&& visit) {
    std::uint64_t n = 1;
    for (const std::uint64_t each : extent) n *= each;
    cell_index position{};
    for (std::uint64_t k = 0; k < n; ++k) {
        visit(position, k);
        for (std::size_t i = extent.size(); i-- > 0;) {
            if (++position[i] < extent[i]) break;
            position[i] = 0;
        }
    }
}

}  // namespace hopscotch::refine
