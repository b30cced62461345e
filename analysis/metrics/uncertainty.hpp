// Final-state uncertainty: how the share of cells whose fate an error of size s can change falls
// with s, and its exponent.
#pragma once

#include "analysis/metrics/class_grid.hpp"
#include "analysis/metrics/scaling_fit.hpp"

namespace hopscotch::metrics {

/// A cell is uncertain at s if one of the cells s steps away along any axis has another class. The
/// fraction of uncertain cells goes like s^alpha, alpha = (axes) - (dimension of the boundary); 1
/// for a smooth boundary. s = 1, 2, 3, 4, 6, 8 ... up to 1/16 of the shortest axis, but 4 where
/// that has 12 cells; the same inner cells at every s. Cells that are without a class themselves or
/// meet one are no trial. Source: Grebogi, McDonald, Ott, Yorke, Phys. Lett. A 99, 415 (1983).
scaling_by_class uncertainty_of(const class_grid& grid);

}  // namespace hopscotch::metrics
