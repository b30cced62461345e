// One return map: a model with its section, options and all parameters fixed. What searches for
// periodic orbits, traps and branches work on.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"

#include <vector>

namespace hopscotch {

struct map_point {
    const model_entry* model = nullptr;
    int section = 0;           // a section whose returns end on itself
    std::vector<int> options;  // index of the choice, one per option
    int variant = 0;           // compile-time variant, from model_entry::variant
    std::vector<double> parameters;
    double max_steps = 1e5;  // of work per return before the outcome `budget`

    const section_info& columns_of() const {
        return model->info->sections[static_cast<std::size_t>(section)];
    }
    int n_columns() const { return static_cast<int>(columns_of().columns.size()); }

    /// P^returns at x with its exact derivatives.
    ///
    /// \param x             one number per column
    /// \param by_parameter  also differentiate by this parameter (-1: none)
    return_jet jet(const double* x, std::uint32_t returns = 1, int by_parameter = -1) const {
        return model->orbits().jet({.section = section,
                                    .options = options.data(),
                                    .variant = variant,
                                    .columns = x,
                                    .parameters = parameters.data(),
                                    .returns = returns,
                                    .max_steps = max_steps,
                                    .by_parameter = by_parameter});
    }
};

}  // namespace hopscotch
