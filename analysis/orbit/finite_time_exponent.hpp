// How much a return map has stretched neighbouring starts along one orbit: the finite-time Lyapunov
// exponent of the layer `exponent`.
#pragma once

#include "analysis/orbit/orbit_functions.hpp"

namespace hopscotch {

/// log |DP^n| / n with the Frobenius norm, n = start.returns, from exact derivatives return by
/// return; -infinity where a derivative vanishes on the way.
///
/// \param ends_on  section and number of columns that completed returns are read on
/// \return         per return; NaN where n = 0 or a return cannot be repeated from the state read
double finite_time_exponent(const orbit_functions& model, const jet_query& start, int ends_on,
                            int n_start_columns, int n_end_columns);

}  // namespace hopscotch
