// The GPUs that this process can use; only in programs built with CUDA.
#pragma once

#include "host/device/device_pool.hpp"

#include <string>
#include <string_view>

namespace hopscotch {

/// CUDA's runtime. It asks for nothing before the first call.
device_runtime& cuda_devices();

/// Why no kernel can run on a GPU here, or "".
std::string reason_against_devices();

inline constexpr std::string_view bits_of_the_others = "the bits of the other backends";

/// `bits_of_the_others`, or in a fast build what the numbers are instead.
std::string_view device_arithmetic();

/// "NVIDIA H200", or "2 x NVIDIA H200". \error device_error where there is none
std::string device_names();

/// What the devices that have failed in this process have said, while others go on; "" where all
/// work.
std::string device_failures();

}  // namespace hopscotch
