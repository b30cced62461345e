// The ensemble loops over counting doubles.
#include "bench/counted_kernels.hpp"

#include "bench/counted_real.hpp"
#include "kernels/ensemble/instantiate.hpp"
#include "kernels/models/mirror_line.hpp"
#include "kernels/models/mirror_planar.hpp"
#include "kernels/models/mirror_spatial.hpp"
#include "kernels/models/openloop_hopper.hpp"
#include "kernels/models/paddle_juggler.hpp"
#include "kernels/models/passive_hopper.hpp"
#include "kernels/models/passive_juggler.hpp"
#include "kernels/models/raibert_linear.hpp"
#include "kernels/models/raibert_linear_simple.hpp"
#include "kernels/models/raibert_pneumatic.hpp"
#include "kernels/models/raibert_pneumatic_simple.hpp"
#include "kernels/models/relief_valve.hpp"
#include "kernels/models/slip.hpp"
#include "kernels/models/slip_pitching.hpp"

#include <stdexcept>
#include <string>

namespace hopscotch::bench {
namespace {

static_assert(n_counted_functions == n_elementary_kinds);

/// The kernels of the first model of that name; null where there is none.
template <class... Models>
const ensemble_function* counted_kernels(std::string_view model) {
    const ensemble_function* table = nullptr;
    ((model == Models::info.name ? table = kernel_table<Models, counted> : nullptr), ...);
    return table;
}

}  // namespace

counted_work counted_work::per(double units) const {
    counted_work one = *this;
    for (double* const count :
         {&one.fused, &one.plain, &one.divisions, &one.square_roots, &one.roundings,
          &one.outside_fused, &one.outside_sums, &one.outside_comparisons, &one.outside_selections,
          &one.outside_divisions, &one.outside_square_roots, &one.outside_roundings}) {
        *count /= units;
    }
    for (double& calls : one.functions) calls /= units;
    return one;
}

counted_work count_work(std::string_view model, int variant, const ensemble_request& request) {
    const ensemble_function* const table =
        counted_kernels<mirror_line, mirror_planar, mirror_spatial, openloop_hopper, paddle_juggler,
                        passive_hopper, passive_juggler, raibert_linear, raibert_linear_simple,
                        raibert_pneumatic, raibert_pneumatic_simple, relief_valve, slip,
                        slip_pitching>(model);
    if (table == nullptr) throw std::runtime_error(std::string(model) + " is not counted");
    counts = inside_counts = {};
    elementary_calls = {};
    table[variant](request);
    const operation_counts& inside = inside_counts;
    return {
        .fused = counts.fused,
        .plain = counts.plain,
        .divisions = counts.divisions,
        .square_roots = counts.square_roots,
        .roundings = counts.roundings,
        .functions = elementary_calls,
        .outside_fused = counts.fused - inside.fused,
        .outside_sums = (counts.plain - counts.comparisons) - (inside.plain - inside.comparisons),
        .outside_comparisons = counts.comparisons - inside.comparisons,
        .outside_selections = counts.selections - inside.selections,
        .outside_divisions = counts.divisions - inside.divisions,
        .outside_square_roots = counts.square_roots - inside.square_roots,
        .outside_roundings = counts.roundings - inside.roundings};
}

}  // namespace hopscotch::bench
