// hopscotch merge MAP.h5 [FOLDER ...]: joins the tiles of shards into the map, or says which are
// missing. What a single run does after its last tile is done here: the second search for
// attractors, the audit, the packing.
#include "host/cli/commands.hpp"
#include "host/cli/durations.hpp"
#include "host/cli/run_answer.hpp"
#include "host/mpi/start_team.hpp"
#include "host/run/attributes.hpp"

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct merge_arguments {
    std::string file;
    std::vector<std::string> folders;
    std::string backend = "auto";
    int n_threads = 0;
    std::string walltime;
    bool is_quiet = false;
};

run_choices choices_of(const merge_arguments& given) {
    run_choices choices;
    choices.file = given.file;
    choices.backend = given.backend;
    choices.n_threads = given.n_threads;
    choices.existing = if_exists::resume;
    choices.is_quiet = given.is_quiet;
    choices.is_merge = true;
    choices.adopted.assign(given.folders.begin(), given.folders.end());
    if (!given.walltime.empty()) choices.walltime = seconds_of(given.walltime);
    return choices;
}

/// The finished map, its own run directory, or the first of the others: all of them know the scene.
scene scene_to_merge(const merge_arguments& given) {
    std::vector<std::filesystem::path> places{given.file, map_run::directory_of(given.file)};
    places.insert(places.end(), given.folders.begin(), given.folders.end());
    for (const std::filesystem::path& place : places) {
        std::error_code ignored;
        if (std::filesystem::exists(place, ignored)) return scene_of(map_reader(place));
    }
    throw store_error(map_run::directory_of(given.file).string(),
                      "there is no such run directory, and no map " + given.file,
                      "the file that the shards were given with -o");
}

int merge(const merge_arguments& given) {
    team& ranks = start_team();
    try {
        std::optional<scene> what;
        run_choices choices;
        ranks.together([&] {
            what = scene_to_merge(given);
            choices = choices_of(given);
        });
        return run_and_tell(*what, choices, ranks);
    } catch (const std::exception& error) {
        ranks.leave(error);
        throw;
    }
}

}  // namespace

void add_merge(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<merge_arguments>();
    CLI::App* command = program.add_subcommand("merge", "Join the tiles of shards into their map");
    command->add_option("file", given->file, "Map file, as the shards were given it")->required();
    command->add_option("folders", given->folders,
                        "Run directories (.tiles) of shards that ran elsewhere");
    command->add_option("--backend", given->backend, "For cells that are searched again")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "cuda"}));
    command->add_option("--threads", given->n_threads, "Threads; all if not given")
        ->check(CLI::Range(1, 65536));
    command->add_option("--walltime", given->walltime,
                        "H:MM:SS after which the merge stops, resumable");
    command->add_flag("--quiet", given->is_quiet, "No progress line");
    command->callback([given, &exit_code] { exit_code = merge(*given); });
}

}  // namespace hopscotch
