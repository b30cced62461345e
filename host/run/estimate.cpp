// Samples cells and extrapolates.
#include "host/run/estimate.hpp"

#include "host/run/requests.hpp"
#include "host/run/backends.hpp"
#include "host/scene/diagram_grid.hpp"
#include "host/run/surveys.hpp"
#include "host/run/thread_limit.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <set>

namespace hopscotch {
namespace {

/// splitmix64: a stream of well mixed words from any seed.
std::uint64_t next_random(std::uint64_t& state) {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t word = state;
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    return word ^ (word >> 31);
}

struct sample_timing {
    std::uint64_t cells = 0;
    std::uint64_t undecided = 0;
    double seconds = 0.0;
};

std::vector<layer_plan> surveyed_layers(const scene& scene) {
    std::vector<layer_plan> layers = chosen_layers(scene);
    std::erase_if(layers, [](const layer_plan& layer) { return !is_surveyed(layer.role); });
    return layers;
}

sample_timing time_cells(const scene& scene, const label_plan& plan, const kernel_choice& kernel,
                         const std::vector<std::uint64_t>& cells) {
    cell_request request = request_of(scene, plan, cells);
    std::vector<std::uint8_t> outcomes(cells.size());
    std::vector<std::int16_t> labels(cells.size());
    request.request.outcome = outcomes.data();
    request.request.label = labels.data();
    const std::vector<layer_plan> layers = surveyed_layers(scene);
    std::vector<std::uint32_t> returns(layers.empty() ? 0 : cells.size());
    std::vector<std::vector<std::byte>> buffers(
        layers.size(), std::vector<std::byte>(cells.size() * sizeof(double)));
    if (!layers.empty()) request.request.returns = returns.data();
    const auto begin = std::chrono::steady_clock::now();
    kernel.run(request.request);
    fill_surveys(scene, request.request, layers, buffers);
    const auto end = std::chrono::steady_clock::now();
    sample_timing timing{cells.size(), 0, std::chrono::duration<double>(end - begin).count()};
    for (const int code : outcomes) timing.undecided += is_undecided(scene, code) ? 1 : 0;
    return timing;
}

/// Larger and larger samples until the time is worth extrapolating.
sample_timing time_samples(const scene& scene, const label_plan& plan,
                           const kernel_choice& kernel) {
    constexpr double enough_seconds = 0.3;
    constexpr std::uint64_t enough_cells = 16384;
    sample_timing timing;
    for (std::uint64_t n = 64; n <= enough_cells && timing.seconds < enough_seconds; n *= 4) {
        timing = time_cells(scene, plan, kernel, sample_cells(scene.n_cells(), n, n));
        if (timing.cells == scene.n_cells()) break;
    }
    return timing;
}

/// One orbit after the other along a diagram's parameter; some of them are timed.
double seconds_of_sweep(const scene& scene, std::string_view backend) {
    const kernel_choice kernel = kernel_of(scene, backend == "auto" ? "scalar" : backend);
    constexpr std::uint64_t n_timed = 8;
    double seconds = 0.0;
    const std::vector<std::uint64_t> cells = sample_cells(scene.n_cells(), n_timed, 1);
    for (const std::uint64_t cell : cells) seconds += time_cells(scene, {}, kernel, {cell}).seconds;
    return seconds / static_cast<double>(cells.size()) * static_cast<double>(scene.axes[0].cells);
}

}  // namespace

std::vector<std::uint64_t> sample_cells(std::uint64_t n_cells, std::uint64_t n,
                                        std::uint64_t seed) {
    std::vector<std::uint64_t> cells;
    if (n >= n_cells) {
        cells.resize(n_cells);
        std::iota(cells.begin(), cells.end(), std::uint64_t{0});
        return cells;
    }
    std::set<std::uint64_t> chosen;  // Floyd's sampling: exactly n draws
    for (std::uint64_t i = n_cells - n; i < n_cells; ++i) {
        const std::uint64_t cell = next_random(seed) % (i + 1);
        if (!chosen.insert(cell).second) chosen.insert(i);
    }
    cells.assign(chosen.begin(), chosen.end());
    return cells;
}

run_estimate estimate(const scene& scene, const run_choices& choices, const run_hooks& hooks) {
    check_is_map(scene);
    const kernel_choice kernel = kernel_of(scene, choices.backend);
    const map_layout layout = layout_of(scene);
    run_estimate result;
    result.backend = name_of(kernel.which);
    result.n_threads = threads_for(choices.n_threads);
    const thread_limit threads(result.n_threads);
    result.n_cells = layout.n_cells();
    result.n_tiles = layout.n_tiles();
    result.tile = layout.tile;
    std::uint64_t bytes_per_cell = 0;
    for (const layer& layer : layout.layers) bytes_per_cell += bytes_of(layer.type);
    std::uint64_t tile_cells = 1;
    for (const std::uint64_t extent : layout.tile) tile_cells *= extent;
    result.bytes = bytes_per_cell * result.n_cells;
    // a tile in flight: its numbers, their compressed copy, and a table of parameter points
    const std::uint64_t tokens =
        std::min(static_cast<std::uint64_t>(result.n_threads), result.n_tiles);
    result.memory = tokens * tile_cells * (2 * bytes_per_cell + sizeof(double));

    label_plan plan;
    if (hooks.plan && has_plan(scene)) plan = hooks.plan(scene, {});
    const sample_timing timing = time_samples(scene, plan, kernel);
    const auto sampled = static_cast<double>(timing.cells);
    const auto n_cells = static_cast<double>(scene.n_cells());
    result.n_sampled = timing.cells;
    result.undecided = static_cast<double>(timing.undecided) / sampled;
    const int at_once = kernel.which == backend::cuda ? 1 : result.n_threads;
    result.seconds = timing.seconds / sampled * n_cells / at_once;
    if (is_orbit_diagram(scene) && has_sweeps(scene)) {
        const double sweep = seconds_of_sweep(scene, choices.backend);
        result.seconds = std::max(sweep, result.seconds + 2.0 * sweep / at_once);
    }
    return result;
}

}  // namespace hopscotch
