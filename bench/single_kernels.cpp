// Models over `single`.
#include "bench/single_kernels.hpp"

#include "bench/single_real.hpp"
#include "kernels/ensemble/instantiate.hpp"
#include "kernels/models/mirror_line.hpp"
#include "kernels/models/mirror_planar.hpp"
#include "kernels/models/openloop_hopper.hpp"
#include "kernels/models/paddle_juggler.hpp"
#include "kernels/models/passive_hopper.hpp"
#include "kernels/models/raibert_pneumatic.hpp"
#include "kernels/models/relief_valve.hpp"
#include "kernels/models/slip.hpp"

namespace hopscotch::bench {

const ensemble_function* single_kernels(std::string_view model) {
    if (model == "mirror_line") return kernel_table<mirror_line, single>;
    if (model == "mirror_planar") return kernel_table<mirror_planar, single>;
    if (model == "openloop_hopper") return kernel_table<openloop_hopper, single>;
    if (model == "paddle_juggler") return kernel_table<paddle_juggler, single>;
    if (model == "passive_hopper") return kernel_table<passive_hopper, single>;
    if (model == "raibert_pneumatic") return kernel_table<raibert_pneumatic, single>;
    if (model == "relief_valve") return kernel_table<relief_valve, single>;
    if (model == "slip") return kernel_table<slip, single>;
    return nullptr;
}

}  // namespace hopscotch::bench
