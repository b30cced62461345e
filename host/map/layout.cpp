#include "host/map/layout.hpp"

#include <algorithm>
#include <stdexcept>

namespace hopscotch {

namespace {

std::uint64_t product(const std::vector<std::uint64_t>& factors) {
    std::uint64_t result = 1;
    for (const std::uint64_t factor : factors) result *= factor;
    return result;
}

}  // namespace

std::uint64_t map_layout::n_cells() const {
    std::uint64_t result = 1;
    for (const axis& each : axes) result *= each.size();
    return result;
}

std::vector<std::uint64_t> full_tile(const map_layout& layout) {
    std::vector<std::uint64_t> extent;
    for (std::size_t i = 0; i < layout.axes.size(); ++i) {
        const std::uint64_t wanted =
            i < layout.tile.size() && layout.tile[i] > 0 ? layout.tile[i] : layout.axes[i].size();
        extent.push_back(std::min(wanted, layout.axes[i].size()));
    }
    return extent;
}

std::vector<std::uint64_t> map_layout::tiles_along() const {
    std::vector<std::uint64_t> result = full_tile(*this);
    for (std::size_t i = 0; i < axes.size(); ++i) {
        result[i] = result[i] == 0 ? 0 : (axes[i].size() + result[i] - 1) / result[i];
    }
    return result;
}

std::uint64_t map_layout::n_tiles() const { return product(tiles_along()); }

std::uint64_t tile_box::n_cells() const { return product(extent); }

tile_box box_of(const map_layout& layout, std::uint64_t tile_index) {
    const std::vector<std::uint64_t> along = layout.tiles_along();
    const std::vector<std::uint64_t> full = full_tile(layout);
    if (tile_index >= product(along)) {
        throw std::out_of_range("tile " + std::to_string(tile_index) + " of a map with " +
                                std::to_string(product(along)) + " tiles");
    }
    tile_box box{tile_index, full, full};
    std::uint64_t rest = tile_index;
    for (std::size_t i = along.size(); i-- > 0; rest /= along[i]) {
        box.origin[i] = (rest % along[i]) * full[i];
        box.extent[i] = std::min(full[i], layout.axes[i].size() - box.origin[i]);
    }
    return box;
}

std::size_t layer_index(const map_layout& layout, std::string_view name) {
    const auto found = std::find_if(layout.layers.begin(), layout.layers.end(),
                                    [name](const layer& each) { return each.name == name; });
    return static_cast<std::size_t>(found - layout.layers.begin());
}

std::vector<std::uint64_t> coordinates_in(const tile_box& box, std::uint64_t cell) {
    std::vector<std::uint64_t> coordinates(box.extent.size());
    for (std::size_t axis = box.extent.size(); axis-- > 0;) {
        coordinates[axis] = box.origin[axis] + cell % box.extent[axis];
        cell /= box.extent[axis];
    }
    return coordinates;
}

}  // namespace hopscotch
