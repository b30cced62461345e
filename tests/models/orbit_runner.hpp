// Runs rows of a model through its orbits in any arithmetic, with parameters and options by name:
// what the model tests share.
#pragma once

#include "tests/models/model_orbits.hpp"

#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hopscotch::testing_models {

enum class arithmetic { plain, wide, mp50 };

/// One row: what `eval` would be given.
struct model_row {
    std::string section;
    std::vector<std::string> columns;
    std::vector<std::pair<std::string, std::string>> set;  // parameters
    std::vector<std::pair<std::string, std::string>> options;
    std::uint32_t returns = 1;
    bool derivative = false;
};

template <class Model>
int index_of_section(const std::string& name) {
    for (std::size_t i = 0; i < Model::info.sections.size(); ++i) {
        if (Model::info.sections[i].name == name) return static_cast<int>(i);
    }
    throw std::invalid_argument("no section " + name);
}

template <class Model>
std::vector<int> chosen_options(const model_row& row) {
    std::vector<int> chosen(most_options, 0);
    for (const auto& [name, choice] : row.options) {
        bool found = false;
        for (std::size_t i = 0; i < Model::info.options.size(); ++i) {
            const option_info& option = Model::info.options[i];
            if (option.name != name) continue;
            for (std::size_t c = 0; c < option.choices.size(); ++c) {
                if (option.choices[c] != choice) continue;
                chosen[i] = static_cast<int>(c);
                found = true;
            }
        }
        if (!found) throw std::invalid_argument("no option " + name + " = " + choice);
    }
    return chosen;
}

template <class Model>
std::vector<std::string> all_parameters(const model_row& row) {
    std::vector<std::string> values;
    for (const parameter_info& parameter : Model::info.parameters) {
        values.push_back(print_real(parameter.standard));
    }
    for (const auto& [name, value] : row.set) {
        bool found = false;
        for (std::size_t i = 0; i < Model::info.parameters.size(); ++i) {
            if (Model::info.parameters[i].name != name) continue;
            values[i] = value;
            found = true;
        }
        if (!found) throw std::invalid_argument("no parameter " + name);
    }
    return values;
}

template <class Model>
orbit_answer run_row(const model_row& row, arithmetic kind = arithmetic::plain) {
    const std::vector<int> options = chosen_options<Model>(row);
    const std::vector<std::string> parameters = all_parameters<Model>(row);
    std::vector<double> numbers;
    for (const std::string& text : parameters) numbers.push_back(parse_real<double>(text));
    const std::string_view refused = Model::refusal(numbers.data(), options.data());
    if (!refused.empty()) throw std::invalid_argument(std::string(refused));
    orbit_row orbit{.section = index_of_section<Model>(row.section), .options = options.data()};
    orbit.variant = Model::variant({numbers.data(), numbers.data(), options.data()});
    orbit.columns = row.columns;
    orbit.parameters = parameters;
    orbit.returns = row.returns;
    orbit.derivative = row.derivative;
    const orbit_functions& functions = orbits_of<Model>();
    if (kind == arithmetic::plain) return functions.run_double(orbit);
    if (kind == arithmetic::wide) return functions.run_dd(orbit);
    return functions.run_mp50(orbit);
}

inline double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

}  // namespace hopscotch::testing_models
