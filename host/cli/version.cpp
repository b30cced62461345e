// hopscotch version: what this program is and what it can run on.
#include "host/cli/commands.hpp"
#include "host/mpi/start_team.hpp"
#include "host/run/backends.hpp"
#include "host/run/build_info.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

int print_version() {
    const build_info& build = this_build();
    fmt::print("hopscotch {}\n", build.version);
    fmt::print("revision  {}\ncompiler  {}\nflags     {}\n", build.revision, build.compiler,
               build.flags);
    for (int i = 0; i < n_backends; ++i) {
        const auto which = static_cast<backend>(i);
        const std::string reason = reason_against(which);
        fmt::print("backend   {:<7} {}\n", name_of(which), reason.empty() ? "available" : reason);
    }
    const std::string mpi = mpi_library();
    fmt::print("mpi       {}\n", mpi.empty() ? "this program is built without MPI" : mpi);
    return exit_done;
}

}  // namespace

void add_version(CLI::App& program, int& exit_code) {
    CLI::App* command =
        program.add_subcommand("version", "Version, revision, compiler, backends and MPI");
    command->callback([&exit_code] { exit_code = print_version(); });
}

}  // namespace hopscotch
