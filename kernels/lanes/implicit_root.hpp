// The derivative of a root found by iteration, for every Real: dual numbers get it from the
// implicit function theorem (their overload is in dual.hpp), all other types are returned
// unchanged. Event location calls it on each converged event time; this is where the saltation term
// comes from.
#pragma once

#include "kernels/lanes/lane.hpp"

#include <concepts>

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class Real>
concept without_derivatives = std::same_as<primal_of<Real>, Real>;

/// The converged root as a Real that carries derivatives.
///
/// \param root      root of the primal residual, converged
/// \param residual  the residual evaluated in Real arithmetic at `root`; its primal part is about
///                  zero
/// \param slope     primal derivative of the residual with respect to the root, not zero
/// \return          primal value exactly `root`; derivatives -residual' / slope
template <without_derivatives Real>
HOPSCOTCH_DEVICE inline Real implicit_root(const primal_of<Real>& root, const Real& /*residual*/,
                                           const primal_of<Real>& /*slope*/) {
    return root;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
