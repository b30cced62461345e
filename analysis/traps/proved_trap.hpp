// The largest trap ellipsoid around a stable periodic point that can be proved to be one. Used for
// the labels of maps whose models bring no certificate of their own.
#pragma once

#include "analysis/orbit/contraction.hpp"
#include "analysis/periodic/map_point.hpp"

#include <optional>
#include <span>

namespace hopscotch {

/// A periodic point whose trap is looked for.
struct stable_point {
    const map_point* map = nullptr;
    int period = 1;                           // P^period is the map that contracts
    std::span<const double> point;            // the section's columns
    std::span<const double> multiplier = {};  // DP^period, row by row; empty: from the map's jet
    std::span<const bool> is_fixed = {};      // columns the flow conserves; empty: none
};

struct proved_trap {
    trap_ellipsoid trap;  // label 0
    contraction_bound bound;
    double volume;  // of the ellipsoid over that of the unit ball: 1 / |det A|
};

/// How hard to look.
struct trap_search {
    int most_pieces = 64;      // an ellipsoid is cut into at most so many parts by a proof
    int most_reshapings = 6;   // rounds in which the axes' ratios are varied
    double first_size = 1e-2;  // semi-axes tried first, relative to the point's largest column
};

/// The largest proved trap of the point, or why there is none.
///
/// \return      nothing where not even the smallest size tried (1e-9) is proved; `why` says why
/// The axes are the multiplier's eigenvectors, or come from Stein's equation where those are nearly
/// dependent, so that |A M A^-1| is about the spectral radius. Size by bisection, ratios of the
/// axes by coordinate search for the largest volume.
std::optional<proved_trap> largest_trap(const stable_point& at, contraction_verdict* why = nullptr,
                                        const trap_search& search = {});

}  // namespace hopscotch
