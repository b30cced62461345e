// The commands of the program. Each `add_...` tells the parser its arguments and what to do with
// them; what it does lies in the file of the same name.
#pragma once

#include "host/run/exit_code.hpp"

namespace CLI {
class App;
}

namespace hopscotch {

void add_run(CLI::App& program, int& exit_code);
void add_eval(CLI::App& program, int& exit_code);
void add_trace(CLI::App& program, int& exit_code);
void add_attractors(CLI::App& program, int& exit_code);
void add_analyse(CLI::App& program, int& exit_code);
void add_branch(CLI::App& program, int& exit_code);
void add_merge(CLI::App& program, int& exit_code);
void add_render(CLI::App& program, int& exit_code);
void add_verify(CLI::App& program, int& exit_code);
void add_replay(CLI::App& program, int& exit_code);
void add_info(CLI::App& program, int& exit_code);
void add_models(CLI::App& program, int& exit_code);
void add_version(CLI::App& program, int& exit_code);
void add_bench(CLI::App& program, int& exit_code);

/// The whole program: parses, runs, and turns every error into one line and its exit code.
int run_program(int argc, const char* const* argv);

}  // namespace hopscotch
