// One-sided stability over parameters: of every attractor at every parameter point, on both sides
// (in more than one dimension, in every direction sector), does it attract, by which law, how far
// does the immediate basin reach, and how much of the whole basin lies there? What the question
// one_sided is answered with beside its map.
#pragma once

#include "analysis/attractors/side_kind.hpp"
#include "analysis/metrics/class_grid.hpp"
#include "host/run/label_plan.hpp"
#include "host/scene/scene.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace hopscotch {

/// The starts on one side of a point, or nearest to one direction from it.
struct orbit_side {
    std::vector<double> direction;  // one number per column, unit length in the scale
    side_kind kind = side_kind::repelling;
    double coefficient = 0.0;  // |P^p(x) - x| ~ coefficient d^exponent at distance d
    double exponent = 0.0;
    double extent = 0.0;     // of the immediate basin: the connected part of the basin
    bool is_bounded = true;  // false: it reaches as far as was looked, or to the domain's edge
    double share = std::numeric_limits<double>::quiet_NaN();  // of the slice's decided starts: on
    double share_error = std::numeric_limits<double>::quiet_NaN();  // this side, and in the basin
};

/// One attractor at one parameter point; sides of one of its points.
struct sided_orbit {
    std::size_t point = 0;  // parameter point, in C order over the table's axes
    int label = 0;
    std::string name;
    int period = 1;
    std::vector<double> state;  // one number per column of the section
    std::vector<double> scale;  // unit of distances in each column
    std::vector<orbit_side> sides;
};

struct side_table {
    std::vector<std::size_t> axes;  // of the scene, over which attractors change
    std::size_t n_points = 1;
    std::vector<sided_orbit> orbits;  // by rising parameter point
};

/// The sides of every attractor of the plan that has a point: lossless points and trap intervals of
/// one-dimensional maps, cycles found by search, cycles of a model's certificate. Extents are exact
/// to 1e-12, as far as starts were looked at in between. Shares are not known yet.
side_table sides_of(const scene& scene, const label_plan& plan);

/// Fills the shares in from the finished map: its starts are those of the axes that are no
/// parameters.
///
/// \param map  the label layer; shares stay NaN where it has no axis of starts
void add_shares(side_table& table, const scene& scene, const metrics::class_grid& map);

}  // namespace hopscotch
