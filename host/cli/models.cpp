// hopscotch models [MODEL]: what can be computed, and one model's parameters, sections and options.
#include "host/cli/commands.hpp"
#include "host/cli/model_argument.hpp"
#include "host/cli/tables.hpp"
#include "host/scene/questions.hpp"
#include "host/scene/range_text.hpp"
#include "kernels/contract/entry.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

using rows = std::vector<std::vector<std::string>>;

std::string listing() {
    rows table;
    for (const model_entry* entry : all_models()) {
        table.push_back({std::string(entry->info->name), std::string(entry->info->title)});
    }
    return aligned(table, 0);
}

rows parameter_rows(const model_info& info) {
    rows table{{"parameter", "symbol", "unit", "default", "range", "meaning"}};
    for (const parameter_info& parameter : info.parameters) {
        const double standard = parameter.standard;
        table.push_back({std::string(parameter.name), std::string(parameter.symbol),
                         std::string(parameter.unit),
                         std::isnan(standard) ? "derived" : fmt::format("{}", standard),
                         written(parameter.valid), std::string(parameter.meaning)});
    }
    return table;
}

std::string section_text(const model_info& info) {
    std::string text;
    for (const section_info& section : info.sections) {
        const auto& target = info.sections[static_cast<std::size_t>(section.returns_to)];
        text += fmt::format("section {}: {}{}\n", section.name, section.meaning,
                            &target == &section ? "" : fmt::format("; returns to {}", target.name));
        rows table{{"column", "unit", "range", "meaning"}};
        for (const column_info& column : section.columns) {
            table.push_back({std::string(column.name), std::string(column.unit),
                             written(column.valid), std::string(column.meaning)});
        }
        text += aligned(table);
    }
    return text;
}

std::string option_text(const model_info& info) {
    rows table;
    for (const option_info& option : info.options) {
        table.push_back({std::string(option.name),
                         fmt::format("{}", fmt::join(option.choices, " | ")),
                         std::string(option.meaning)});
    }
    return table.empty() ? "" : "options (the first choice is the default)\n" + aligned(table);
}

std::string extra_text(const model_info& info) {
    rows table;
    for (const extra_info& extra : info.extras) {
        table.push_back(
            {std::string(extra.name), std::string(extra.unit), std::string(extra.meaning)});
    }
    return table.empty() ? "" : "extras\n" + aligned(table);
}

std::string outcome_text(const model_info& info) {
    std::vector<std::string_view> names;
    for (const outcome code : info.outcomes) names.push_back(name_of(code));
    for (const outcome code : {outcome::budget, outcome::not_finite, outcome::invalid_start}) {
        if (std::find(names.begin(), names.end(), name_of(code)) == names.end()) {
            names.push_back(name_of(code));
        }
    }
    return fmt::format("outcomes\n  {}\n", fmt::join(names, ", "));
}

/// Questions with labels need the model's help to name attractors.
std::string question_text(const model_entry& model) {
    const bool can_label = model.certificate_covers != nullptr || model.branch != nullptr;
    rows table;
    for (const question_kind& kind : question_kinds()) {
        if (!kind.is_map || (kind.has_labels && !can_label)) continue;
        table.push_back({std::string(kind.name), std::string(kind.meaning)});
    }
    return "questions\n" + aligned(table);
}

std::string description(const model_entry& model) {
    const model_info& info = *model.info;
    std::string text = fmt::format("{}: {}\n", info.name, info.title);
    if (!info.reference.empty()) text += fmt::format("{}\n", info.reference);
    text += fmt::format("time unit  {}\n", info.time_unit);
    text += "parameters\n" + aligned(parameter_rows(info));
    text += section_text(info) + option_text(info) + extra_text(info) + outcome_text(info);
    return text + question_text(model);
}

}  // namespace

void add_models(CLI::App& program, int& exit_code) {
    auto name = std::make_shared<std::string>();
    CLI::App* command = program.add_subcommand("models", "List the models, or describe one");
    command->add_option("model", *name, "Model to describe");
    command->callback([name, &exit_code] {
        fmt::print("{}", name->empty() ? listing() : description(model_named(*name)));
        exit_code = exit_done;
    });
}

}  // namespace hopscotch
