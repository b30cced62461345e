// hopscotch trace MODEL: every event of one orbit.
#include "host/cli/commands.hpp"
#include "host/cli/model_argument.hpp"
#include "host/cli/row_source.hpp"
#include "host/cli/text_output.hpp"
#include "host/cli/trace_writer.hpp"
#include "host/scene/scene.hpp"

#include <memory>

#include <CLI/CLI.hpp>

namespace hopscotch {
namespace {

struct trace_arguments {
    std::string model;
    std::string section;
    std::vector<std::string> sets;
    std::uint32_t returns = 1;
    double max_events = 1e5;
    double tolerance = standard_tolerance;
    int samples = 0;
    std::string format = "csv";
    std::string output;
};

int trace(const trace_arguments& given) {
    const model_entry& model = model_named(given.model);
    const row_source rows(model, section_named(*model.info, given.section), given.sets);
    const start_row start = rows.row(0);
    orbit_row row;
    row.section = rows.section();
    row.options = start.options.data();
    row.variant = model.variant(
        {start.parameters.data(), start.parameters.data(), start.options.data(), true});
    row.columns = start.column_texts;
    row.parameters = start.parameter_texts;
    row.returns = given.returns;
    row.max_steps = given.max_events;
    row.tolerance = given.tolerance;
    const auto format = given.format == "csv" ? trace_format::csv : trace_format::jsonl;
    put_text(given.output, trace_text(model, row, given.samples, format));
    return exit_done;
}

}  // namespace

void add_trace(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<trace_arguments>();
    CLI::App* command = program.add_subcommand("trace", "Every event of one orbit");
    command->add_option("model", given->model, "Model")->required();
    command->add_option("--section", given->section, "Section; the model's first if not given");
    command->add_option("--set", given->sets, "name=value: start, parameters, options");
    command->add_option("--returns", given->returns, "Returns (1)")
        ->check(CLI::Range(1u, 4000000000u));
    command->add_option("--samples", given->samples, "Samples per phase (0)")
        ->check(CLI::Range(0, 1000000));
    command->add_option("--format", given->format, "csv or jsonl")
        ->check(CLI::IsMember({"csv", "jsonl"}));
    command
        ->add_option("--max-events", given->max_events, "Events per return before `budget` (1e5)")
        ->check(CLI::Range(1.0, 1e15));
    command
        ->add_option("--tolerance", given->tolerance,
                     "Local relative error of integrated flows in double (1e-10)")
        ->check(CLI::Range(least_tolerance, greatest_tolerance));
    command->add_option("--output", given->output, "File; standard output if not given");
    command->callback([given, &exit_code] { exit_code = trace(*given); });
}

}  // namespace hopscotch
