// What the host asks of a GPU runtime: a dozen calls. CUDA's are in cuda_runtime.cu; tests have a
// runtime that carries them out on the host, later than asked, as a device would.
#pragma once

#include "kernels/cuda/device_work.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace hopscotch {

/// What a device is, for the choice of sizes and for reports.
struct device_description {
    std::string name;
    std::size_t free_bytes = 0;
    std::size_t total_bytes = 0;
    int n_multiprocessors = 0;
    double clock_hertz = 0.0;             // largest of the multiprocessors
    int binary64_per_multiprocessor = 0;  // fused multiply-adds in double per cycle
};

/// Work that a device carries out in order, beside that of other streams.
using device_stream = void*;

/// Every member may be called from any thread, for any device.
/// \error device_error naming the runtime's call and its reason; nothing else is thrown
class device_runtime {
public:
    virtual ~device_runtime() = default;

    /// Devices that kernels are built for; the other calls number them from 0. 0 where there is
    /// none. \error device_error also where there is no driver, or all devices are too old
    virtual int n_devices() = 0;
    virtual device_description describe(int device) = 0;

    virtual std::byte* allocate(int device, std::size_t bytes) = 0;
    virtual void release(int device, std::byte* memory) noexcept = 0;
    /// Host memory that the device copies from and to by itself.
    virtual std::byte* allocate_pinned(int device, std::size_t bytes) = 0;
    virtual void release_pinned(std::byte* memory) noexcept = 0;

    /// Blocks of a kernel that a device computes at the same time.
    virtual std::uint64_t most_blocks(int device, const device_kernel& kernel) = 0;

    virtual device_stream open_stream(int device) = 0;
    virtual void close_stream(int device, device_stream stream) noexcept = 0;

    // Asked for now, done in the order of the stream. Host memory is pinned and stays untouched
    // until `wait` has returned.
    virtual void copy_to_device(int device, device_stream stream, std::byte* to,
                                const std::byte* from, std::size_t bytes) = 0;
    virtual void copy_to_host(int device, device_stream stream, std::byte* to,
                              const std::byte* from, std::size_t bytes) = 0;
    virtual void clear(int device, device_stream stream, std::byte* memory, std::size_t bytes) = 0;
    virtual void launch(int device, device_stream stream, const device_kernel& kernel,
                        std::uint64_t n_blocks, const device_work& work) = 0;

    /// Until everything asked of the stream is done; an error of any of it is thrown here.
    virtual void wait(int device, device_stream stream) = 0;
};

}  // namespace hopscotch
