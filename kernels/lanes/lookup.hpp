// Reads a small table at each lane's own index. Exact, hence the same on every target.
#pragma once

#include "kernels/lanes/lane.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// table[index], lane-wise. \param index integral, within the table
template <binary64_lane Real, int Size>
HOPSCOTCH_DEVICE inline Real lookup(const double (&table)[Size], const Real& index) {
    Real result;
    const double* at = reinterpret_cast<const double*>(&index);
    double* to = reinterpret_cast<double*>(&result);
    for (int lane = 0; lane < width_of<Real>; ++lane) to[lane] = table[static_cast<int>(at[lane])];
    return result;
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
