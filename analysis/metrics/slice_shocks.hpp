// Minimal critical shocks on maps over state and parameters: attractors change with the parameters,
// so that a kick is looked for in each slice of fixed parameters, from the attractors of that
// slice.
#pragma once

#include "analysis/metrics/critical_shock.hpp"

#include <functional>
#include <span>

namespace hopscotch::metrics {

/// How a map is cut.
struct slice_choice {
    std::vector<std::string> axes;  // whose values are fixed in a slice; those the map has are used

    /// The attractors at the given index along each of `axes` (0 where the map has only one cell
    /// along it). Called from several threads.
    std::function<attractor_points(std::span<const std::uint64_t>)> attractors;
};

struct slice_shocks {
    std::vector<double> at;              // values of the fixed axes
    std::vector<critical_shock> shocks;  // of the attractors that have a point in the slice
};

struct shocks_over_parameters {
    std::vector<axis> axes;            // fixed in every slice; empty: the map has no such axis
    std::vector<slice_shocks> slices;  // in C order over them
};

/// `critical_shocks` of every slice, in the units of the axes that are left.
///
/// \return  no slices where no axis is fixed, or all are
shocks_over_parameters critical_shocks_of_slices(const class_grid& grid,
                                                 const slice_choice& choice);

}  // namespace hopscotch::metrics
