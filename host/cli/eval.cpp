// hopscotch eval MODEL: one batch of rows through the return map.
#include "host/cli/commands.hpp"
#include "host/cli/evaluate.hpp"
#include "host/cli/model_argument.hpp"
#include "host/cli/text_output.hpp"
#include "host/cli/usage_error.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct eval_arguments {
    std::string model;
    std::string section;
    std::string input;
    std::string output;
    std::vector<std::string> sets;
    std::string precision = "double";
    evaluation what;
};

precision precision_of(const std::string& name) {
    for (const precision value : {precision::dd, precision::mp50}) {
        if (name_of(value) == name) return value;
    }
    return precision::binary64;
}

int eval(eval_arguments given) {
    const model_entry& model = model_named(given.model);
    given.what.precision = precision_of(given.precision);
    const bool needs_orbits =
        given.what.has_derivative || given.what.precision != precision::binary64;
    if (needs_orbits && model.orbits_table == nullptr) {
        throw usage_error(
            fmt::format("{} (built in double only); --precision double?", given.model));
    }
    const row_source rows(model, section_named(*model.info, given.section), read_csv(given.input),
                          given.sets);
    const std::vector<std::string> lines = evaluate(rows, given.what);
    put_text(given.output, output_header(rows, given.what) + "\n" +
                               fmt::format("{}", fmt::join(lines, "\n")) +
                               (lines.empty() ? "" : "\n"));
    return exit_done;
}

}  // namespace

void add_eval(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<eval_arguments>();
    CLI::App* command = program.add_subcommand("eval", "Rows of a table through the return map");
    command->add_option("model", given->model, "Model")->required();
    command->add_option("--section", given->section, "Section; the model's first if not given");
    command->add_option("--returns", given->what.returns, "Returns per row (1)")
        ->check(CLI::Range(1u, 4000000000u));
    command->add_option("--input", given->input, "Table (CSV) of starts; - is standard input")
        ->required();
    command->add_option("--output", given->output,
                        "Table of results; standard output if not given");
    command->add_option("--set", given->sets, "name=value for all rows");
    command->add_option("--precision", given->precision, "double, dd or mp50")
        ->check(CLI::IsMember({"double", "dd", "mp50"}));
    command->add_option("--backend", given->what.backend, "auto, scalar, avx2, avx512 or cuda")
        ->check(CLI::IsMember({"auto", "scalar", "avx2", "avx512", "cuda"}));
    command->add_option("--threads", given->what.n_threads, "Threads; all if not given")
        ->check(CLI::Range(1, 65536));
    command
        ->add_option("--max-events", given->what.max_events,
                     "Events per return before `budget` (1e5)")
        ->check(CLI::Range(1.0, 1e15));
    command
        ->add_option("--tolerance", given->what.tolerance,
                     "Local relative error of integrated flows in double (1e-10)")
        ->check(CLI::Range(least_tolerance, greatest_tolerance));
    command->add_flag("--derivative", given->what.has_derivative,
                      "Derivatives of the final state too");
    command->callback([given, &exit_code] { exit_code = eval(*given); });
}

}  // namespace hopscotch
