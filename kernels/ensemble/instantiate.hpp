// What a generated instantiation unit needs: the lane type of its target and the table of one
// ensemble function per compile-time variant.
#pragma once

#include "kernels/ensemble/loop.hpp"

#include <utility>

#if HOPSCOTCH_REGISTERS > 0
#include "kernels/lanes/pack.hpp"
#endif

namespace hopscotch::inline HOPSCOTCH_TARGET {

#if HOPSCOTCH_REGISTERS > 0
using kernel_real = pack<HOPSCOTCH_REGISTERS>;
#else
using kernel_real = double;
#endif

template <class Model, class Real, class Variants>
struct kernel_functions;

template <class Model, class Real, int... Variant>
struct kernel_functions<Model, Real, std::integer_sequence<int, Variant...>> {
    static constexpr ensemble_function table[] = {&run_ensemble<Model, Variant, Real>...};
};

/// One ensemble function per variant of the model.
template <class Model, class Real>
inline constexpr const ensemble_function* kernel_table =
    kernel_functions<Model, Real, std::make_integer_sequence<int, Model::n_variants>>::table;

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
