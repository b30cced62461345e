// Returns per second in float32 next to double, by one plain loop over packs: no refill, the same
// for both.
#pragma once

#include <cstddef>
#include <string_view>

namespace hopscotch::bench {

/// Returns of all starts by packs of one arithmetic, added up so that nothing is left out.
struct plain_loop {
    /// \param columns  [column][start]; n a multiple of 96
    using function = double (*)(const double* const* columns, const double* parameters,
                                std::size_t n);
    function in_double = nullptr;
    function in_single = nullptr;
};

/// AVX-512. \return  null functions for models that are not built
plain_loop plain_loop_of(std::string_view model);

}  // namespace hopscotch::bench
