// What a generated tangent unit needs: its lane type and the table of one tangent ensemble per
// compile-time variant.
#pragma once

#include "kernels/ensemble/instantiate.hpp"
#include "kernels/ensemble/tangent.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

#if HOPSCOTCH_REGISTERS > 0
/// A lane of many directions fills the registers by itself.
template <class Model>
using tangent_real = pack<n_directions<Model>() == 1 ? HOPSCOTCH_REGISTERS : 1>;
#else
template <class Model>
using tangent_real = double;
#endif

template <class Model, class Real, class Variants>
struct tangent_functions;

template <class Model, class Real, int... Variant>
struct tangent_functions<Model, Real, std::integer_sequence<int, Variant...>> {
    static constexpr ensemble_function table[] = {&run_tangent_ensemble<Model, Variant, Real>...};
};

/// One tangent ensemble per variant of the model.
template <class Model>
inline constexpr const ensemble_function* tangent_table =
    tangent_functions<Model, tangent_real<Model>,
                      std::make_integer_sequence<int, Model::n_variants>>::table;

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
