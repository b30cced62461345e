// Return maps by name for the tests of analysis/.
#pragma once

#include "analysis/periodic/map_point.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace hopscotch::testing_maps {

using settings = std::vector<std::pair<std::string_view, double>>;
using choices = std::vector<std::pair<std::string_view, std::string_view>>;

template <class Rows>
int index_named(const Rows& rows, std::string_view name) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].name == name) return static_cast<int>(i);
    }
    throw std::invalid_argument("no " + std::string(name));
}

/// The return map of a model's section at its defaults but for the settings and options given.
inline map_point map_of(std::string_view model, std::string_view section,
                        const settings& parameters = {}, const choices& options = {}) {
    map_point map;
    map.model = find_model(model);
    const model_info& info = *map.model->info;
    map.section = index_named(info.sections, section);
    for (const parameter_info& parameter : info.parameters) {
        map.parameters.push_back(parameter.standard);
    }
    for (const auto& [name, value] : parameters) {
        map.parameters[static_cast<std::size_t>(index_named(info.parameters, name))] = value;
    }
    map.options.assign(info.options.size(), 0);
    for (const auto& [name, choice] : options) {
        const auto option = static_cast<std::size_t>(index_named(info.options, name));
        const auto& known = info.options[option].choices;
        for (std::size_t i = 0; i < known.size(); ++i) {
            if (known[i] == choice) map.options[option] = static_cast<int>(i);
        }
    }
    map.variant = map.model->variant(
        {map.parameters.data(), map.parameters.data(), map.options.data(), true});
    return map;
}

}  // namespace hopscotch::testing_maps
