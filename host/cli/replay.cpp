// hopscotch replay FILE.h5 --cell i,j: one cell once more, with every event, in every precision.
#include "host/cli/commands.hpp"
#include "host/cli/map_plan.hpp"
#include "host/cli/sweep_point.hpp"
#include "host/cli/text_output.hpp"
#include "host/cli/trace_writer.hpp"
#include "host/cli/usage_error.hpp"
#include "host/run/attributes.hpp"
#include "host/run/audit.hpp"
#include "host/run/requests.hpp"
#include "host/scene/diagram_grid.hpp"
#include "host/run/truth_orbits.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <charconv>
#include <memory>
#include <span>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct replay_arguments {
    std::string file;
    std::string point;
    std::string cell;
    int samples = 0;
    std::uint32_t most_returns = 1000;
    std::string trace;
};

/// "3,17" for a map with two axes.
std::vector<std::uint64_t> coordinates_in(const scene& scene, const std::string& text) {
    std::vector<std::uint64_t> coordinates;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
        std::uint64_t index = 0;
        const auto [next, failure] = std::from_chars(at, end, index);
        if (failure != std::errc{} || (next != end && *next != ',')) break;
        coordinates.push_back(index);
        at = next == end ? end : next + 1;
    }
    bool is_inside = at == end && coordinates.size() == scene.axes.size();
    for (std::size_t axis = 0; is_inside && axis < coordinates.size(); ++axis) {
        is_inside = coordinates[axis] < scene.axes[axis].cells;
    }
    if (is_inside) return coordinates;
    std::vector<std::uint64_t> cells;
    for (const scene_axis& axis : scene.axes) cells.push_back(axis.cells);
    throw usage_error(fmt::format("--cell {} (one index per axis, counted from 0, below {}); 0,0?",
                                  text, fmt::join(cells, ",")));
}

int stored_value(const map_reader& map, const std::string& layer,
                 const std::vector<std::uint64_t>& coordinates) {
    cell_range range{coordinates, std::vector<std::uint64_t>(coordinates.size(), 1), {}};
    const std::vector<double> value = map.read(layer, range);
    if (!map.problems().empty())
        throw store_error(map.problems().front(), "the cell cannot be read");
    return static_cast<int>(value.at(0));
}

std::string value_name(const scene& scene, const label_plan& plan, int value) {
    if (is_chaos_map(scene)) return std::string(motion_names.at(static_cast<std::size_t>(value)));
    if (!scene.question.has_labels) return std::string(name_of(static_cast<outcome>(value)));
    for (const attractor_row& row : plan.attractors) {
        if (row.label == value) return fmt::format("{} ({})", value, row.name);
    }
    return value == 0 ? "0 (none)" : std::to_string(value);
}

void print_start(const scene& scene, const std::vector<std::uint64_t>& coordinates) {
    const cell_start start = start_of(scene, coordinates);
    fmt::print("cell {}", fmt::join(coordinates, ","));
    const auto columns = scene.start_section().columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        fmt::print("  {} = {:.17g}", columns[i].name, start.columns[i]);
    }
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind != axis_kind::parameter) continue;
        fmt::print("  {} = {:.17g}", axis.name,
                   start.parameters[static_cast<std::size_t>(axis.index)]);
    }
    fmt::print("\n");
}

/// At least one return, also of orbits that a proof labels where they start.
void print_events(const scene& scene, const owned_row& row, const replay_arguments& given) {
    orbit_row traced = row.row;
    const std::uint32_t returns = run_orbit(*scene.model, precision::binary64, row.row).returns;
    traced.decided_by = decision::returns;
    traced.returns = std::clamp(returns, std::uint32_t{1}, given.most_returns);
    put_text(given.trace, trace_text(*scene.model, traced, given.samples, trace_format::csv));
    if (returns > traced.returns)
        fmt::print("(the first {} of {} returns)\n", traced.returns, returns);
}

/// The motion once more in double-double, with all exponents.
int replay_motion(const scene& scene, const label_plan& plan, const orbit_row& row, int stored) {
    const exponent_answer answer = run_exponents(scene, plan, row);
    const std::span exponents(answer.exponents, scene.end_section().columns.size());
    fmt::print("{:<8} {}  outcome {}, {} returns, exponents {:.17g}, standard error {:.17g}\n",
               "dd", motion_names[static_cast<std::size_t>(answer.motion)], name_of(answer.end),
               answer.returns, fmt::join(exponents, " "), answer.standard_error);
    const bool holds = static_cast<int>(answer.motion) == stored;
    fmt::print("the stored motion {}\n", holds ? "holds" : "does not hold");
    return exit_done;
}

int replay(const replay_arguments& given) {
    const map_reader map(given.file);
    const scene scene = scene_of(map);
    if (is_orbit_diagram(scene)) {
        throw usage_error(
            fmt::format("replay {} (an orbit diagram has no cells with a verdict); trace {}?",
                        given.file, scene.info().name));
    }
    const std::vector<std::uint64_t> coordinates = coordinates_in(scene, given.cell);
    label_plan plan = told_plan(scene, map);
    if (plan.of_cell) plan = plan.of_cell(coordinates);
    const owned_row row = row_of(scene, plan, coordinates);
    print_events(scene, row, given);
    print_start(scene, coordinates);
    const std::string layer(judged_layer(scene));
    const int stored = stored_value(map, layer, coordinates);
    fmt::print("{:<8} {}\n", "stored", value_name(scene, plan, stored));
    if (is_chaos_map(scene)) return replay_motion(scene, plan, row.row, stored);
    int best = stored;
    for (const precision value : {precision::binary64, precision::dd, precision::mp50}) {
        const orbit_answer answer =
            run_stored_cell(scene, plan, coordinates, value, row.row, stored);
        best = scene.question.has_labels ? answer.label : static_cast<int>(answer.end);
        fmt::print("{:<8} {}  outcome {}, {} returns, {} events, time {}\n", name_of(value),
                   value_name(scene, plan, best), name_of(answer.end), answer.returns,
                   answer.events, answer.time);
    }
    fmt::print("the stored {} {}\n", layer, best == stored ? "holds" : "does not hold");
    return exit_done;
}

}  // namespace

void add_replay(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<replay_arguments>();
    CLI::App* command = program.add_subcommand("replay", "One cell once more, with every event");
    command->add_option("file", given->file, "Map file (HDF5)")->required();
    add_point(*command, given->point);
    command->add_option("--cell", given->cell, "Indices along the axes, as 3,17")->required();
    command->add_option("--samples", given->samples, "Samples per phase (0)")
        ->check(CLI::Range(0, 1000000));
    command->add_option("--returns", given->most_returns, "Most returns to show (1000)")
        ->check(CLI::Range(1u, 4000000000u));
    command->add_option("--trace", given->trace,
                        "File for the events; standard output if not given");
    command->callback([given, &exit_code] {
        given->file = chosen_map(given->file, given->point);
        exit_code = replay(*given);
    });
}

}  // namespace hopscotch
