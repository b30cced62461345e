// Samples, recomputes, counts.
#include "host/run/audit.hpp"

#include "host/map/numbers.hpp"
#include "host/run/estimate.hpp"
#include "host/run/requests.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace hopscotch {
namespace {

int compared(const scene& scene, const orbit_answer& answer) {
    return scene.question.has_labels ? answer.label : static_cast<int>(answer.end);
}

/// The motion in double-double. There is no third opinion: orbits of thousands of returns in 50
/// digits are out of reach.
int judged_motion(const scene& scene, const orbit_row& row, int stored) {
    constexpr int undecided = static_cast<int>(motion::undecided);
    const int computed = static_cast<int>(run_exponents(scene, row).motion);
    return stored == undecided || computed == undecided ? stored : computed;
}

std::size_t compared_layer(const scene& scene, const map_layout& layout) {
    const std::string_view name = judged_layer(scene);
    std::size_t index = 0;
    while (layout.layers[index].name != name) ++index;  // both are always stored
    return index;
}

/// Where a cell lies: its tile, and its place within the tile.
std::pair<std::uint64_t, std::uint64_t> place_of(const map_layout& layout,
                                                 std::span<const std::uint64_t> coordinates) {
    const std::vector<std::uint64_t> extent = full_tile(layout);
    const std::vector<std::uint64_t> along = layout.tiles_along();
    std::uint64_t tile = 0;
    for (std::size_t axis = 0; axis < along.size(); ++axis) {
        tile = tile * along[axis] + coordinates[axis] / extent[axis];
    }
    const tile_box box = box_of(layout, tile);
    std::uint64_t within = 0;
    for (std::size_t axis = 0; axis < along.size(); ++axis) {
        within = within * box.extent[axis] + coordinates[axis] - box.origin[axis];
    }
    return {tile, within};
}

/// The stored values of some cells, reading every tile at most once.
std::vector<int> stored_values(const scene& scene, const tile_source& tiles,
                               const std::vector<std::uint64_t>& cells) {
    const map_layout layout = layout_of(scene);
    const std::size_t layer = compared_layer(scene, layout);
    std::map<std::uint64_t, std::vector<std::pair<std::size_t, std::uint64_t>>> by_tile;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto [tile, within] = place_of(layout, coordinates_of(scene, cells[i]));
        by_tile[tile].emplace_back(i, within);
    }
    std::vector<int> values(cells.size());
    for (const auto& [tile, wanted] : by_tile) {
        const tile_data data = tiles(tile);
        const number_type type = layout.layers[layer].type;
        for (const auto& [i, within] : wanted) {
            values[i] = static_cast<int>(number_at(type, data.layers[layer].data(), within));
        }
    }
    return values;
}

}  // namespace

std::string_view judged_layer(const scene& scene) {
    if (is_chaos_map(scene)) return "motion";
    return scene.question.has_labels ? "label" : "outcome";
}

cell_verdict judge(const scene& scene, const label_plan& plan, std::uint64_t cell, int stored) {
    const std::vector<std::uint64_t> coordinates = coordinates_of(scene, cell);
    if (plan.of_cell) return judge(scene, plan.of_cell(coordinates), cell, stored);
    const owned_row row = row_of(scene, plan, coordinates);
    if (is_chaos_map(scene)) return {cell, stored, judged_motion(scene, row.row, stored)};
    cell_verdict verdict{cell, stored, 0};
    for (const precision value : {precision::dd, precision::mp50}) {
        verdict.computed = compared(scene, run_cell(scene, plan, coordinates, value, row.row));
        if (verdict.agrees()) break;
    }
    return verdict;
}

audit_report audit(const scene& scene, const label_plan& plan, const tile_source& tiles,
                   std::uint64_t n, std::uint64_t seed) {
    const std::vector<std::uint64_t> cells = sample_cells(scene.n_cells(), n, seed);
    const std::vector<int> stored = stored_values(scene, tiles, cells);
    std::vector<cell_verdict> verdicts(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        if (stop_condition::is_interrupted()) throw interruption();
        verdicts[i] = judge(scene, plan, cells[i], stored[i]);
    });
    audit_report report;
    report.n_cells = cells.size();
    for (const cell_verdict& verdict : verdicts) {
        if (!verdict.agrees()) report.wrong.push_back(verdict);
    }
    report.n_wrong = report.wrong.size();
    if (report.n_cells > 0) {
        report.share = static_cast<double>(report.n_wrong) / static_cast<double>(report.n_cells);
    }
    std::tie(report.lowest, report.highest) = confidence_of(report.n_wrong, report.n_cells);
    return report;
}

attribute_list attributes_of(const scene& scene, const audit_report& report,
                             const std::filesystem::path& map) {
    attribute_list attributes{
        {"audit_cells", fmt::format("{}", report.n_cells)},
        {"audit_wrong", fmt::format("{}", report.n_wrong)},
        {"audit_share", fmt::format("{:.17g}", report.share)},
        {"audit_interval",
         fmt::format("{:.17g} to {:.17g} (95 %, Wilson)", report.lowest, report.highest)},
        {"audit_method", is_chaos_map(scene) ? "motion in dd" : "dd, disputed cells mp50"}};
    if (!report.wrong.empty()) {
        attributes.emplace_back("audit_replay",
                                fmt::format("hopscotch replay {} --cell {}", map.string(),
                                            cell_text(scene, report.wrong[0].cell)));
    }
    return attributes;
}

std::pair<double, double> confidence_of(std::uint64_t hits, std::uint64_t n) {
    if (n == 0) return {0.0, 1.0};
    constexpr double z = 1.959963984540054;  // 97.5 % quantile of the normal distribution
    const auto total = static_cast<double>(n);
    const double share = static_cast<double>(hits) / total;
    const double centre = share + z * z / (2.0 * total);
    const double width =
        z * std::sqrt(share * (1.0 - share) / total + z * z / (4.0 * total * total));
    const double scale = 1.0 + z * z / total;
    const double lowest = hits == 0 ? 0.0 : (centre - width) / scale;
    const double highest = hits == n ? 1.0 : (centre + width) / scale;
    return {std::max(lowest, 0.0), std::min(highest, 1.0)};
}

std::string cell_text(const scene& scene, std::uint64_t cell) {
    return fmt::format("{}", fmt::join(coordinates_of(scene, cell), ","));
}

}  // namespace hopscotch
