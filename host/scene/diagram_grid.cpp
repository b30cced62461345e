// Axes and tiles of orbit diagrams.
#include "host/scene/diagram_grid.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hopscotch {
namespace {

// a sweep's tile is one orbit after another: so many returns take it 0.03 to 1 s
constexpr std::uint64_t returns_per_tile = 1 << 18;
constexpr std::uint64_t cells_per_tile = 1 << 18;
constexpr std::uint64_t least_points = 64;  // lanes of several registers
constexpr std::uint64_t most_tiles = 16384;
constexpr std::uint64_t one = 1;

struct diagram_extent {
    std::uint64_t points;
    std::uint64_t orbits;
    std::uint64_t samples;
};

std::uint64_t n_starts_of(const scene& scene) { return scene.n_cells() / scene.axes[0].cells; }

diagram_extent extent_of(const scene& scene) {
    return {scene.axes[0].cells, n_starts_of(scene) + (has_sweeps(scene) ? first_start : 0),
            scene.question.returns};
}

std::uint64_t ceiling(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

std::uint64_t points_per_tile(const scene& scene, const diagram_extent& whole) {
    if (scene.output.has_own_tile) return scene.output.tile[0];
    const auto transient = static_cast<std::uint64_t>(scene.question.number("transient"));
    const std::uint64_t wanted =
        std::max(returns_per_tile / (transient + whole.samples), least_points);
    std::uint64_t points = std::max(std::min(wanted, cells_per_tile / whole.samples), one);
    while (points < whole.points && whole.orbits * ceiling(whole.points, points) > most_tiles) {
        points *= 2;
    }
    return std::min(points, whole.points);
}

axis numbered_axis(std::string name, std::string meaning, std::uint64_t first, std::uint64_t n) {
    axis result{std::move(name), "1", std::move(meaning), "linear", {}};
    for (std::uint64_t i = 0; i < n; ++i) result.values.push_back(static_cast<double>(first + i));
    return result;
}

}  // namespace

bool is_orbit_diagram(const scene& scene) { return scene.question.kind == "orbit_diagram"; }

bool has_sweeps(const scene& scene) { return scene.question.number("sweeps") > 0.0; }

std::vector<axis> diagram_axes(const scene& scene, axis parameter) {
    const diagram_extent whole = extent_of(scene);
    return {
        std::move(parameter),
        numbered_axis("orbit",
                      "0: sweep of rising parameter, 1: of falling parameter, 2 and above: starts",
                      has_sweeps(scene) ? rising_orbit : first_start, whole.orbits),
        numbered_axis("sample", "returns after the transient", 1, whole.samples)};
}

std::vector<std::uint64_t> diagram_tile(const scene& scene) {
    const diagram_extent whole = extent_of(scene);
    const std::uint64_t points = points_per_tile(scene, whole);
    if (has_sweeps(scene)) return {points, 1, whole.samples};
    const std::uint64_t room =
        std::min(cells_per_tile / (points * whole.samples), orbits_at_once / points);
    return {points, std::clamp(room, one, whole.orbits), whole.samples};
}

void check_diagram(const scene& scene) {
    for (std::size_t i = 1; i < scene.axes.size(); ++i) {
        if (scene.axes[i].kind == axis_kind::column) continue;
        throw scene_error({scene.question.place, "question.kind", "\"orbit_diagram\"",
                           fmt::format("axis {} of the grid is a second parameter", i),
                           "only the first axis; the ones after it are state columns: starts"});
    }
    const scene_axis& first = scene.axes[0];
    const bool is_start_only = scene.start_section().returns_to != scene.section;
    if (first.kind == axis_kind::column && is_start_only) {
        throw scene_error(
            {scene.question.place, "question.kind", "\"orbit_diagram\"",
             fmt::format("{} is no column of the section that returns end on", first.name),
             "a parameter as the first axis"});
    }
}

}  // namespace hopscotch
