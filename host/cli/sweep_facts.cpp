// What the analysis tells of every map of a sweep.
#include "host/cli/sweep_facts.hpp"

#include "analysis/metrics/entropy.hpp"
#include "analysis/metrics/read_classes.hpp"
#include "analysis/metrics/shares.hpp"
#include "host/cli/run_answer.hpp"

#include <algorithm>
#include <limits>

namespace hopscotch {
namespace {

/// The layer that tells basins apart: labels, the motion of a chaos map, else the outcome.
std::string classifying_layer(const map_reader& map) {
    for (const char* name : {"label", "motion"}) {
        const auto& layers = map.layout().layers;
        if (layer_index(map.layout(), name) < layers.size()) return name;
    }
    return "outcome";
}

/// Shares with errors and basin entropy, as `analyse` has them. Maps of more than three axes have
/// no metrics: NaN.
map_facts facts_of(const map_reader& map) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    map_facts facts{{}, nan, nan, nan};
    const auto n_axes = std::count_if(map.layout().axes.begin(), map.layout().axes.end(),
                                      [](const axis& each) { return each.size() > 1; });
    if (n_axes < 1 || n_axes > 3) return facts;
    const metrics::class_grid grid = metrics::read_classes(map, {classifying_layer(map), {}});
    const auto n_cells = static_cast<double>(grid.cells.size());
    facts.undecided = static_cast<double>(grid.n_without_class()) / n_cells;
    const metrics::basin_shares shares = metrics::shares_in(grid, metrics::value_box::whole(grid));
    for (std::size_t i = 0; i < grid.classes.size(); ++i) {
        const metrics::basin_class& each = grid.classes[i];
        facts.basins.push_back({each.value, each.is_outcome, each.name, shares.classes[i].share,
                                shares.classes[i].error});
    }
    const std::uint64_t box = metrics::default_box(grid);
    if (box < 2) return facts;
    const metrics::basin_entropy entropy = metrics::entropy_of(grid, box);
    facts.entropy = entropy.whole;
    facts.boundary_entropy = entropy.boundary;
    return facts;
}

}  // namespace

sweep_hooks hooks_of_sweep() { return {hooks_of, facts_of}; }

}  // namespace hopscotch
