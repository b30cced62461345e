// The smallest kick that throws an attractor's point out of its basin, and how far the basin
// reaches from it along every axis.
#pragma once

#include "analysis/metrics/class_grid.hpp"

#include <map>

namespace hopscotch::metrics {

/// The nearest cell of another class, and what else lies near.
struct nearest_other {
    double distance = 0.0;   // from the point to that cell's centre; infinite where there is none
    std::vector<double> at;  // axis values of that cell
    int class_there = -1;    // its class number
    double distance_to_edge = 0.0;       // to the map's outermost cell centres
    double distance_to_undecided = 0.0;  // to a cell without a class; infinite where none is nearer

    /// Beyond the map's edge another basin may be nearer.
    bool is_limited_by_edge() const { return distance > distance_to_edge; }
    bool is_limited_by_undecided() const { return distance > distance_to_undecided; }
};

/// What ends a basin along an axis.
enum class basin_end : std::uint8_t { other_basin, undecided, edge };

/// How far the basin reaches from a point along one axis: to the first cell that is not its own.
struct axis_extent {
    double left = 0.0;  // axis units: differences of values, or of logarithms
    double right = 0.0;
    basin_end left_end = basin_end::other_basin;
    basin_end right_end = basin_end::other_basin;
};

struct critical_shock {
    int label = 0;
    std::string name;
    bool is_defined = false;
    std::string why;               // where it is not
    std::size_t n_points = 0;      // of the attractor
    std::size_t n_in_map = 0;      // of them in the map's plane and range
    std::vector<double> point;     // the one that is nearest to another basin (axis values)
    bool is_in_own_basin = false;  // the cell nearest to that point carries the attractor's label
    nearest_other in_axis_units;
    nearest_other in_cells;
    std::vector<axis_extent> extents;  // of that point, per axis
};

/// The state columns in which attractors' points are given, and where the map's plane lies in those
/// that are no axis (a column without a value: unknown).
struct attractor_points {
    std::vector<attractor_row> attractors;
    std::vector<std::string> columns;
    std::map<std::string, double> plane;
};

/// The minimal critical shock of every attractor that has a label's class: the shortest distance
/// from any of its points to a cell of another class (cells without a class do not count,
/// but are told where they are nearer). Points
/// off the plane by more than 1e-6 of the value there are left out, so are points outside the map.
/// The basin's boundary lies up to one cell before the cell found.
/// Source: Halekotte, Feudel, Sci. Rep. 10, 11783 (2020) for the minimal fatal (critical) shock.
std::vector<critical_shock> critical_shocks(const class_grid& grid, const attractor_points& points);

}  // namespace hopscotch::metrics
