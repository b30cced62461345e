// [model], [model.parameters], [model.options]: which system, with which numbers and choices.
#include "host/scene/readers.hpp"

#include "host/scene/grid.hpp"
#include "host/scene/range_text.hpp"
#include "host/scene/suggest.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hopscotch {
namespace {

const model_entry* find_by_name(const table_reader& table,
                                std::span<const model_entry* const> models) {
    std::vector<std::string_view> names;
    for (const model_entry* entry : models) names.push_back(entry->info->name);
    const auto name = table.text("name");
    if (!name) table.missing("name", "a scene names its model", "one of " + listed(names));
    for (const model_entry* entry : models) {
        if (entry->info->name == *name) return entry;
    }
    table.refuse("name", "no such model", suggest(*name, names));
}

void read_parameters(scene& scene, const table_reader& table) {
    const auto known = names_of(scene.info().parameters);
    table.expect_keys(known, fmt::format("parameter of {}", scene.info().name));
    for (const parameter_info& parameter : scene.info().parameters) {
        const auto given = table.number(parameter.name);
        scene.is_given.push_back(given.has_value());
        scene.parameters.push_back(given.value_or(parameter.standard));
        if (given && !parameter.valid.holds(*given)) {
            table.refuse(parameter.name, "outside " + written(parameter.valid));
        }
    }
}

void read_options(scene& scene, const table_reader& table) {
    const auto known = names_of(scene.info().options);
    table.expect_keys(known, fmt::format("option of {}", scene.info().name));
    for (const option_info& option : scene.info().options) {
        const auto choice = table.text(option.name);
        int index = 0;
        if (choice) {
            const auto found = std::find(option.choices.begin(), option.choices.end(), *choice);
            if (found == option.choices.end()) {
                table.refuse(option.name, "no such choice", suggest(*choice, option.choices));
            }
            index = static_cast<int>(found - option.choices.begin());
        }
        scene.options.push_back(index);
    }
}

/// Where the scene speaks of the parameter axes, or else of its parameters.
[[noreturn]] void refuse_combination(const scene& scene, const table_reader& root,
                                     const std::vector<double>& parameters, std::string_view why) {
    for (std::size_t index = 0; index < scene.axes.size(); ++index) {
        const scene_axis& axis = scene.axes[index];
        if (axis.kind != axis_kind::parameter) continue;
        const double value = parameters[static_cast<std::size_t>(axis.index)];
        root.table("grid").tables("axis")[index].refuse(
            "name", fmt::format("{} at {} = {}", why, axis.name, value), "another range");
    }
    for (std::size_t index = 0; index < parameters.size(); ++index) {
        if (!scene.is_given[index]) continue;
        root.table("model")
            .table("parameters")
            .refuse(scene.info().parameters[index].name, std::string(why));
    }
    root.table("model").refuse("name", std::string(why));
}

}  // namespace

void read_model(scene& scene, const table_reader& root,
                std::span<const model_entry* const> models) {
    const table_reader table = root.table("model");
    table.expect_keys({"name", "parameters", "options"});
    scene.model = find_by_name(table, models);
    read_parameters(scene, table.table("parameters"));
    read_options(scene, table.table("options"));
}

std::string_view refusal_of(const scene& scene, std::vector<double>* where) {
    const parameter_extremes extremes = extremes_of(scene);
    std::vector<std::size_t> moving;
    for (const scene_axis& axis : scene.axes) {
        if (axis.kind == axis_kind::parameter)
            moving.push_back(static_cast<std::size_t>(axis.index));
    }
    const std::size_t n_corners = std::size_t{1} << moving.size();
    for (std::size_t corner = 0; corner < n_corners; ++corner) {
        std::vector<double> parameters = extremes.lowest;
        for (std::size_t bit = 0; bit < moving.size(); ++bit) {
            const bool is_high = ((corner >> bit) & 1) != 0;
            if (is_high) parameters[moving[bit]] = extremes.highest[moving[bit]];
        }
        const std::string_view why = scene.model->refusal(parameters.data(), scene.options.data());
        if (why.empty()) continue;
        if (where != nullptr) *where = parameters;
        return why;
    }
    return {};
}

void check_refusals(const scene& scene, const table_reader& root) {
    std::vector<double> parameters;
    const std::string_view why = refusal_of(scene, &parameters);
    if (!why.empty()) refuse_combination(scene, root, parameters, why);
}

}  // namespace hopscotch
