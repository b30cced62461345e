// hopscotch run SCENE.toml [key=value ...]: the map, its picture and its summary.
#include "analysis/labels/plan.hpp"
#include "analysis/render/render.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/durations.hpp"
#include "host/cli/text_output.hpp"
#include "host/mpi/start_team.hpp"
#include "host/run/audit.hpp"
#include "host/run/estimate.hpp"
#include "host/run/run_map.hpp"
#include "host/run/summary.hpp"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct run_arguments {
    std::string scene;
    std::vector<std::string> overrides;
    std::string file;
    std::string backend = "auto";
    int n_threads = 0;
    bool is_resumed = false;
    bool is_forced = false;
    bool is_dry = false;
    bool is_quiet = false;
    std::string walltime;
};

run_choices choices_of(const run_arguments& given) {
    run_choices choices;
    choices.file = given.file;
    choices.backend = given.backend;
    choices.n_threads = given.n_threads;
    choices.is_quiet = given.is_quiet;
    if (given.is_forced) choices.existing = if_exists::replace;
    if (given.is_resumed) choices.existing = if_exists::resume;
    if (!given.walltime.empty()) choices.walltime = seconds_of(given.walltime);
    return choices;
}

run_hooks hooks_of(const scene& scene, const std::filesystem::path& file) {
    run_hooks hooks;
    hooks.plan = plan_labels;
    if (scene.model->orbits_table == nullptr) return hooks;
    hooks.audit = [file](const struct scene& what, const label_plan& plan, const map_run& run) {
        const audit_report report = audit(
            what, plan, [&](std::uint64_t tile) { return run.read(tile); },
            what.accuracy.audit_cells);
        return attributes_of(what, report, file);
    };
    return hooks;
}

/// A file beside the map, of the same name up to its ending.
std::filesystem::path companion(std::filesystem::path map, const std::string& ending) {
    if (map.extension() == ending) return map += ending;
    return map.replace_extension(ending);
}

/// The picture is a courtesy: without it the run is still done.
void write_picture(const run_report& report) {
    const std::filesystem::path picture = companion(report.file, ".png");
    try {
        render_map(report.file, picture);
        fmt::print("picture          {}\n", picture.string());
    } catch (const std::exception& error) {
        fmt::print(stderr, "hopscotch: no picture: {}\n", error.what());
    }
}

int finish(const scene& scene, const run_report& report) {
    if (report.n_tiles > 0 && report.hash.empty()) {
        fmt::print("{} is finished already\n", report.file.string());
        return exit_done;
    }
    fmt::print("{}", text_of(scene, report));
    const std::filesystem::path summary = companion(report.file, ".json");
    put_text(summary.string(), json_of(scene, report));
    fmt::print("summary          {}\n", summary.string());
    write_picture(report);
    return exit_done;
}

int interrupted(const run_report& report) {
    fmt::print(
        stderr,
        "hopscotch: {} ({} of {} tiles are done, none is lost); the same command with --resume?\n",
        report.file.string(), report.n_tiles - report.n_missing, report.n_tiles);
    return exit_resumable;
}

int run_by(team& ranks, const run_arguments& given) {
    std::optional<scene> what;
    run_choices choices;
    ranks.together([&] {
        what = read_scene(given.scene, given.overrides);
        choices = choices_of(given);
    });
    const std::filesystem::path file = choices.file.empty() ? what->output.file : choices.file;
    const run_hooks hooks = hooks_of(*what, file);
    if (given.is_dry) {
        if (ranks.is_first()) fmt::print("{}", text_of(*what, estimate(*what, choices, hooks)));
        return exit_done;
    }
    const run_report report = run_map(*what, choices, hooks, ranks);
    if (!ranks.is_first()) return report.is_finished ? exit_done : exit_resumable;
    for (const std::string& note : report.notes) fmt::print(stderr, "hopscotch: {}\n", note);
    return report.is_finished ? finish(*what, report) : interrupted(report);
}

int run(const run_arguments& given) {
    team& ranks = start_team();
    try {
        return run_by(ranks, given);
    } catch (const std::exception& error) {
        ranks.leave(error);
        throw;
    }
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<run_arguments>();
    CLI::App* command = program.add_subcommand("run", "Compute the map of a scene");
    command->add_option("scene", given->scene, "Scene file (TOML)")->required();
    command->add_option("overrides", given->overrides, "key=value: scene values to replace");
    command->add_option("-o,--output", given->file, "Map file; the scene's if not given");
    command->add_option("--backend", given->backend, "auto, scalar, avx2, avx512 or cuda")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "cuda"}));
    command->add_option("--threads", given->n_threads, "Threads; all if not given")
        ->check(CLI::Range(1, 65536));
    auto* resume = command->add_flag("--resume", given->is_resumed, "Go on with finished tiles");
    command->add_flag("--force", given->is_forced, "Replace an existing map")->excludes(resume);
    command->add_flag("--dry-run", given->is_dry,
                      "Say cells, bytes, memory and time; compute nothing");
    command->add_option("--walltime", given->walltime,
                        "H:MM:SS after which the run stops, resumable");
    command->add_flag("--quiet", given->is_quiet, "No progress line");
    command->callback([given, &exit_code] { exit_code = run(*given); });
}

}  // namespace hopscotch
