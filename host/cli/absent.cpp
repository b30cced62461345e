// Commands whose names are promised but which this version does not have: they say so.
#include "host/cli/commands.hpp"
#include "host/cli/usage_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct absent_command {
    const char* name;
    const char* meaning;
    const char* instead;
};

constexpr absent_command absent[] = {
    {"bench", "Speed against error", "./hopscotch bench in a checkout"},
};

}  // namespace

void add_absent(CLI::App& program, int&) {
    for (const absent_command& what : absent) {
        CLI::App* command =
            program.add_subcommand(what.name, std::string(what.meaning) + " (not in this version)");
        command->allow_extras();
        command->callback([&what] {
            throw usage_error(
                fmt::format("{} (not in this version); {}?", what.name, what.instead));
        });
    }
}

}  // namespace hopscotch
