// The trap that fills the places which a parameter point with fewer traps than others does not
// need.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <limits>

namespace hopscotch {

/// Holds no state: its square is never below 1.
inline trap_ellipsoid no_ellipsoid() {
    trap_ellipsoid nothing{};
    nothing.n_columns = 1;
    nothing.shape[0] = std::numeric_limits<double>::quiet_NaN();
    return nothing;
}

}  // namespace hopscotch
