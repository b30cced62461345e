// Compiles the ensemble loop of a model as device code, one trajectory per thread: proof that the kernel
// headers are ready for CUDA. Nothing here is run. The model's header comes with -include, its name in MODEL.
#include "kernels/ensemble/loop.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

template <class Model, int Variant>
__global__ void run_cells(ensemble_request request) {
    const std::uint64_t first = blockIdx.x * static_cast<std::uint64_t>(blockDim.x) + threadIdx.x;
    if (first >= request.n_cells) return;
    ensemble<Model, Variant, double> lanes(request);
    lanes.run(first, first + 1);
}

template __global__ void run_cells<MODEL, 0>(ensemble_request);
template __global__ void run_cells<MODEL, MODEL::n_variants - 1>(ensemble_request);

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
