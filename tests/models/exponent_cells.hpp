// Lyapunov exponents of registered models, with parameters by name: what the tests of published
// exponents share.
#pragma once

#include "host/run/backends.hpp"
#include "kernels/contract/entry.hpp"
#include "kernels/contract/motion.hpp"

#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace hopscotch::testing_models {

struct exponent_cells {
    std::string_view model;
    std::string_view section;
    std::vector<std::vector<double>> columns;  // one list per column of the section, equally long
    std::vector<std::pair<std::string_view, double>> set;  // parameters, the same for all cells
    std::vector<int> options;                              // choices
    exponent_request wanted{};
    std::uint32_t returns = 10000;

    std::vector<std::vector<double>> exponents;  // [k][cell]
    std::vector<double> rate, error;
    std::vector<std::uint8_t> motions, ends;
    std::vector<std::uint32_t> used;

    std::size_t size() const { return columns[0].size(); }
    enum motion motion_of(std::size_t i) const { return static_cast<enum motion>(motions[i]); }
    outcome end_of(std::size_t i) const { return static_cast<outcome>(ends[i]); }

    void compute() {
        const model_entry& entry = *find_model(model);
        const std::size_t n = size();
        ensemble_request request;
        request.n_cells = n;
        request.section = section_index(*entry.info);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            request.columns[c] = {columns[c].data(), 1, n};
        }
        std::vector<double> parameters;
        for (const parameter_info& parameter : entry.info->parameters) {
            parameters.push_back(value_of(parameter));
        }
        for (std::size_t p = 0; p < parameters.size(); ++p) {
            request.parameters[p].values = &parameters[p];
        }
        options.resize(most_options, 0);
        for (std::size_t o = 0; o < options.size(); ++o) request.options[o] = options[o];
        request.max_returns = wanted.transient + returns;
        exponents.assign(entry.info->sections[0].columns.size(), std::vector<double>(n));
        rate.resize(n), error.resize(n), motions.resize(n), ends.resize(n), used.resize(n);
        request.exponents = wanted;
        for (std::size_t k = 0; k < exponents.size(); ++k) {
            request.exponents.exponents[k] = exponents[k].data();
        }
        request.exponents.rate = rate.data();
        request.exponents.standard_error = error.data();
        request.exponents.returns = used.data();
        request.exponents.motion = motions.data();
        request.outcome = ends.data();
        const int variant = entry.variant({parameters.data(), parameters.data(), options.data()});
        choose_kernel(entry, variant, "auto", kernel_kind::tangent).run(request);
    }

private:
    int section_index(const model_info& info) const {
        for (std::size_t s = 0; s < info.sections.size(); ++s) {
            if (info.sections[s].name == section) return static_cast<int>(s);
        }
        throw std::invalid_argument("no such section");
    }
    double value_of(const parameter_info& parameter) const {
        for (const auto& [name, value] : set) {
            if (name == parameter.name) return value;
        }
        return parameter.standard;
    }
};

inline std::vector<double> spread(double lowest, double highest, std::size_t n) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
        values.push_back(lowest + (highest - lowest) * (static_cast<double>(i) + 0.5) /
                                      static_cast<double>(n));
    }
    return values;
}

}  // namespace hopscotch::testing_models
