// How much of the map, or of a reference box in it, each basin holds.
#pragma once

#include "analysis/metrics/class_grid.hpp"

#include <limits>

namespace hopscotch::metrics {

/// The cells whose axis values lie in these ranges; one pair per axis of the grid.
struct value_box {
    std::vector<double> lowest;
    std::vector<double> highest;

    /// Every cell.
    static value_box whole(const class_grid& grid) {
        constexpr double all = std::numeric_limits<double>::infinity();
        return {std::vector<double>(grid.rank(), -all), std::vector<double>(grid.rank(), all)};
    }
};

struct basin_share {
    std::uint64_t n_cells = 0;
    double share = 0.0;    // of the cells that have a class
    double error = 0.0;    // standard error of that share; NaN below 4 cells along an axis
    double lowest = 0.0;   // if every cell without a class belonged to other basins
    double highest = 0.0;  // if every one of them belonged to this basin
};

struct basin_shares {
    std::uint64_t n_cells = 0;    // in the box
    std::uint64_t n_decided = 0;  // of them with a class
    std::vector<basin_share> classes;
};

/// Shares of all classes. For a map of starts the share of a reference box is the basin stability
/// of Menck, Heitzig, Marwan, Kurths, Nature Physics 9, 89 (2013), with starts spread evenly over
/// the axes' scales.
///
/// Standard error: cells are points of a grid and no random draws, p (1 - p) / N says nothing about
/// them. The grid is taken apart into interleaved coarser grids (every 8th cell along each axis,
/// fewer where the box is small), each of which is a systematic sample of its own; their standard
/// deviation is carried over to the whole grid, whose step h is k times shorter, as h^b with b =
/// 1/2 for one axis and 1 for more: the slowest law there is, of a boundary that fills space or
/// lies along the grid. So it errs on the large side, by 1.5 to 4 for smooth boundaries. Along one
/// axis it is at least that of boundaries which lie anywhere between their two cells; over more, a
/// straight boundary along an axis at a multiple of 8 cells shows no error at all. Source:
/// interpenetrating systematic samples, Cochran, Sampling Techniques (1977), chapter 8.
///
/// \error store_error for a box without a cell
basin_shares shares_in(const class_grid& grid, const value_box& box);

}  // namespace hopscotch::metrics
