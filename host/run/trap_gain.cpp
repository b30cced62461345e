// Adds up the returns of labelled cells.
#include "host/run/trap_gain.hpp"

#include "host/map/numbers.hpp"
#include "host/run/backends.hpp"
#include "host/run/estimate.hpp"
#include "host/run/labelled_run.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <fmt/format.h>

namespace hopscotch {

trap_gain gain_of(const scene& scene, const map_run& run) {
    trap_gain gain;
    gain.budget = static_cast<double>(most_returns_of(scene));
    const map_layout layout = layout_of(scene);
    const std::size_t labels = layer_index(layout, "label");
    const std::size_t returns = layer_index(layout, "returns");
    if (labels == layout.layers.size() || returns == layout.layers.size()) return gain;
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        const tile_data data = run.read(tile);
        for (std::uint64_t i = 0; i < data.box.n_cells(); ++i) {
            if (!(number_at(number_type::int16, data.layers[labels].data(), i) > 0.0)) continue;
            const double completed = number_at(number_type::int32, data.layers[returns].data(), i);
            if (completed == layout.layers[returns].fill) continue;  // its label is inherited
            ++gain.n_labelled;
            gain.returns += completed;
        }
    }
    return gain;
}

basin_sample sample_basins(const scene& scene, const label_plan& plan, std::uint64_t n) {
    const std::vector<std::uint64_t> cells = sample_cells(scene.n_cells(), n, 1);
    cell_request request = request_of(scene, plan, cells);
    std::vector<std::int16_t> labels(cells.size());
    std::vector<std::uint8_t> ends(cells.size());
    std::vector<std::uint32_t> returns(cells.size());
    request.request.label = labels.data();
    request.request.outcome = ends.data();
    request.request.returns = returns.data();
    const kernel_choice kernel = kernel_of(scene, "auto");
    run_labelled(
        scene, plan, [&](const ensemble_request& wanted) { return kernel.run(wanted); },
        request.request);
    basin_sample sample{cells.size(), {}, {}};
    sample.gain.budget = static_cast<double>(most_returns_of(scene));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        ++sample.labels[labels[i]];
        if (labels[i] == 0) continue;
        ++sample.gain.n_labelled;
        sample.gain.returns += returns[i];
    }
    return sample;
}

std::string text_of(const trap_gain& gain) {
    return fmt::format(
        "{:.3g} returns per labelled orbit of a budget of {:.0f}: {:.3g} times fewer", gain.mean(),
        gain.budget, gain.factor());
}

}  // namespace hopscotch
