// Samples, recomputes, counts.
#include "host/run/audit.hpp"

#include "host/map/numbers.hpp"
#include "host/refine/refinement.hpp"
#include "host/run/confidence.hpp"
#include "host/run/estimate.hpp"
#include "host/run/requests.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/run/uncertain.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace hopscotch {
namespace {

/// What the map says of one cell: its verdict, then its numeric layers.
struct stored_cell {
    int verdict = 0;
    std::vector<double> numbers;
    bool is_inherited = false;  // of a coarser cell: refinement has not computed it
};

struct judged_cell {
    cell_verdict verdict;
    cell_errors errors;
    bool is_uncertain = false;  // see uncertain.hpp
};

int compared(const scene& scene, const orbit_answer& answer) {
    return scene.question.has_labels ? answer.label : static_cast<int>(answer.end);
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
std::vector<stored_cell> stored_cells(const scene& scene, std::span<const layer_plan> numeric,
                                      const tile_source& tiles,
                                      const std::vector<std::uint64_t>& cells) {
    const map_layout layout = layout_of(scene);
    std::map<std::uint64_t, std::vector<std::pair<std::size_t, std::uint64_t>>> by_tile;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto [tile, within] = place_of(layout, coordinates_of(scene, cells[i]));
        by_tile[tile].emplace_back(i, within);
    }
    std::vector<stored_cell> values(cells.size());
    for (const auto& [tile, wanted] : by_tile) {
        const tile_data data = tiles(tile);
        for (const auto& [i, within] : wanted) {
            const auto value = [&, at = within](std::string_view name) {
                const std::size_t layer = layer_index(layout, name);
                return number_at(layout.layers[layer].type, data.layers[layer].data(), at);
            };
            values[i].verdict = static_cast<int>(value(judged_layer(scene)));
            values[i].is_inherited = scene.refine > 0 && value("level") == refine::inherited_level;
            for (const layer_plan& layer : numeric) {
                values[i].numbers.push_back(value(layer.description.name));
            }
        }
    }
    return values;
}

/// The motion in double-double. There is no third opinion: orbits of thousands of returns in 50
/// digits are out of reach.
judged_cell judge_motion(const scene& scene, const label_plan& plan, const orbit_row& row,
                         std::uint64_t cell, const stored_cell& stored,
                         std::span<const layer_plan> numeric) {
    constexpr int undecided = static_cast<int>(motion::undecided);
    const exponent_answer answer = run_exponents(scene, plan, row);
    const int computed = static_cast<int>(answer.motion);
    const bool is_open = stored.verdict == undecided || computed == undecided;
    return {{cell, stored.verdict, is_open ? stored.verdict : computed},
            {cell, stored.numbers, errors_of(numeric, stored.numbers, answer)}};
}

judged_cell judge_cell(const scene& scene, const label_plan& plan, std::uint64_t cell,
                       const stored_cell& stored, std::span<const layer_plan> numeric) {
    const std::vector<std::uint64_t> coordinates = coordinates_of(scene, cell);
    if (plan.of_cell) return judge_cell(scene, plan.of_cell(coordinates), cell, stored, numeric);
    const owned_row row = row_of(scene, plan, coordinates);
    if (is_chaos_map(scene)) return judge_motion(scene, plan, row.row, cell, stored, numeric);
    judged_cell judged{{cell, stored.verdict, 0}, {cell, stored.numbers, {}}};
    orbit_answer answer;
    for (const precision value : {precision::dd, precision::mp50}) {
        answer = run_stored_cell(scene, plan, coordinates, value, row.row, stored.verdict);
        judged.verdict.computed = compared(scene, answer);
        if (judged.verdict.agrees()) break;
    }
    judged.errors.errors =
        errors_of(scene, numeric, stored.numbers, answer, start_of(scene, coordinates).parameters);
    return judged;
}

std::uint64_t worst_of(const audit_report& report) {
    if (!report.wrong.empty()) return report.wrong.front().cell;
    const layer_error* worst = nullptr;
    for (const layer_error& layer : report.errors) {
        if (worst == nullptr || layer.relative > worst->relative) worst = &layer;
    }
    return worst == nullptr ? 0 : worst->worst;
}

audit_report report_of(std::span<const judged_cell> cells, std::span<const layer_plan> numeric) {
    audit_report report;
    report.n_cells = cells.size();
    std::vector<cell_errors> errors;
    for (const judged_cell& cell : cells) {
        if (!cell.verdict.agrees()) report.wrong.push_back(cell.verdict);
        if (!cell.verdict.agrees() && !cell.is_uncertain) ++report.n_wrong_certain;
        if (cell.is_uncertain) ++report.n_uncertain;
        if (cell.errors.errors.size() == numeric.size()) errors.push_back(cell.errors);
    }
    report.n_wrong = report.wrong.size();
    if (report.n_cells > 0) {
        report.share = static_cast<double>(report.n_wrong) / static_cast<double>(report.n_cells);
    }
    std::tie(report.lowest, report.highest) = confidence_of(report.n_wrong, report.n_cells);
    report.errors = summary_of(numeric, errors);
    report.worst = worst_of(report);
    return report;
}

/// 64 bits of the fingerprint, so that every map draws cells of its own.
std::uint64_t seed_of(const scene& scene) {
    std::uint64_t word = 0;
    const std::string_view digits = std::string_view(scene.fingerprint).substr(0, 16);
    std::from_chars(digits.data(), digits.data() + digits.size(), word, 16);
    return word;
}

}  // namespace

