// hopscotch attractors SCENE.toml: the periodic orbits and resting states that label the scene's
// cells.
#include "analysis/labels/plan.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/tables.hpp"
#include "host/cli/text_output.hpp"
#include "host/run/json.hpp"
#include "host/scene/scene.hpp"

#include <algorithm>
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

std::string table_of(const label_plan& plan) {
    std::vector<std::vector<std::string>> rows{
        {"label", "name", "period", fmt::format("points ({})", fmt::join(plan.point_columns, " ")),
         "multipliers", "trap"}};
    for (const attractor_row& row : plan.attractors) {
        rows.push_back({fmt::format("{}", row.label), row.name, fmt::format("{}", row.period),
                        numbers_text(row.points), numbers_text(row.multipliers_real), row.trap});
    }
    return aligned(rows, 0);
}

std::string json_of(const scene& scene, const label_plan& plan) {
    std::string text = fmt::format("{{\"model\": {}, \"columns\": {}, \"attractors\": [",
                                   json_text(scene.info().name), json_texts(plan.point_columns));
    for (std::size_t i = 0; i < plan.attractors.size(); ++i) {
        const attractor_row& row = plan.attractors[i];
        text += fmt::format(
            "{}\n  {{\"label\": {}, \"name\": {}, \"period\": {}, \"points\": {}, "
            "\"multipliers_real\": {}, \"multipliers_imaginary\": {}, \"trap\": {}}}",
            i == 0 ? "" : ",", row.label, json_text(row.name), row.period, json_numbers(row.points),
            json_numbers(row.multipliers_real), json_numbers(row.multipliers_imaginary),
            json_text(row.trap));
    }
    return text + "\n]}\n";
}

int attractors(const attractor_arguments& given) {
    const scene scene = read_scene(given.scene, given.overrides);
    const label_plan plan = plan_labels(scene);
    fmt::print("{}", table_of(plan));
    const std::string stem = std::filesystem::path(scene.file).stem().string();
    const std::string file = given.output.empty() ? stem + "_attractors.json" : given.output;
    put_text(file, json_of(scene, plan));
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
