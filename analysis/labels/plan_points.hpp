// The parameter points of a scene: over which of its axes attractors change, and where one of them
// lies. Parameters always count; so do state columns that the return map conserves.
#pragma once

#include "analysis/periodic/map_point.hpp"
#include "host/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hopscotch {

class plan_points {
public:
    /// \param axes  positions of the axes that make the points, rising
    plan_points(const scene& scene, std::vector<std::size_t> axes);

    const std::vector<std::size_t>& axes() const { return axes_; }
    std::size_t size() const { return n_points_; }

    /// The return map at a point, on the section that the scene's returns end on.
    map_point map_at(std::size_t point) const;

    /// Starts of up to `most` cells of a point, spread evenly over the other axes: [start][column].
    /// All of them where there are no more.
    std::vector<double> starts_at(std::size_t point, std::size_t most) const;

    /// Where a point lies along each of the axes.
    std::vector<double> values_at(std::size_t point) const;

    /// The point that a cell belongs to.
    std::size_t point_of(std::span<const std::uint64_t> coordinates) const;

    /// Where a point lies along all axes of the scene; 0 along those that make no points.
    std::vector<std::uint64_t> coordinates_of_point(std::size_t point) const;

private:
    const scene& scene_;
    std::vector<std::size_t> axes_;
    std::size_t n_points_ = 1;
};

}  // namespace hopscotch
