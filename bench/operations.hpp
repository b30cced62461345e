// What single operations cost on each target: the parts that a kernel's floor is added up from.
#pragma once

#include <array>
#include <cstddef>

namespace hopscotch::bench {

/// Does an operation `repeats` times on each of n elements (a multiple of 192; x and y aligned to
/// 64 bytes), independent ones side by side in registers.
using operation_function = void (*)(const double* x, const double* y, double* out, std::size_t n);

enum class operation { fused, plain, comparison_and_selection, rounding, division, square_root };
inline constexpr int n_operations = 6;
inline constexpr std::array<const char*, n_operations> operation_names{
    "fma", "sum or product", "comparison and selection", "rounding", "division", "square root"};

/// How often an array function repeats its operation on an element.
inline constexpr int operation_repeats = 16;

struct operation_functions {
    operation_function table[n_operations];
};

}  // namespace hopscotch::bench
