// What labels rest on, as tables of a map file's group /traps: trap intervals and ellipsoids,
// immediate basins and chaotic sets of every parameter point. Written by a run, read back bit for
// bit by whatever needs the plan of a finished map.
//
//   attributes            decided_by = intervals | ellipsoids; died_label; columns of the states;
//                         point_axes: the axes of the map over which `point` counts in C order (the
//                         last one fastest; none: one point for the whole map); plan_digest: of the
//                         whole plan, attractors included
//   interval_label(point, interval), interval_ends(point, interval, end)
//   placed_point(orbit), placed_label(orbit), placed_n_points(orbit), placed_points(place, column)
//                         where the intervals' orbits lie at every parameter point, one after the
//                         other
//   ellipsoid_label(point, ellipsoid), centre(point, ellipsoid, column),
//   shape(point, ellipsoid, row, column)
//                         the states x of the section with |A (x - centre)| <= 1, A the shape: its
//                         rows are the axes of the norm in which the map contracts, divided by the
//                         bound
//   immediate_label(point, side), immediate_ends(point, side, end)
//   chaotic_point(set), chaotic_label(set), chaotic_boxes_along(set), chaotic_n_boxes(set),
//   chaotic_lowest(set, column), chaotic_highest(set, column), chaotic_box(box, column)
//                         the boxes of all sets one after the other, each by its place along every
//                         column (host/run/state_cover.hpp)
//
// A label 0 marks a place that its point does not need. Labels, periods and multipliers are told in
// /attractors.
#pragma once

#include "host/map/table_group.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <optional>

namespace hopscotch {

inline constexpr const char* traps_group = "/traps";

/// None where nothing was searched (the model's own proof, a plan per cell), and where the numbers
/// would be more than 2^23: then whoever needs the plan searches anew.
std::optional<table_group> tables_of(const scene& scene, const label_plan& plan);

/// The plan but for its attractors, which a map tells elsewhere, and `searched`.
/// \error  store_error where the tables do not fit each other
label_plan plan_from(const scene& scene, const table_group& group);

}  // namespace hopscotch