std::string_view judged_layer(const scene& scene) {
    if (is_chaos_map(scene)) return "motion";
    return scene.question.has_labels ? "label" : "outcome";
}

cell_verdict judge(const scene& scene, const label_plan& plan, std::uint64_t cell, int stored) {
    return judge_cell(scene, plan, cell, {stored, {}, false}, {}).verdict;
}

std::vector<std::uint64_t> audited_cells(const scene& scene, std::uint64_t n, std::uint64_t seed) {
    return sample_cells(scene.n_cells(), n, seed_of(scene) + seed * 0x9e3779b97f4a7c15u);
}

audit_report audit(const scene& scene, const label_plan& plan, const tile_source& tiles,
                   std::uint64_t n, std::uint64_t seed) {
    const std::vector<std::uint64_t> cells = audited_cells(scene, n, seed);
    const std::vector<layer_plan> numeric = numeric_layers(scene);
    const std::vector<stored_cell> stored = stored_cells(scene, numeric, tiles, cells);
    std::vector<judged_cell> judged(cells.size());
    const kernel_choice kernel = kernel_of(scene, "auto");
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        if (stop_condition::is_interrupted()) throw interruption();
        const std::span cell(&cells[i], 1);
        if (plan.of_cell) {
            const label_plan own = plan.of_cell(coordinates_of(scene, cells[i]));
            judged[i] = judge_cell(scene, own, cells[i], stored[i], numeric);
            judged[i].is_uncertain = second_look(scene, own, kernel.run, cell).front() != 0;
        } else {
            judged[i] = judge_cell(scene, plan, cells[i], stored[i], numeric);
            judged[i].is_uncertain = certainty_of(scene, plan, kernel.run, cell).front() != 0;
        }
        if (stored[i].is_inherited) judged[i].errors.errors.clear();  // it has no numbers
    });
    audit_report report = report_of(judged, numeric);
    report.seed = seed;
    return report;
}

attribute_list attributes_of(const scene& scene, const audit_report& report,
                             const std::filesystem::path& map) {
    attribute_list attributes{
        {"audit_cells", fmt::format("{}", report.n_cells)},
        {"audit_wrong", fmt::format("{}", report.n_wrong)},
        {"audit_share", fmt::format("{:.17g}", report.share)},
        {"audit_interval",
         fmt::format("{:.17g} to {:.17g} (95 %, Clopper-Pearson)", report.lowest, report.highest)},
        {"audit_method", is_chaos_map(scene) ? "motion in dd" : "dd, disputed cells mp50"}};
    const auto [fewest, most] = confidence_of(report.n_uncertain, report.n_cells);
    attributes.emplace_back("audit_uncertain", fmt::format("{} (share {:.17g} to {:.17g})",
                                                           report.n_uncertain, fewest, most));
    attributes.emplace_back("audit_wrong_certain", fmt::format("{}", report.n_wrong_certain));
    for (const layer_error& layer : report.errors) {
        attributes.emplace_back(
            "audit_error_" + layer.layer,
            fmt::format("median {:.17g} largest {:.17g} ({}; cell {})", layer.median, layer.largest,
                        layer.unit, cell_text(scene, layer.worst)));
    }
    if (report.n_cells > 0) {
        attributes.emplace_back("audit_replay", replay_command(scene, map, report.worst));
    }
    return attributes;
}

std::string replay_command(const scene& scene, const std::filesystem::path& map,
                           std::uint64_t cell) {
    return fmt::format("hopscotch replay {} --cell {}", map.string(), cell_text(scene, cell));
}

std::string cell_text(const scene& scene, std::uint64_t cell) {
    return fmt::format("{}", fmt::join(coordinates_of(scene, cell), ","));
}

}  // namespace hopscotch
