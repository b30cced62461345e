// hopscotch attractors SCENE.toml: the periodic orbits and resting states that label the scene's
// cells.
#include "analysis/labels/one_sided.hpp"
#include "analysis/labels/plan.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/sector_text.hpp"
#include "host/cli/tables.hpp"
#include "host/cli/text_output.hpp"
#include "host/run/json.hpp"
#include "host/run/trap_gain.hpp"
#include "host/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct attractor_arguments {
    std::string scene;
    std::vector<std::string> overrides;
    std::string output;
};

/// The first few; all of them are in the JSON file.
std::string numbers_text(const std::vector<double>& numbers) {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(numbers.size(), most); ++i) {
        text += fmt::format("{}{:.17g}", i == 0 ? "" : " ", numbers[i]);
    }
    return numbers.size() > most ? text + " ..." : text;
}

/// Share of the sampled cells; NaN where none were sampled.
double share_of(const basin_sample& sample, int label) {
    const auto found = sample.labels.find(label);
    const std::uint64_t n = found == sample.labels.end() ? 0 : found->second;
    return static_cast<double>(n) / static_cast<double>(sample.n_cells);
}

/// Without its standard error where every cell was looked at.
std::string share_text(const scene& scene, const basin_sample& sample, int label) {
    if (sample.n_cells == 0) return "";
    const double share = share_of(sample, label);
    if (sample.n_cells == scene.n_cells()) return fmt::format("{:.4g}", share);
    const double error = std::sqrt(share * (1.0 - share) / static_cast<double>(sample.n_cells));
    return fmt::format("{:.3g} +- {:.2g}", share, error);
}

std::string table_of(const scene& scene, const label_plan& plan, const basin_sample& sample) {
    std::vector<std::vector<std::string>> rows{
        {"label", "name", "period", fmt::format("points ({})", fmt::join(plan.point_columns, " ")),
         "multipliers", "basin", "trap"}};
    for (const attractor_row& row : plan.attractors) {
        rows.push_back({fmt::format("{}", row.label), row.name, fmt::format("{}", row.period),
                        numbers_text(row.points), numbers_text(row.multipliers_real),
                        share_text(scene, sample, row.label), row.trap});
    }
    for (const attractor_row& row : plan.unstable) {
        rows.push_back({"-", row.name, fmt::format("{}", row.period), numbers_text(row.points),
                        numbers_text(row.multipliers_real), "", row.trap});
    }
    return aligned(rows, 0);
}

/// One fixed point at one parameter point.
struct sided_row {
    std::vector<double> parameters;  // the values of the scene's parameter axes
    std::string name;
    one_sided_stability sides;
};

/// Both sides of every fixed point on a branch, at every parameter point.
std::vector<sided_row> sided_rows(const scene& scene, const label_plan& plan) {
    std::vector<sided_row> rows;
    if (!scene.model->branch) return rows;
    const std::vector<std::size_t> axes = parameter_axes(scene);
    for (const std::vector<double>& parameters : parameter_points(scene, axes)) {
        std::vector<double> shown;
        for (const std::size_t axis : axes) {
            shown.push_back(parameters[static_cast<std::size_t>(scene.axes[axis].index)]);
        }
        for (const auto& [row, sides] : sided_attractors(scene, plan, parameters)) {
            rows.push_back({shown, row->name, sides});
        }
    }
    return rows;
}

std::string side_text(const stability_side& side) {
    return side.attracts ? fmt::format("attracts, extent {:.17g}", side.extent) : "repels";
}

std::string sided_table(const scene& scene, const std::vector<sided_row>& rows) {
    constexpr std::size_t most = 12;
    std::vector<std::vector<std::string>> table{
        {"at", "name", "left", "right", "law on the right"}};
    const std::size_t stride = std::max<std::size_t>(1, rows.size() / most);
    for (std::size_t i = 0; i < rows.size(); i += stride) {
        std::string at;
        std::size_t position = 0;
        for (const std::size_t axis : parameter_axes(scene)) {
            at += fmt::format("{}{} = {:.6g}", at.empty() ? "" : " ", scene.axes[axis].name,
                              rows[i].parameters[position++]);
        }
        table.push_back({at, rows[i].name, side_text(rows[i].sides.left),
                         side_text(rows[i].sides.right),
                         fmt::format("{:.6g} d^{:.6g}", rows[i].sides.right.coefficient,
                                     rows[i].sides.right.exponent)});
    }
    return rows.empty() ? "" : aligned(table, 0);
}

