// One stream of one device with memory of its own on both sides: computes pieces of a request, one
// at a time. Two or more workers of a device overlap computing, copying and the host's part.
#pragma once

#include "host/device/device_layout.hpp"
#include "host/device/device_runtime.hpp"

namespace hopscotch {

/// Used by one thread at a time.
class device_worker {
public:
    /// \param most_bytes  of the device's memory that this worker may take
    device_worker(device_runtime& runtime, int device, std::size_t most_bytes);
    ~device_worker();
    device_worker(const device_worker&) = delete;
    device_worker& operator=(const device_worker&) = delete;

    /// The most cells of a request that fit. \error device_error where its tables do not fit
    std::uint64_t most_cells(const device_layout& layout) const;

    /// Sends a piece off. \error device_error
    void begin(const device_kernel& kernel, const device_layout& layout, cell_piece piece);
    /// Waits for the piece sent off last and copies its results to the request's layers.
    /// \error device_error
    lane_statistics finish(const device_layout& layout);
    /// After a failure: lets go of what was sent off, so that nothing writes any more.
    void abandon() noexcept;

private:
    struct memory {
        std::byte* device = nullptr;
        std::byte* pinned = nullptr;
        std::size_t bytes = 0;
    };

    void grow(std::size_t bytes);
    void release() noexcept;

    device_runtime& runtime_;
    int device_;
    std::size_t most_bytes_;
    device_stream stream_;
    memory memory_;  // counters, tables, layers; the same offsets on both sides
    cell_piece piece_;
};

}  // namespace hopscotch
