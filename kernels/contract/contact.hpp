// The contact that a model's bodies make and break, for the layers that say how near an orbit comes
// to touching without touching and how hard it hits. A model that offers it says in which mode of
// its trace the gap is open, which event closes it, and what the gap is.
//
//   static constexpr contact_info contact{"flight", "impact", "1", "1", "foot above the ground"};
//   static contact_gap gap(const double* columns, const double* parameters, const int* options);
//                                   // from the trace's columns; may be left out
//   static double impact_speed(const double* before, const double* after, const double* parameters);
//                                   // where it is not the rate at which the gap closes
#pragma once

#include <concepts>
#include <string_view>

namespace hopscotch {

struct contact_info {
    std::string_view mode;        // of the trace in which the gap is open
    std::string_view event;       // of the trace that closes it
    std::string_view gap_unit;    // "1" where dimensionless
    std::string_view speed_unit;  // of impacts
    std::string_view meaning;     // what the gap is
};

struct contact_gap {
    double value;  // > 0 between contacts
    double rate;
};

/// A model whose impacts have a speed.
template <class Model>
concept has_contact = requires {
    { Model::contact.mode } -> std::convertible_to<std::string_view>;
};

/// A model whose gap can be measured at any time.
template <class Model>
concept has_gap = has_contact<Model> && requires(const double* numbers, const int* options) {
    { Model::gap(numbers, numbers, options) } -> std::same_as<contact_gap>;
};

/// Speed of an impact, from the states just before and after it.
template <class Model>
double impact_speed_of(const double* before, const double* after, const double* parameters,
                       const int* options) {
    if constexpr (requires { Model::impact_speed(before, after, parameters); }) {
        return Model::impact_speed(before, after, parameters);
    } else {
        return -Model::gap(before, parameters, options).rate;
    }
}

}  // namespace hopscotch
