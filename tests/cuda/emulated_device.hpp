// The device of the emulated kernels, and the models that have some.
#pragma once

#include "kernels/contract/entry.hpp"
#include "kernels/cuda/device_work.hpp"

#include <string>
#include <vector>

namespace hopscotch::emulation {

class fake_runtime;

/// The runtime of the two emulated devices, for tests that make it fail.
fake_runtime& emulated_runtime();

/// As run_on_devices, on two emulated devices.
lane_statistics run_on_emulated_device(const device_kernel& kernel,
                                       const ensemble_request& request);

/// As device_failures.
std::string emulated_failures();

/// Both devices work again, and no call fails; not while one of them computes.
void repair_emulated_devices();

/// Every model, with its emulated kernels in the place of the GPU's.
const std::vector<const model_entry*>& emulated_models();

}  // namespace hopscotch::emulation
