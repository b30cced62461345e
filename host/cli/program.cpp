// Parses the command line, runs one command, and turns every error into one line and an exit code.
#include "host/cli/commands.hpp"
#include "host/cli/usage_error.hpp"
#include "host/run/build_info.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/team.hpp"
#include "host/scene/suggest.hpp"

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

int complain(const char* what, int code) {
    fmt::print(stderr, "hopscotch: {}\n", what);
    return code;
}

void add_commands(CLI::App& program, int& code) {
    program.require_subcommand(1);
    add_run(program, code);
    add_merge(program, code);
    add_eval(program, code);
    add_trace(program, code);
    add_attractors(program, code);
    add_analyse(program, code);
    add_branch(program, code);
    add_render(program, code);
    add_verify(program, code);
    add_replay(program, code);
    add_info(program, code);
    add_models(program, code);
    add_version(program, code);
    add_bench(program, code);
}

void check_command(const CLI::App& program, int argc, const char* const* argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands({}))
        names.push_back(command->get_name());
    const std::vector<std::string_view> known(names.begin(), names.end());
    if (std::find(known.begin(), known.end(), argv[1]) != known.end()) return;
    throw usage_error(fmt::format("{} (no such command); {}?", argv[1], suggest(argv[1], known)));
}

/// For the first option that the command does not know: the closest one that it knows.
std::string option_meant(const CLI::App& command, int argc, const char* const* argv) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    for (int i = 2; i < argc; ++i) {
        const std::string_view option =
            std::string_view(argv[i]).substr(0, std::string_view(argv[i]).find('='));
        if (!option.starts_with("--") ||
            std::find(known.begin(), known.end(), option) != known.end())
            continue;
        if (std::string near = closest(option, known); !near.empty()) return near;
    }
    return fmt::format("hopscotch {} --help", command.get_name());
}

/// Help goes to stdout; anything else is one line.
int answer(const CLI::App& program, const CLI::ParseError& error, int argc,
           const char* const* argv) {
    const bool is_wish = error.get_exit_code() == 0;
    if (is_wish) return program.exit(error);
    std::string what = error.what();
    for (char& letter : what) {
        if (letter == '\n') letter = ' ';
    }
    const auto commands = program.get_subcommands();
    const std::string suggestion =
        commands.empty() ? "hopscotch --help" : option_meant(*commands.front(), argc, argv);
    return complain(fmt::format("{}; {}?", what, suggestion).c_str(), exit_usage);
}

}  // namespace

int run_program(int argc, const char* const* argv) try {
    int code = exit_done;
    CLI::App program("Hopscotch maps the basins of attraction of hybrid dynamical systems.",
                     "hopscotch");
    program.set_version_flag("--version", "hopscotch " + std::string(this_build().version));
    add_commands(program, code);
    try {
        check_command(program, argc, argv);
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return answer(program, error, argc, argv);
    }
    return code;
} catch (const usage_error& error) {
    return complain(error.what(), exit_usage);
} catch (const interruption&) {
    return complain("interrupted", exit_resumable);
} catch (const rank_failure& other) {
    return other.what()[0] == '\0' ? other.code() : complain(other.what(), other.code());
} catch (const std::exception& error) {
    return complain(error.what(), exit_code_of(error));
}

}  // namespace hopscotch
