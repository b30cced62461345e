// Prepares and runs the search at one parameter point.
#include "analysis/labels/point_search.hpp"

#include "analysis/attractors/settle.hpp"
#include "analysis/labels/plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace hopscotch {

std::vector<double> scale_of(const map_point& map, int section, std::span<const double> starts) {
    const settled_orbits images = settle(map, section, starts, 1);
    const auto n = static_cast<std::size_t>(images.n_columns);
    std::vector<double> scale(n, 0.0);
    for (std::size_t c = 0; c < n; ++c) {
        double lowest = unbounded;
        double highest = -unbounded;
        double size = 0.0;
        for (std::size_t i = 0; i < images.size(); ++i) {
            const double x = images.state_of(i)[c];
            if (images.end_of(i) != outcome::ok || !std::isfinite(x)) continue;
            lowest = std::min(lowest, x);
            highest = std::max(highest, x);
            size = std::max(size, std::abs(x));
        }
        scale[c] = std::max(highest > lowest ? highest - lowest : 0.0, 1e-3 * size);
        if (!(scale[c] > 0.0)) scale[c] = 1.0;
    }
    return scale;
}

std::vector<int> conserved_in(const scene& scene) {
    const bool is_direct = &scene.start_section() == &scene.end_section();
    if (!is_direct) return {};
    const plan_points points(scene, parameter_axes(scene));
    constexpr std::size_t n_samples = 64;
    std::optional<std::vector<int>> conserved;
    for (const std::size_t point : std::set{std::size_t{0}, points.size() / 2, points.size() - 1}) {
        const auto here =
            conserved_everywhere(points.map_at(point), points.starts_at(point, n_samples));
        if (!here) continue;
        if (!conserved) conserved = here;
        std::erase_if(*conserved, [&](int column) {
            return std::find(here->begin(), here->end(), column) == here->end();
        });
    }
    return conserved.value_or(std::vector<int>{});
}

std::vector<std::size_t> axes_of_points(const scene& scene) {
    std::vector<std::size_t> axes = parameter_axes(scene);
    const std::vector<int> conserved = conserved_in(scene);
    for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
        const bool is_conserved = scene.axes[axis].kind == axis_kind::column &&
                                  std::find(conserved.begin(), conserved.end(),
                                            scene.axes[axis].index) != conserved.end();
        if (is_conserved) axes.push_back(axis);
    }
    std::sort(axes.begin(), axes.end());
    return axes;
}

search_limits limits_of(const scene& scene, std::size_t n_points) {
    search_limits limits;
    limits.returns = std::max(limits.returns, scene.question.returns);
    limits.longest_period = static_cast<int>(scene.question.number("longest_period", 64.0));
    limits.wants_unstable = n_points == 1;
    limits.is_quick = n_points > 64;
    limits.wants_proofs = !limits.is_quick;
    return limits;
}

std::size_t samples_of(const scene& scene, std::size_t n_points) {
    const double wanted = scene.question.number("samples", 0.0);
    if (wanted > 0.0) return static_cast<std::size_t>(wanted);
    return n_points == 1 ? 512 : 32;
}

attractor_search search_point(const scene& scene, const plan_points& points, std::size_t point,
                              std::span<const double> starts, const search_limits& limits,
                              std::vector<found_attractor> known) {
    const map_point map = points.map_at(point);
    const std::vector<double> scale = scale_of(map, scene.section, starts);
    return search_attractors(map, scene.section, starts, scale, limits, std::move(known));
}

}  // namespace hopscotch
