// One pool for the whole process, made by the first request.
#include "host/device/devices.hpp"

#include "host/run/device_error.hpp"

#include <atomic>

namespace hopscotch {
namespace {

std::atomic<const device_pool*> opened = nullptr;

/// Never destroyed: at the end of the process the driver may be gone before it, and the system
/// takes the memory back.
device_pool& all_devices() {
    static device_pool& pool = *new device_pool(cuda_devices());
    opened = &pool;
    return pool;
}

}  // namespace

std::string reason_against_devices() {
    try {
        return cuda_devices().n_devices() > 0 ? "" : "there is no CUDA device";
    } catch (const device_error& error) {
        return error.what();
    }
}

std::string_view device_arithmetic() {
#ifdef HOPSCOTCH_CUDA_FAST
    return "products and sums contracted: not the bits of the other backends";
#else
    return bits_of_the_others;
#endif
}

std::string device_names() { return all_devices().names(); }

std::string device_failures() {
    const device_pool* const pool = opened;
    return pool != nullptr ? pool->failures() : "";
}

lane_statistics run_on_devices(const device_kernel& kernel, const ensemble_request& request) {
    return all_devices().run(kernel, request);
}

}  // namespace hopscotch
