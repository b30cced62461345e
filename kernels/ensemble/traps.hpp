// Whether a state lies in a trap ellipsoid; the same sum in every arithmetic, so that packs and
// single orbits agree bit for bit.
#pragma once

#include "kernels/ensemble/request.hpp"
#include "kernels/lanes/lane.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// |A (x - centre)|^2 <= 1.
///
/// \param x  the section's columns, trap.n_columns of them
template <class Real>
HOPSCOTCH_DEVICE inline mask_of<Real> holds(const trap_ellipsoid& trap, const Real* x) {
    Real square(0.0);
    for (int i = 0; i < trap.n_columns; ++i) {
        Real row(0.0);
        for (int j = 0; j < trap.n_columns; ++j) {
            row = fma(Real(trap.shape[i * trap.n_columns + j]), x[j] - Real(trap.centre[j]), row);
        }
        square = fma(row, row, square);
    }
    return square <= Real(1.0);
}

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
