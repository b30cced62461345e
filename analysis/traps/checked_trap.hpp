// Trap ellipsoids around stable periodic points, checked with exact derivatives: at the points of a
// design that fills the set, the return map must contract towards the centre in the trap's own
// norm, by the same sequence of events. Used where no enclosure proves the set.
#pragma once

#include "analysis/periodic/map_point.hpp"

#include <Eigen/Dense>

#include <optional>
#include <span>

namespace hopscotch {

struct trap_site {
    std::span<const double> centre;  // one number per column
    int period = 1;
    std::span<const int> free;  // columns that the return map does not conserve, rising
    Eigen::VectorXd scale;      // typical size of every free column
};

/// Derivative of P^period at a point, restricted to the free columns; nothing where the orbit ends
/// or its derivative is not finite.
struct free_derivative {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd image;  // of the free columns
    std::uint64_t events = 0;
};
std::optional<free_derivative> derivative_at(const map_point& map, const trap_site& site,
                                             const Eigen::VectorXd& offset);

/// The largest ellipsoid (in the multipliers' own norm) that passes the check, shrunk by a third
/// for what the design's points may have missed; nothing where the orbit is not stable or no size
/// above 1e-9 of the columns' scale passes.
///
/// \param is_quick  the first size tried that passes will do
std::optional<trap_ellipsoid> checked_trap(const map_point& map, const trap_site& site,
                                           bool is_quick = false);

/// The plain form of |norm offset| <= 1 around the site's centre, label 0. Conserved columns get
/// zeros.
trap_ellipsoid ellipsoid_of(const trap_site& site, const Eigen::MatrixXd& norm);

}  // namespace hopscotch
