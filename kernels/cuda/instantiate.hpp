// What a generated CUDA unit needs: the kernels of a model and the table of one ensemble function
// per compile-time variant, each of which sends its request to the GPUs. Compiled by nvcc only.
#pragma once

#include "kernels/cuda/gpu_warp.hpp"
#include "kernels/cuda/persistent_lane.hpp"
#include "kernels/ensemble/loop.hpp"
#include "kernels/ensemble/tangent.hpp"

#include <utility>

namespace hopscotch::inline HOPSCOTCH_TARGET {

/// The ensemble loops a thread can run.
template <class Model, int Variant>
using thread_ensemble = ensemble<Model, Variant, double, persistent_lane>;
template <class Model, int Variant>
using thread_tangent_ensemble = tangent_ensemble<Model, Variant, double, persistent_lane>;

template <class Lanes>
__global__ void __launch_bounds__(threads_per_block)
    compute_cells(const __grid_constant__ device_work work) {
    gpu_warp threads(work.counters);
    open_workspace<Lanes>(work, blockIdx.x * blockDim.x + threadIdx.x);
    Lanes lanes(work.request);
    lanes.run(work.first_cell, work.n_cells, threads);
}

template <class Model, class Lanes>
lane_statistics run_kernel(const ensemble_request& request) {
    ensemble_request complete = request;
    complete.end_section =
        Model::info.sections[static_cast<std::size_t>(request.section)].returns_to;
    const void* const function = reinterpret_cast<const void*>(&compute_cells<Lanes>);
    return run_on_devices({function, threads_per_block, Lanes::workspace_bytes}, complete);
}

template <class Model, class Variants>
struct device_functions;

template <class Model, int... Variant>
struct device_functions<Model, std::integer_sequence<int, Variant...>> {
    static constexpr ensemble_function plain[] = {
        &run_kernel<Model, thread_ensemble<Model, Variant>>...};
    static constexpr ensemble_function tangent[] = {
        &run_kernel<Model, thread_tangent_ensemble<Model, Variant>>...};
};

/// One ensemble function per variant of the model, computed on GPUs.
template <class Model>
inline constexpr const ensemble_function* device_kernel_table =
    device_functions<Model, std::make_integer_sequence<int, Model::n_variants>>::plain;

/// The same with the tangent map and exponents.
template <class Model>
inline constexpr const ensemble_function* device_tangent_table =
    device_functions<Model, std::make_integer_sequence<int, Model::n_variants>>::tangent;

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
