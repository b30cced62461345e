// Cells that a first pass over a map leaves without a label: their orbits went on for all returns
// and met no trap. They are searched once more for attractors that samples have missed.
#pragma once

#include "host/scene/scene.hpp"
#include "host/store/map_run.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hopscotch {

/// The attribute of a map that names the cells its second search started from.
inline constexpr const char* searched_cells = "searched_cells";

struct open_cells {
    std::vector<std::uint64_t> sample;  // rising; the same for every tile size
    std::vector<std::uint64_t> tiles;   // every tile that holds such a cell
};

/// \param most  size of the sample
open_cells find_open_cells(const scene& scene, const map_run& run, std::size_t most = 512);

/// The cells of an attribute `searched_cells`, and its text.
std::vector<std::uint64_t> cells_of(std::string_view text);
std::string text_of(std::span<const std::uint64_t> cells);

}  // namespace hopscotch
