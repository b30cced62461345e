// Computes one tile.
#include "host/run/tiles.hpp"

#include "host/run/requests.hpp"
#include "host/run/state_rule.hpp"

#include <chrono>
#include <limits>

namespace hopscotch {
namespace {

template <class Number>
Number* numbers(std::vector<std::byte>& buffer) {
    return reinterpret_cast<Number*>(buffer.data());  // new gives memory aligned for every number
}

/// Points the kernel's result to the layer's buffer. The period is no result: it follows the label.
void bind(ensemble_request& request, const layer_plan& layer, std::vector<std::byte>& buffer) {
    switch (layer.role) {
        case layer_role::label:
            request.label = numbers<std::int16_t>(buffer);
            break;
        case layer_role::outcome:
            request.outcome = numbers<std::uint8_t>(buffer);
            break;
        case layer_role::returns:
            request.returns = numbers<std::uint32_t>(buffer);
            break;
        case layer_role::events:
            request.events = numbers<std::uint32_t>(buffer);
            break;
        case layer_role::time:
            request.time = numbers<double>(buffer);
            break;
        case layer_role::state:
            request.state[layer.index] = numbers<double>(buffer);
            break;
        case layer_role::extra:
            request.extras[layer.index] = numbers<double>(buffer);
            break;
        case layer_role::period:
            break;
    }
}

std::int16_t period_of(const label_plan& plan, std::int16_t label) {
    for (const attractor_row& row : plan.attractors) {
        if (row.label == label) return static_cast<std::int16_t>(row.period);
    }
    return 0;
}

void fill_periods(const label_plan& plan, const std::int16_t* label, std::uint64_t n_cells,
                  std::vector<std::byte>& buffer) {
    std::int16_t* period = numbers<std::int16_t>(buffer);
    for (std::uint64_t cell = 0; cell < n_cells; ++cell)
        period[cell] = period_of(plan, label[cell]);
}

/// State layers of cells without a state say so: NaN.
void blank_states(const scene& scene, const ensemble_request& request) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        const auto end = static_cast<outcome>(request.outcome[cell]);
        if (has_state(scene.info(), scene.section, end, request.returns[cell])) continue;
        for (double* const state : request.state) {
            if (state != nullptr) state[cell] = nan;
        }
    }
}

}  // namespace

tile_result compute_tile(const tile_job& job, const tile_box& box) {
    const auto begin = std::chrono::steady_clock::now();
    tile_result result;
    result.data.box = box;
    cell_request cells = request_of(job.what, job.plan, job.layout, box);
    const std::uint64_t n_cells = box.n_cells();
    for (const layer_plan& layer : job.layers) {
        auto& buffer = result.data.layers.emplace_back(n_cells * bytes_of(layer.description.type));
        bind(cells.request, layer, buffer);
    }
    std::vector<std::uint32_t> returns;  // asked of the kernel even where no layer shows them
    if (cells.request.returns == nullptr) {
        returns.resize(n_cells);
        cells.request.returns = returns.data();
    }
    result.lanes = job.kernel.run(cells.request);
    blank_states(job.what, cells.request);
    for (std::size_t i = 0; i < job.layers.size(); ++i) {
        if (job.layers[i].role != layer_role::period) continue;
        fill_periods(job.plan, cells.request.label, n_cells, result.data.layers[i]);
    }
    const auto end = std::chrono::steady_clock::now();
    result.seconds = std::chrono::duration<double>(end - begin).count();
    return result;
}

}  // namespace hopscotch
