#include "analysis/metrics/slice_shocks.hpp"

#include "analysis/metrics/class_slices.hpp"

#include <algorithm>

namespace hopscotch::metrics {

shocks_over_parameters critical_shocks_of_slices(const class_grid& grid,
                                                 const slice_choice& choice) {
    shocks_over_parameters result;
    const class_slices slices(grid, choice.axes);
    if (!slices.is_cut()) return result;
    for (const std::size_t i : slices.fixed()) result.axes.push_back(grid.axes[i]);
    result.slices.resize(slices.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t i = 0; i < result.slices.size(); ++i) {
        slice_shocks& slice = result.slices[i];
        const std::vector<std::uint64_t> at = slices.indices(i);
        for (std::size_t k = 0; k < at.size(); ++k) {
            slice.at.push_back(result.axes[k].values[at[k]]);
        }
        slice.shocks = critical_shocks(slices.cut(i), choice.attractors(slices.named_indices(i)));
        std::erase_if(slice.shocks, [](const critical_shock& shock) { return !shock.is_defined; });
    }
    return result;
}

}  // namespace hopscotch::metrics
