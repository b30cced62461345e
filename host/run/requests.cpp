// Builds ensemble requests.
#include "host/run/requests.hpp"

#include "host/scene/grid.hpp"

#include <algorithm>

namespace hopscotch {
namespace {

/// Everything that is the same for all cells; axes still stand at their fixed values.
ensemble_request common_request(const scene& scene, const label_plan& plan) {
    ensemble_request request;
    request.section = scene.section;
    for (std::size_t i = 0; i < scene.start.size(); ++i) {
        request.columns[i].values = &scene.start[i];
    }
    for (std::size_t i = 0; i < scene.parameters.size(); ++i) {
        request.parameters[i].values = &scene.parameters[i];
    }
    std::copy(scene.options.begin(), scene.options.end(), request.options);
    request.max_returns = most_returns_of(scene);
    if (is_chaos_map(scene)) request.exponents = exponents_of(scene, plan);
    request.max_steps = static_cast<double>(scene.accuracy.max_events);
    request.tolerance = scene.accuracy.tolerance;
    request.decided_by = plan.decided_by;
    request.died_label = plan.died_label;
    request.traps = plan.traps.empty() ? nullptr : plan.traps.data();
    request.n_traps = plan.n_traps;
    request.ellipsoids = plan.ellipsoids.data();
    request.n_ellipsoids = plan.n_ellipsoids;
    return request;
}

column_source& source_of(ensemble_request& request, const scene_axis& axis) {
    return axis.kind == axis_kind::column ? request.columns[axis.index]
                                          : request.parameters[axis.index];
}

kernel_kind kind_of(const scene& scene) {
    return is_chaos_map(scene) ? kernel_kind::tangent : kernel_kind::plain;
}

/// Directions of free columns first, see exponent_request.
void order_directions(exponent_request& request, std::span<const int> conserved, int n_columns) {
    if (conserved.empty()) return;
    int next = 0;
    for (const bool wanted : {false, true}) {
        for (int c = 0; c < n_columns; ++c) {
            const bool is_conserved =
                std::find(conserved.begin(), conserved.end(), c) != conserved.end();
            if (is_conserved == wanted) request.direction[c] = next++;
        }
    }
    request.n_free = n_columns - static_cast<int>(conserved.size());
}

/// One entry per run of neighbouring cells with the same parameter point.
void add_points(cell_request& result, const scene& scene, const label_plan& plan,
                const tile_box& box) {
    std::uint64_t stride = 1;
    const std::size_t fixed = plan.point_axes.empty() ? 0 : plan.point_axes.back() + 1;
    for (std::size_t axis = fixed; axis < box.extent.size(); ++axis) stride *= box.extent[axis];
    const std::uint64_t n = box.n_cells() / stride;
    std::vector<double> points(n);
    for (std::uint64_t i = 0; i < n; ++i) {
        points[i] = static_cast<double>(point_index(scene, plan, coordinates_in(box, i * stride)));
    }
    result.request.trap_point = {points.data(), stride, points.size()};
    result.tables.push_back(std::move(points));
}

}  // namespace

std::uint64_t point_index(const scene& scene, const label_plan& plan,
                          std::span<const std::uint64_t> coordinates) {
    std::uint64_t point = 0;
    for (const std::size_t axis : plan.point_axes) {
        point = point * scene.axes[axis].cells + coordinates[axis];
    }
    return point;
}

int variant_of(const scene& scene) {
    const parameter_extremes extremes = extremes_of(scene);
    const auto& layers = scene.output.layers;
    const bool wants_time = std::any_of(layers.begin(), layers.end(), [](const auto& layer) {
        return layer == "time" || layer == "lyapunov_rate";
    });
    return scene.model->variant(
        {extremes.lowest.data(), extremes.highest.data(), scene.options.data(), wants_time});
}

kernel_choice kernel_of(const scene& scene, std::string_view wanted_backend) {
    return choose_kernel(*scene.model, variant_of(scene), wanted_backend, kind_of(scene));
}

kernel_in_use map_kernel_of(const scene& scene, std::string_view wanted_backend) {
    return choose_kernel_for_map(*scene.model, variant_of(scene), wanted_backend, kind_of(scene));
}

bool is_chaos_map(const scene& scene) { return scene.question.kind == "lyapunov"; }

bool has_plan(const scene& scene) { return scene.question.has_labels || is_chaos_map(scene); }

std::uint32_t most_returns_of(const scene& scene) {
    const auto transient = static_cast<std::uint32_t>(scene.question.number("transient"));
    return scene.question.returns + transient;
}

exponent_request exponents_of(const scene& scene, const label_plan& plan) {
    const scene_question& question = scene.question;
    const auto whole = [&](std::string_view name) {
        return static_cast<std::uint32_t>(question.number(name));
    };
    exponent_request request;
    request.transient = whole("transient");
    request.block = whole("block");
    request.least_blocks = whole("min_blocks");
    request.error = question.number("error");
    request.significance = question.number("significance");
    order_directions(request, plan.conserved, static_cast<int>(scene.end_section().columns.size()));
    return request;
}

cell_request request_of(const scene& scene, const label_plan& plan, const map_layout& layout,
                        const tile_box& box) {
    cell_request result{common_request(scene, plan), {}};
    result.request.n_cells = box.n_cells();
    std::uint64_t stride = 1;
    for (std::size_t axis = scene.axes.size(); axis-- > 0;) {
        source_of(result.request, scene.axes[axis]) = {
            layout.axes[axis].values.data() + box.origin[axis], stride, box.extent[axis]};
        stride *= box.extent[axis];
    }
    add_points(result, scene, plan, box);
    return result;
}

cell_request request_of(const scene& scene, const label_plan& plan,
                        std::span<const std::uint64_t> cells) {
    cell_request result{common_request(scene, plan), {}};
    result.request.n_cells = cells.size();
    std::vector<std::vector<double>> values(scene.axes.size() + 1);
    for (const std::uint64_t cell : cells) {
        const std::vector<std::uint64_t> coordinates = coordinates_of(scene, cell);
        for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
            values[axis].push_back(value_of(scene.axes[axis], coordinates[axis]));
        }
        values.back().push_back(static_cast<double>(point_index(scene, plan, coordinates)));
    }
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
        source_of(result.request, scene.axes[axis]) = {values[axis].data(), 1, cells.size()};
    }
    result.request.trap_point = {values.back().data(), 1, values.back().size()};
    result.tables = std::move(values);
    return result;
}

}  // namespace hopscotch
