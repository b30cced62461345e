// Kernel first, chaotic sets after it.
#include "host/run/labelled_run.hpp"

#include <vector>

namespace hopscotch {
namespace {

/// Orbits that have spent their returns uncaught belong to the chaotic set that their last state
/// lies on, if there is one.
void label_chaotic(const label_plan& plan, const ensemble_request& request, std::size_t n_columns) {
    std::vector<double> state(n_columns);
    for (std::uint64_t cell = 0; cell < request.n_cells; ++cell) {
        const bool is_spent = request.outcome[cell] == static_cast<int>(outcome::budget) &&
                              request.returns[cell] == request.max_returns;
        if (!is_spent) continue;
        for (std::size_t c = 0; c < n_columns; ++c) state[c] = request.state[c][cell];
        const auto point = static_cast<std::size_t>(request.trap_point.at(cell));
        const std::int16_t label = plan.chaotic_label(point, state);
        if (label == 0) continue;
        request.label[cell] = label;
        request.outcome[cell] = static_cast<std::uint8_t>(outcome::attracted);
    }
}

}  // namespace

lane_statistics run_labelled(const scene& scene, const label_plan& plan, const kernel_run& run,
                             const ensemble_request& request) {
    if (plan.chaotic.empty()) return run(request);
    ensemble_request complete = request;
    std::vector<std::vector<double>> states;  // asked for even where no layer shows them
    const std::size_t n_columns = scene.end_section().columns.size();
    for (std::size_t c = 0; c < n_columns; ++c) {
        if (complete.state[c] == nullptr) {
            complete.state[c] = states.emplace_back(request.n_cells).data();
        }
    }
    const lane_statistics lanes = run(complete);
    label_chaotic(plan, complete, n_columns);
    return lanes;
}

}  // namespace hopscotch
