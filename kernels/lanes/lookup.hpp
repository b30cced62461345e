// Reads a small table at each lane's own index. Exact, hence the same on every target.
#pragma once

#include "kernels/lanes/lane.hpp"
#include "kernels/lanes/scalar.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// table[index], lane-wise. A pack gathers.
///
/// \param index  integral, within the table
template <binary64_lane Real, int Size>
HOPSCOTCH_DEVICE inline Real lookup(const double (&table)[Size], const Real& index) {
    if constexpr (width_of < Real >> 1) {
        return gather(table, index);
    } else {
        return table[static_cast<int>(index)];
    }
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
