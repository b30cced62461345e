// A map against higher precision: random cells are computed again in double-double, those that
// disagree once more with 50 digits, which decide. Made at the end of every run and by `verify`.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace hopscotch {

/// The layer whose values are judged: the label where the map has labels, the motion of a chaos
/// map, else the outcome.
std::string_view judged_layer(const scene& scene);

/// What is compared of a cell. An undecided motion contradicts nothing: `computed` is then
/// `stored`.
struct cell_verdict {
    std::uint64_t cell = 0;
    int stored = 0;
    int computed = 0;
    bool agrees() const { return stored == computed; }
};

struct audit_report {
    std::uint64_t n_cells = 0;
    std::vector<cell_verdict> wrong;
    std::uint64_t n_wrong = 0;
    double share = 0.0;   // of wrong cells
    double lowest = 0.0;  // its 95 % confidence interval (Wilson)
    double highest = 1.0;
};

/// Gives the numbers of a tile of the map.
using tile_source = std::function<tile_data(std::uint64_t tile)>;

/// One cell in higher precision.
cell_verdict judge(const scene& scene, const label_plan& plan, std::uint64_t cell, int stored);

/// Audits `n` random cells, in parallel.
/// \error interruption on a signal; whatever `tiles` throws
audit_report audit(const scene& scene, const label_plan& plan, const tile_source& tiles,
                   std::uint64_t n, std::uint64_t seed = 1);

/// The audit as attributes of the map, with the command that replays its first wrong cell.
attribute_list attributes_of(const scene& scene, const audit_report& report,
                             const std::filesystem::path& map);

/// 95 % confidence interval of a share (Wilson's score).
std::pair<double, double> confidence_of(std::uint64_t hits, std::uint64_t n);

/// "3,17" as `replay --cell` takes it.
std::string cell_text(const scene& scene, std::uint64_t cell);

}  // namespace hopscotch
