// Blocks of a tile and of its rim: where they lie, and whether they differ.
#include "host/refine/block_view.hpp"

#include "host/map/rows.hpp"

#include <algorithm>

namespace hopscotch::refine {

std::uint64_t block_view::at(const cell_index& block) const {
    std::uint64_t offset = 0;
    for (std::size_t i = 0; i < extent.size(); ++i) offset = offset * extent[i] + block[i] + 1;
    return offset;
}

bool block_view::differs_at(std::uint64_t block) const {
    const std::uint64_t* const own = classes.data() + block;
    return std::any_of(neighbours.begin(), neighbours.end(),
                       [own](std::ptrdiff_t distance) { return own[distance] != *own; });
}

block_view empty_view(const tile_box& box, std::uint64_t size) {
    block_view view;
    view.size = size;
    std::uint64_t n = 1;
    for (const std::uint64_t cells : box.extent) {
        view.blocks.push_back(ceiling(cells, size));
        view.extent.push_back(view.blocks.back() + 2);
        n *= view.extent.back();
    }
    view.classes.resize(n);
    for_each_offset(view.extent.size(), -1, [&](const std::vector<int>& offset) {
        std::ptrdiff_t distance = 0;
        for (std::size_t i = 0; i < offset.size(); ++i) {
            distance = distance * static_cast<std::ptrdiff_t>(view.extent[i]) + offset[i];
        }
        if (distance != 0) view.neighbours.push_back(distance);
    });
    return view;
}

bool is_uniform(const tiles_around& around) {
    const std::uint64_t own = own_tile(around).classes.front();
    return std::all_of(around.begin(), around.end(), [own](const auto& tile) {
        return tile == nullptr || (tile->is_uniform && tile->classes.front() == own);
    });
}

std::vector<place_along> places_along(const map_layout& layout, const tile_box& box,
                                      const block_view& view, std::size_t axis) {
    const std::uint64_t tile = full_tile(layout)[axis];
    const std::uint64_t own = box.origin[axis] / tile;
    const std::uint64_t first = box.origin[axis] / view.size;
    const std::uint64_t last = ceiling(layout.axes[axis].size(), view.size) - 1;
    std::vector<place_along> places;
    for (std::uint64_t k = 0; k < view.extent[axis]; ++k) {
        const std::uint64_t block = std::min(first + k == 0 ? 0 : first + k - 1, last);
        const std::uint64_t cell = block * view.size;
        places.push_back({cell / tile + 1 - own, cell % tile});
    }
    return places;
}

}  // namespace hopscotch::refine
