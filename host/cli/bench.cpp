// `hopscotch bench`: benchmarks are programs of their own, built from the sources with their
// yardsticks by the launcher `./hopscotch`; the program alone says where they are.
#include "host/cli/commands.hpp"
#include "host/cli/usage_error.hpp"

#include <CLI/CLI.hpp>

namespace hopscotch {

void add_bench(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("bench", "Speed against error (from the sources)");
    command->allow_extras();
    command->callback([] {
        throw usage_error(
            "bench (benchmarks are built from the sources); ./hopscotch bench in a checkout?");
    });
}

}  // namespace hopscotch
