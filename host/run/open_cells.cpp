// Reads the finished tiles one by one and keeps the cells of smallest hash.
#include "host/run/open_cells.hpp"

#include "host/map/numbers.hpp"
#include "host/map/rows.hpp"
#include "host/scene/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace hopscotch {
namespace {

/// Murmur3's finaliser: cells in an order that knows nothing of tiles.
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdull;
    x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ull;
    return x ^ (x >> 33);
}

bool has_value(const value_counts& counts, int value) {
    const auto found = counts.find(value);
    return found != counts.end() && found->second > 0;
}

}  // namespace

open_cells find_open_cells(const scene& scene, const map_run& run, std::size_t most) {
    constexpr int spent = static_cast<int>(outcome::budget);
    open_cells open;
    if (!has_value(run.counts("outcome"), spent)) return open;
    const map_layout layout = layout_of(scene);
    const std::size_t outcomes = layer_index(layout, "outcome");
    std::vector<std::uint64_t> shape;
    for (const axis& along : layout.axes) shape.push_back(along.size());
    std::vector<std::pair<std::uint64_t, std::uint64_t>> kept;  // (hash, cell): the smallest
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        const tile_data data = run.read(tile);
        bool is_open = false;
        for (std::uint64_t i = 0; i < data.box.n_cells(); ++i) {
            const double end = number_at(number_type::int8, data.layers[outcomes].data(), i);
            if (static_cast<int>(end) != spent) continue;
            is_open = true;
            const std::uint64_t cell = offset_in(shape, coordinates_in(data.box, i));
            kept.emplace_back(mixed(cell), cell);
        }
        if (is_open) open.tiles.push_back(tile);
        if (kept.size() <= most) continue;
        std::nth_element(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(most),
                         kept.end());
        kept.resize(most);
    }
    for (const auto& [hash, cell] : kept) open.sample.push_back(cell);
    std::sort(open.sample.begin(), open.sample.end());
    return open;
}

std::vector<std::uint64_t> cells_of(std::string_view text) {
    std::vector<std::uint64_t> cells;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        std::uint64_t cell = 0;
        const auto [next, failure] = std::from_chars(at, end, cell);
        if (failure != std::errc{}) break;
        cells.push_back(cell);
        at = next == end ? end : next + 1;
    }
    return cells;
}

std::string text_of(std::span<const std::uint64_t> cells) {
    return fmt::format("{}", fmt::join(cells, " "));
}

}  // namespace hopscotch
