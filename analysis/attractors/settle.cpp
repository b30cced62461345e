// Builds one ensemble request for a list of starts.
#include "analysis/attractors/settle.hpp"

#include "host/run/backends.hpp"

#include <algorithm>

namespace hopscotch {

settled_orbits settle(const map_point& map, int section, std::span<const double> starts,
                      std::uint32_t returns, decision decided_by,
                      std::span<const trap_ellipsoid> traps, std::int16_t died_label) {
    const model_info& info = *map.model->info;
    const section_info& from = info.sections[static_cast<std::size_t>(section)];
    const section_info& to = info.sections[static_cast<std::size_t>(from.returns_to)];
    const std::size_t n_from = from.columns.size();
    const std::size_t n_to = to.columns.size();
    const std::size_t n = starts.size() / n_from;

    std::vector<std::vector<double>> columns(n_from, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n_from; ++c) columns[c][i] = starts[i * n_from + c];
    }
    std::vector<std::vector<double>> states(n_to, std::vector<double>(n));
    settled_orbits result;
    result.n_columns = static_cast<int>(n_to);
    result.end.resize(n);
    result.label.resize(n);
    result.returns.resize(n);

    ensemble_request request;
    request.n_cells = n;
    request.section = section;
    for (std::size_t c = 0; c < n_from; ++c) request.columns[c] = {columns[c].data(), 1, n};
    for (std::size_t p = 0; p < map.parameters.size(); ++p) {
        request.parameters[p].values = &map.parameters[p];
    }
    std::copy(map.options.begin(), map.options.end(), request.options);
    request.max_returns = returns;
    request.max_steps = map.max_steps;
    request.decided_by = decided_by;
    request.died_label = died_label;
    request.ellipsoids = traps.data();
    request.n_ellipsoids = static_cast<int>(traps.size());
    const double only_point = 0.0;
    request.trap_point.values = &only_point;
    request.outcome = result.end.data();
    request.label = result.label.data();
    request.returns = result.returns.data();
    for (std::size_t c = 0; c < n_to; ++c) request.state[c] = states[c].data();
    // a wide pack costs the same for one orbit as for many; the bits are the same either way
    constexpr std::size_t few = 4;
    const std::string_view backend = n <= few ? "scalar" : "auto";
    if (n > 0) choose_kernel(*map.model, map.variant, backend).run(request);

    result.state.resize(n * n_to);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < n_to; ++c) result.state[i * n_to + c] = states[c][i];
    }
    return result;
}

}  // namespace hopscotch
