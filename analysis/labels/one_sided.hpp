// One-sided stability of the base points of a one-dimensional return map: on which side they
// attract, by which law, and how far their immediate basin reaches. Source:
// models/passive_hopper.md section 4.
#pragma once

#include "analysis/attractors/side_kind.hpp"
#include "analysis/labels/return_map_samples.hpp"
#include "host/run/label_plan.hpp"
#include "kernels/contract/info.hpp"

namespace hopscotch {

/// One side of a fixed point x*: with distance d, |P(x* +- d) - (x* +- d)| ~ coefficient
/// d^exponent.
struct stability_side {
    bool attracts = false;
    side_kind kind = side_kind::repelling;
    double coefficient = 0.0;
    double exponent = 0.0;
    double extent =
        0.0;  // of the immediate basin: an interval from x* that the map sends into itself
};

struct one_sided_stability {
    double point = 0.0;
    stability_side left;
    stability_side right;
};

/// Both sides of the base of a branch.
///
/// \param floor  end of the branch before: how far the left side reaches
/// \error        extents are good to about 1e-12 of the point (the map's own rounding next to it);
/// the law is
///               a fit at distances 1e-6 and 1e-5
one_sided_stability one_sided(const return_map_samples& map, const map_branch& branch,
                              double floor);

/// Both sides of a point of a hyperbolic cycle that a trap interval holds: |P^p(x) - x| next to it;
/// of a fixed point the extents are the trap's, of a longer cycle as far as starts tend to its
/// point.
one_sided_stability one_sided_of_cycle(const return_map_samples& map, double point, int period,
                                       const trap_interval& trap);

/// Both sides of an attractor that is the base of a branch.
struct sided_attractor {
    const attractor_row* row;
    one_sided_stability sides;
};

/// Every attractor of the plan that is the base of a branch, at one parameter point, by rising
/// point.
std::vector<sided_attractor> sided_attractors(const scene& scene, const label_plan& plan,
                                              const std::vector<double>& parameters);

/// The immediate basins of every branch's base at every parameter point of a one_sided scene.
void add_immediate_basins(const scene& scene, label_plan& plan);

}  // namespace hopscotch
