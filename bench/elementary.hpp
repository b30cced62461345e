// The elementary functions of one target as array functions, so that a program compiled for the
// least processor can time them.
#pragma once

#include <cstddef>

namespace hopscotch::bench {

/// Applies one function to n elements (a multiple of 16; aligned to 64 bytes); `y` is the second
/// argument of atan2 and ignored by the others.
using array_function = void (*)(const double* x, const double* y, double* out, std::size_t n);

/// Functions in the order of `elementary_names`.
struct elementary_functions {
    array_function table[5];
};

inline constexpr const char* elementary_names[] = {"sin_cos", "exp", "log", "atan2", "cbrt"};

}  // namespace hopscotch::bench
