// hopscotch branch SCENE.toml: periodic orbits continued over a parameter, or over a column that
// the return map conserves.
#include "analysis/continuation/scene_branches.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/tables.hpp"
#include "host/cli/text_output.hpp"
#include "host/cli/usage_error.hpp"
#include "host/mpi/launcher.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct branch_arguments {
    std::string scene;
    std::vector<std::string> overrides;
    std::string output;
};

/// SCENE_branch, where the scene's name does not end so already.
std::string stem_of(const scene& scene) {
    const std::string ending = "_branch";
    const std::string stem = std::filesystem::path(scene.file).stem().string();
    return stem.ends_with(ending) ? stem : stem + ending;
}

/// Branches are followed by one process; several would write the same files.
bool is_left_to_another() {
    const launch started = this_launch();
    if (started.size < 2) return false;
    if (started.rank > 0) return true;
    throw usage_error(
        fmt::format("branch (one process follows branches, {} were started); without the launcher?",
                    started.size));
}

int print_branches(const branch_arguments& given) {
    if (is_left_to_another()) return exit_done;
    const scene scene = read_scene(given.scene, given.overrides);
    const std::string stem = given.output.empty() ? stem_of(scene) : given.output;
    const branch_answer answer = follow_branches(scene, stem);
    fmt::print("{}", aligned(answer.table, 0));
    put_text(stem + ".csv", answer.csv);
    put_text(stem + ".json", answer.json);
    fmt::print("{0}.csv\n{0}.json\n{0}.png\n", stem);
    if (answer.curve_csv.empty()) return exit_done;
    fmt::print("{}", aligned(answer.curve_table, 0));
    put_text(stem + "_curves.csv", answer.curve_csv);
    fmt::print("{0}_curves.csv\n{0}_curves.png\n", stem);
    return exit_done;
}

}  // namespace

void add_branch(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<branch_arguments>();
    CLI::App* command =
        program.add_subcommand("branch", "Continue periodic orbits over a parameter");
    command->add_option("scene", given->scene, "Scene file (TOML)")->required();
    command->add_option("overrides", given->overrides, "key=value: scene values to replace");
    command->add_option("-o,--output", given->output,
                        "Files without their ending; SCENE_branch if not given");
    command->callback([given, &exit_code] { exit_code = print_branches(*given); });
}

}  // namespace hopscotch
