// A model's GPU kernels compiled for the host: the ensemble loops of kernels/cuda over emulated
// warps, and tables of them that send requests through the host's part of the CUDA backend to a
// device that is not there.
#pragma once

#include "kernels/cuda/persistent_lane.hpp"
#include "kernels/ensemble/loop.hpp"
#include "kernels/ensemble/tangent.hpp"
#include "tests/cuda/emulated_device.hpp"
#include "tests/cuda/emulated_warp.hpp"

#include <utility>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// One warp's share of a launch; what fake_runtime runs. Its fibers take turns only where none of
/// them holds anything in its workspace, so that the last one to open its part serves all of them.
template <class Lanes>
void compute_cells(const device_work& work, unsigned block) {
    constexpr unsigned n = emulation::fiber_group::size;
    emulation::fiber_group fibers;
    fibers.run([&](int lane) {
        emulation::emulated_warp threads(fibers, *work.counters);
        open_workspace<Lanes>(work, block * n + static_cast<unsigned>(lane));
        Lanes lanes(work.request);
        lanes.run(work.first_cell, work.n_cells, threads);
    });
}

template <class Model, class Lanes>
lane_statistics run_emulated(const ensemble_request& request) {
    ensemble_request complete = request;
    complete.end_section =
        Model::info.sections[static_cast<std::size_t>(request.section)].returns_to;
    const void* const function = reinterpret_cast<const void*>(&compute_cells<Lanes>);
    return emulation::run_on_emulated_device(
        {function, emulation::fiber_group::size, Lanes::workspace_bytes}, complete);
}

template <class Model, class Variants>
struct emulated_functions;

template <class Model, int... Variant>
struct emulated_functions<Model, std::integer_sequence<int, Variant...>> {
    static constexpr ensemble_function plain[] = {
        &run_emulated<Model, ensemble<Model, Variant, double, persistent_lane>>...};
    static constexpr ensemble_function tangent[] = {
        &run_emulated<Model, tangent_ensemble<Model, Variant, double, persistent_lane>>...};
};

template <class Model>
using emulated_table =
    emulated_functions<Model, std::make_integer_sequence<int, Model::n_variants>>;

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
