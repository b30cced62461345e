// hopscotch run SCENE.toml [key=value ...]: the map, its picture and its summary.
#include "host/cli/commands.hpp"
#include "host/cli/durations.hpp"
#include "host/cli/run_answer.hpp"
#include "host/cli/run_sweep.hpp"
#include "host/cli/shard_argument.hpp"
#include "host/mpi/start_team.hpp"
#include "host/run/estimate.hpp"
#include "host/run/summary.hpp"
#include "host/scene/sweep.hpp"

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
    bool keeps_tiles = false;
    bool is_quiet = false;
    std::string walltime;
    std::string shard;
};

run_choices choices_of(const run_arguments& given) {
    run_choices choices;
    choices.file = given.file;
    choices.backend = given.backend;
    choices.n_threads = given.n_threads;
    choices.keeps_tiles = given.keeps_tiles;
    choices.is_quiet = given.is_quiet;
    if (given.is_forced) choices.existing = if_exists::replace;
    if (given.is_resumed) choices.existing = if_exists::resume;
    if (!given.shard.empty()) choices.part = shard_of(given.shard);
    if (!given.walltime.empty()) choices.walltime = seconds_of(given.walltime);
    return choices;
}

int run_by(team& ranks, const run_arguments& given) {
    std::optional<scene> what;
    run_choices choices;
    ranks.together([&] {
        what = read_scene(given.scene, given.overrides);
        choices = choices_of(given);
    });
    if (is_sweep(*what)) return run_and_tell_sweep(*what, choices, given.is_dry, ranks);
    if (given.is_dry) {
        if (!ranks.is_first()) return exit_done;
        const run_hooks hooks = hooks_of(*what, choices.file);
        fmt::print("{}", text_of(*what, estimate(*what, choices, hooks)));
        return exit_done;
    }
    return run_and_tell(*what, choices, ranks);
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
    command->add_flag("--keep-tiles", given->keeps_tiles,
                      "The map file refers to the tile files instead of holding them");
    command->add_option("--walltime", given->walltime,
                        "H:MM:SS after which the run stops, resumable");
    command->add_option("--shard", given->shard,
                        "I/N: only shard I of N of the tiles; `merge` joins them");
    command->add_flag("--quiet", given->is_quiet, "No progress line");
    command->callback([given, &exit_code] { exit_code = run(*given); });
}

}  // namespace hopscotch
