// Fills a model's entry from its contract; used by the generated entry units.
#pragma once

#include "kernels/contract/entry.hpp"
#include "kernels/contract/model.hpp"

#include <utility>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// A model some of whose columns are phases that wrap: turn(section, column, parameters) is the
/// length of a full turn, 0 for a column that does not wrap.
template <class Model>
concept has_turns = requires(const double* parameters) {
    { Model::turn(0, 0, parameters) } -> std::same_as<double>;
};

template <class Model, int... Variant>
bool one_integrates(int variant, std::integer_sequence<int, Variant...>) {
    return ((variant == Variant && integrates<Model, Variant, double>) || ...);
}

/// Whether a compile-time variant of the model integrates a flow.
template <class Model>
bool variant_integrates(int variant) {
    return one_integrates<Model>(variant, std::make_integer_sequence<int, Model::n_variants>{});
}

/// The parts of an entry that come from the header alone; kernels and orbits are added by the unit.
template <class Model>
constexpr model_entry described_entry() {
    model_entry entry{};
    entry.info = &Model::info;
    entry.n_variants = Model::n_variants;
    entry.variant = &Model::variant;
    entry.refusal = &Model::refusal;
    if constexpr (labels_by_certificate<Model>) {
        entry.certificate_covers = &Model::certificate_covers;
        entry.describe_label = &Model::describe_label;
    }
    entry.integrates = &variant_integrates<Model>;
    if constexpr (has_contact<Model>) entry.contact = &Model::contact;
    entry.has_gap = has_gap<Model>;
    if constexpr (has_branches<Model>) entry.branch = &Model::branch;
    if constexpr (has_turns<Model>) entry.turn = &Model::turn;
    return entry;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
