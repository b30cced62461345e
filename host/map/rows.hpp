// Walks over a rectangle of cells row by row: the runs of cells that are contiguous along the last
// axis.
#pragma once

#include <cstdint>
#include <vector>

namespace hopscotch {

/// Calls visit(position) for every row of a box: `position` holds the coordinates of the row's
/// first cell relative to the box (the last one is 0), in C order. Nothing is called for an empty
/// box.
template <class Visit>
void for_each_row(const std::vector<std::uint64_t>& extent, Visit&& visit) {
    for (const std::uint64_t size : extent) {
        if (size == 0) return;
    }
    std::vector<std::uint64_t> position(extent.size(), 0);
    while (true) {
        visit(position);
        std::size_t digit = extent.size();
        do {
            if (digit <= 1) return;  // every axis but the last has run over
            --digit;
            position[digit - 1] = (position[digit - 1] + 1) % extent[digit - 1];
        } while (position[digit - 1] == 0);
    }
}

/// C-order offset of a position in an array of that shape.
inline std::uint64_t offset_in(const std::vector<std::uint64_t>& shape,
                               const std::vector<std::uint64_t>& position) {
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < shape.size(); ++i) offset = offset * shape[i] + position[i];
    return offset;
}

}  // namespace hopscotch
