// Cells of a point are sampled along a low-discrepancy sequence (Roberts' R sequence).
#include "analysis/labels/plan_points.hpp"

#include "host/scene/grid.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

/// The n-th point of the R sequence in `dimension` dimensions, along one of them.
double spread(std::size_t n, std::size_t along, std::size_t dimension) {
    double root = 2.0;  // of x^(d + 1) = x + 1
    for (int i = 0; i < 60; ++i) {
        root = std::pow(1.0 + root, 1.0 / (static_cast<double>(dimension) + 1.0));
    }
    const double step = std::pow(root, -static_cast<double>(along + 1));
    const double at = 0.5 + static_cast<double>(n) * step;
    return at - std::floor(at);
}

}  // namespace

plan_points::plan_points(const scene& scene, std::vector<std::size_t> axes)
    : scene_(scene), axes_(std::move(axes)) {
    for (const std::size_t axis : axes_) n_points_ *= scene.axes[axis].cells;
}

std::vector<std::uint64_t> plan_points::coordinates_of_point(std::size_t point) const {
    std::vector<std::uint64_t> coordinates(scene_.axes.size(), 0);
    for (std::size_t i = axes_.size(); i-- > 0;) {
        const std::uint64_t cells = scene_.axes[axes_[i]].cells;
        coordinates[axes_[i]] = point % cells;
        point /= cells;
    }
    return coordinates;
}

map_point plan_points::map_at(std::size_t point) const {
    const cell_start start = start_of(scene_, coordinates_of_point(point));
    map_point map;
    map.model = scene_.model;
    map.section = scene_.start_section().returns_to;
    map.options = scene_.options;
    map.parameters = start.parameters;
    map.max_steps = static_cast<double>(scene_.accuracy.max_events);
    map.variant = scene_.model->variant(
        {map.parameters.data(), map.parameters.data(), map.options.data(), true});
    return map;
}

std::vector<double> plan_points::starts_at(std::size_t point, std::size_t most) const {
    std::vector<std::size_t> others;
    std::uint64_t n_cells = 1;
    for (std::size_t axis = 0; axis < scene_.axes.size(); ++axis) {
        if (std::find(axes_.begin(), axes_.end(), axis) != axes_.end()) continue;
        others.push_back(axis);
        n_cells *= scene_.axes[axis].cells;
    }
    const bool has_all = n_cells <= most;
    const std::size_t n = has_all ? n_cells : most;
    std::vector<std::uint64_t> coordinates = coordinates_of_point(point);
    std::vector<double> starts;
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t rest = i;
        for (std::size_t k = 0; k < others.size(); ++k) {
            const std::uint64_t cells = scene_.axes[others[k]].cells;
            const auto at = static_cast<std::uint64_t>(spread(i, k, others.size()) *
                                                       static_cast<double>(cells));
            coordinates[others[k]] = has_all ? rest % cells : std::min(at, cells - 1);
            rest /= cells;
        }
        const cell_start start = start_of(scene_, coordinates);
        starts.insert(starts.end(), start.columns.begin(), start.columns.end());
    }
    return starts;
}

std::vector<double> plan_points::values_at(std::size_t point) const {
    const std::vector<std::uint64_t> coordinates = coordinates_of_point(point);
    std::vector<double> values;
    for (const std::size_t axis : axes_) {
        values.push_back(value_of(scene_.axes[axis], coordinates[axis]));
    }
    return values;
}

std::size_t plan_points::point_of(std::span<const std::uint64_t> coordinates) const {
    std::size_t point = 0;
    for (const std::size_t axis : axes_) {
        point = point * scene_.axes[axis].cells + coordinates[axis];
    }
    return point;
}

}  // namespace hopscotch
