// Which kernel computes a map: the backend by name or the best one this processor runs, the
// compile-time variant by the model's own choice. The only place that asks the processor what it
// can do.
#pragma once

#include "host/map/layout.hpp"
#include "host/run/device_error.hpp"
#include "kernels/contract/entry.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hopscotch {

inline constexpr std::array<std::string_view, n_backends> backend_names{"scalar", "avx2", "avx512",
                                                                        "cuda"};

constexpr std::string_view name_of(backend which) {
    return backend_names[static_cast<std::size_t>(which)];
}

enum class kernel_kind : std::uint8_t {
    plain,
    tangent,  // with the tangent map and Lyapunov exponents
};

struct kernel_choice {
    backend which = backend::scalar;
    int variant = 0;
    ensemble_function run = nullptr;
    /// Of several devices: what those that have failed have said, while the others go on.
    std::string (*failures)() = nullptr;
};

/// Why this machine cannot run the backend, or "".
std::string reason_against(backend which);

/// Why this machine cannot run the model on the backend, or "".
std::string reason_against(const model_entry& model, backend which, kernel_kind kind);

/// What a map says of the backend that computes it: its name and, of a GPU, the device and whether
/// its numbers have the bits of the processors'. \error device_error
attribute_list attributes_of(backend which);

/// The backend of that name; `auto` is the widest one that this processor runs and the model is
/// built for (never the GPU; whole maps are given to it by kernel_in_use.hpp). \error device_error
/// naming what is missing and what can be had instead
kernel_choice choose_kernel(const model_entry& model, int variant, std::string_view wanted,
                            kernel_kind kind = kernel_kind::plain);

}  // namespace hopscotch
