// The ensemble loops over counting doubles.
#include "bench/counted_kernels.hpp"

#include "bench/counted_real.hpp"
#include "kernels/ensemble/instantiate.hpp"
#include "kernels/models/passive_hopper.hpp"
#include "kernels/models/relief_valve.hpp"
#include "kernels/models/slip.hpp"

#include <stdexcept>
#include <string>

namespace hopscotch::bench {

counted_work count_work(std::string_view model, int variant, const ensemble_request& request) {
    const ensemble_function* table = nullptr;
    if (model == "passive_hopper") table = kernel_table<passive_hopper, counted>;
    if (model == "relief_valve") table = kernel_table<relief_valve, counted>;
    if (model == "slip") table = kernel_table<slip, counted>;
    if (table == nullptr) throw std::runtime_error(std::string(model) + " is not counted");
    counts = {};
    table[variant](request);
    return {counts.fused, counts.plain, counts.divisions, counts.square_roots, counts.roundings};
}

}  // namespace hopscotch::bench
