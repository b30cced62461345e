// Moves the starts of a request.
#include "host/run/moved_starts.hpp"

#include "host/run/requests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

double moved(double x, double by, const range& valid) {
    const double y = x + by;
    return std::isfinite(x) && valid.holds(y) ? y : x;
}

double scale_of(const scene_axis& axis) {
    return axis.scale == axis_scale::log ? 0.0
                                         : std::max(std::abs(axis.lowest), std::abs(axis.highest));
}

bool is_axis(const scene& scene, axis_kind kind, std::size_t index) {
    return std::any_of(scene.axes.begin(), scene.axes.end(), [&](const scene_axis& axis) {
        return axis.kind == kind && static_cast<std::size_t>(axis.index) == index;
    });
}

bool can_move(const column_source& source) {
    return source.values[0] != 0.0 && std::isfinite(source.values[0]);
}

}  // namespace

double displacement_of(axis_kind kind, double x, double scale, double tolerance) {
    const double size = std::max(std::abs(x), scale);
    const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
    const double floor = kind == axis_kind::column ? 0.25 : 0.0;
    return std::max(16.0 * ulp, 100.0 * tolerance * (floor + size));
}

double displacement_on(const scene_axis& axis, double x, double tolerance) {
    return displacement_of(axis.kind, x, scale_of(axis), tolerance);
}

double tolerance_of(const scene& scene) {
    const bool integrates =
        scene.model->integrates != nullptr && scene.model->integrates(variant_of(scene));
    return integrates ? scene.accuracy.tolerance : 0.0;
}

double spacing_at(const scene_axis& axis, double x) {
    const auto gaps = static_cast<double>(axis.edges ? axis.cells - 1 : axis.cells);
    if (gaps < 1.0) return 0.0;
    if (axis.scale == axis_scale::log) {
        return std::abs(x) * std::abs(std::log(axis.highest / axis.lowest)) / gaps;
    }
    return std::abs(axis.highest - axis.lowest) / gaps;
}

std::vector<fixed_number> movable_numbers(const scene& scene, const ensemble_request& request) {
    std::vector<fixed_number> numbers;
    for (std::size_t c = 0; c < scene.start.size(); ++c) {
        if (!is_axis(scene, axis_kind::column, c) && can_move(request.columns[c]))
            numbers.push_back({axis_kind::column, c});
    }
    for (std::size_t p = 0; p < scene.parameters.size(); ++p) {
        if (!is_axis(scene, axis_kind::parameter, p) && can_move(request.parameters[p]))
            numbers.push_back({axis_kind::parameter, p});
    }
    return numbers;
}

template <class Distance>
void moved_request::move(column_source& source, const range& valid, Distance by) {
    std::vector<double>& table = tables_.emplace_back(source.size);
    for (std::uint64_t i = 0; i < source.size; ++i) {
        const double x = source.values[i];
        table[i] = moved(x, by(x), valid);
    }
    source.values = table.data();
}

column_source& moved_request::source_of(axis_kind kind, std::size_t index) {
    return kind == axis_kind::column ? request_.columns[index] : request_.parameters[index];
}

const range& moved_request::valid_for(axis_kind kind, std::size_t index) const {
    return kind == axis_kind::column ? scene_.start_section().columns[index].valid
                                     : scene_.info().parameters[index].valid;
}

void moved_request::move_axis(const scene_axis& axis, double sign) {
    const auto index = static_cast<std::size_t>(axis.index);
    move(source_of(axis.kind, index), valid_for(axis.kind, index),
         [&](double x) { return sign * displacement_on(axis, x, tolerance_); });
}

void moved_request::move_between_cells(const scene_axis& axis, double share) {
    const auto index = static_cast<std::size_t>(axis.index);
    move(source_of(axis.kind, index), valid_for(axis.kind, index),
         [&](double x) { return share * spacing_at(axis, x); });
}

void moved_request::move_fixed(const fixed_number& number, double sign) {
    move(source_of(number.kind, number.index), valid_for(number.kind, number.index),
         [&](double x) { return sign * displacement_of(number.kind, x, 0.0, tolerance_); });
}

}  // namespace hopscotch