std::string side_json(const stability_side& side) {
    return fmt::format(
        "{{\"attracts\": {}, \"kind\": {}, \"coefficient\": {:.17g}, \"exponent\": {:.17g}, "
        "\"extent\": {:.17g}}}",
        side.attracts, json_text(side_kind_names[static_cast<std::size_t>(side.kind)]),
        side.coefficient, side.exponent, side.extent);
}

std::string rows_json(const std::vector<attractor_row>& rows, const basin_sample& sample) {
    std::string text;
    for (const attractor_row& row : rows) {
        text += fmt::format(
            "{}\n  {{\"label\": {}, \"name\": {}, \"period\": {}, \"points\": {}, "
            "\"multipliers_real\": {}, \"multipliers_imaginary\": {}, \"share\": {}, \"trap\": "
            "{}}}",
            text.empty() ? "" : ",", row.label, json_text(row.name), row.period,
            json_numbers(row.points), json_numbers(row.multipliers_real),
            json_numbers(row.multipliers_imaginary),
            json_number(row.label > 0 ? share_of(sample, row.label) : std::nan("")),
            json_text(row.trap));
    }
    return text;
}

std::string json_of(const scene& scene, const label_plan& plan, const std::vector<sided_row>& rows,
                    const std::vector<sector_row>& sectors, const basin_sample& sample) {
    std::string text = fmt::format("{{\"model\": {}, \"columns\": {}, \"attractors\": [",
                                   json_text(scene.info().name), json_texts(plan.point_columns));
    text += rows_json(plan.attractors, sample);
    text += "\n], \"unstable\": [" + rows_json(plan.unstable, sample);
    text += "\n], \"one_sided\": [";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        text += fmt::format(
            "{}\n  {{\"name\": {}, \"parameters\": {}, \"left\": {}, \"right\": {}}}",
            i == 0 ? "" : ",", json_text(rows[i].name), json_numbers(rows[i].parameters),
            side_json(rows[i].sides.left), side_json(rows[i].sides.right));
    }
    text += fmt::format(
        "\n], \"sampled_cells\": {}, \"returns_per_labelled_cell\": {}, \"trap_gain\": {}",
        sample.n_cells, json_number(sample.gain.mean()), json_number(sample.gain.factor()));
    return text + ", \"sectors\": " + sector_json(sectors) + "}\n";
}

int attractors(const attractor_arguments& given) {
    const scene scene = read_scene(given.scene, given.overrides);
    const label_plan plan = plan_labels(scene);
    const std::vector<sided_row> rows = sided_rows(scene, plan);
    const std::vector<sector_row> sectors = sector_table(scene, plan);
    // a plan of its own for every cell would have to be made for each
    const basin_sample sample = plan.of_cell ? basin_sample{} : sample_basins(scene, plan);
    fmt::print("{}", table_of(scene, plan, sample));
    if (sample.gain.n_labelled > 0) {
        fmt::print("traps: {} ({} cells sampled)\n", text_of(sample.gain), sample.n_cells);
    }
    fmt::print("{}{}", sided_table(scene, rows), sector_text(scene, plan, sectors));
    const std::string stem = std::filesystem::path(scene.file).stem().string();
    const std::string file = given.output.empty() ? stem + "_attractors.json" : given.output;
    put_text(file, json_of(scene, plan, rows, sectors, sample));
    if (file != "-") fmt::print("{}\n", file);
    return exit_done;
}

}  // namespace

void add_attractors(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<attractor_arguments>();
    CLI::App* command = program.add_subcommand("attractors", "The attractors of a scene");
    command->add_option("scene", given->scene, "Scene file (TOML)")->required();
    command->add_option("overrides", given->overrides, "key=value: scene values to replace");
    command->add_option("-o,--output", given->output,
                        "JSON file; SCENE_attractors.json if not given");
    command->callback([given, &exit_code] { exit_code = attractors(*given); });
}

}  // namespace hopscotch
