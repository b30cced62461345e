// A map against higher precision: random cells are computed again in double-double, those that
// disagree once more with 50 digits, which decide. Made at the end of every run and by `verify`.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/label_plan.hpp"
#include "host/run/layer_errors.hpp"
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
    std::uint64_t seed = 0;
    std::vector<cell_verdict> wrong;
    std::uint64_t n_wrong = 0;
    double share = 0.0;   // of wrong cells
    double lowest = 0.0;  // its 95 % confidence interval, see confidence.hpp
    double highest = 1.0;
    std::uint64_t n_uncertain = 0;      // cells flagged as in the layer `uncertain`
    std::uint64_t n_wrong_certain = 0;  // wrong ones among the others
    std::vector<layer_error> errors;    // of the numeric layers
    std::uint64_t worst = 0;  // the first wrong cell, or else that of the largest relative error
};

/// Gives the numbers of a tile of the map.
using tile_source = std::function<tile_data(std::uint64_t tile)>;

/// One cell in higher precision.
cell_verdict judge(const scene& scene, const label_plan& plan, std::uint64_t cell, int stored);

/// Audits `n` random cells, in parallel. Which ones, the scene's fingerprint and `seed` decide: the
/// same for the same map on every machine, whatever threads or processes computed it.
/// \param seed  0 for the cells that a run itself audits
/// \error interruption on a signal; whatever `tiles` throws
audit_report audit(const scene& scene, const label_plan& plan, const tile_source& tiles,
                   std::uint64_t n, std::uint64_t seed = 0);

/// The cells that `audit` looks at, rising.
std::vector<std::uint64_t> audited_cells(const scene& scene, std::uint64_t n, std::uint64_t seed);

/// The audit as attributes of the map, with the command that replays its worst cell.
attribute_list attributes_of(const scene& scene, const audit_report& report,
                             const std::filesystem::path& map);

/// The command that shows a cell in every precision.
std::string replay_command(const scene& scene, const std::filesystem::path& map,
                           std::uint64_t cell);

/// "3,17" as `replay --cell` takes it.
std::string cell_text(const scene& scene, std::uint64_t cell);

}  // namespace hopscotch
