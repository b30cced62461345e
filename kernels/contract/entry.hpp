// The kernels' public entry points: one table per model with its description, its choice of
// compile-time variant and its ensemble functions per backend. Filled by generated instantiation
// units; a model is found here by name, so no code ever switches on a model.
#pragma once

#include "kernels/contract/contact.hpp"
#include "kernels/contract/info.hpp"
#include "kernels/ensemble/request.hpp"

#include <span>
#include <string_view>

namespace hopscotch {

struct orbit_functions;  // scalar orbits in other arithmetics, see
                         // analysis/orbit/orbit_functions.hpp

struct model_entry {
    const model_info* info;
    int n_variants;
    int (*variant)(const variant_query&);
    std::string_view (*refusal)(const double* parameters, const int* options);
    // null where the model does not offer them, see contract/model.hpp
    bool (*certificate_covers)(const variant_query&);
    bool (*describe_label)(int label, label_description&);
    bool (*branch)(int index, const double* parameters, map_branch&);
    double (*turn)(int section, int column, const double* parameters);
    bool (*integrates)(int variant);  // does accuracy.tolerance decide its numbers?
    const contact_info* contact;
    bool has_gap;  // can the contact's gap be measured?
    // Tables are reached through pointers to them, so that no unit depends on another's
    // initialisation.
    const ensemble_function* const* kernels[n_backends];   // per backend; null where not built
    const ensemble_function* const* tangents[n_backends];  // the same with exponents
    const orbit_functions* const* orbits_table;

    bool has(backend which) const { return kernels[static_cast<int>(which)] != nullptr; }
    ensemble_function kernel(backend which, int compiled_variant) const {
        return (*kernels[static_cast<int>(which)])[compiled_variant];
    }
    bool has_tangent(backend which) const { return tangents[static_cast<int>(which)] != nullptr; }
    ensemble_function tangent(backend which, int compiled_variant) const {
        return (*tangents[static_cast<int>(which)])[compiled_variant];
    }
    const orbit_functions& orbits() const { return **orbits_table; }
};

/// Every model built into the program, sorted by name.
std::span<const model_entry* const> all_models();

/// The model of that name, or null.
const model_entry* find_model(std::string_view name);

}  // namespace hopscotch
