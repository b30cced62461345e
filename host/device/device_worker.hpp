// One stream of one device with memory of its own on both sides: computes pieces of a request, one
// at a time. Two or more workers of a device overlap computing, copying and the host's part.
#pragma once

#include "host/device/device_layout.hpp"
#include "host/device/device_runtime.hpp"

namespace hopscotch {

/// The part of a device that one worker may take.
struct device_share {
    std::size_t bytes = 0;            // of tables and layers
    std::size_t workspace_bytes = 0;  // of threads that need memory beside their stack
    std::uint64_t of_workers = 1;     // that such threads are shared out to
};

/// Used by one thread at a time.
class device_worker {
public:
    device_worker(device_runtime& runtime, int device, const device_share& share);
    ~device_worker();
    device_worker(const device_worker&) = delete;
    device_worker& operator=(const device_worker&) = delete;

    int device() const { return device_; }

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
    void grow_workspace(std::size_t bytes);
    void release() noexcept;
    std::uint64_t blocks_for(const device_kernel& kernel, std::uint64_t n_cells);

    device_runtime& runtime_;
    int device_;
    device_share share_;
    device_stream stream_;
    memory memory_;  // counters, tables, layers; the same offsets on both sides
    std::byte* workspace_ = nullptr;
    std::size_t workspace_bytes_ = 0;
    cell_piece piece_;
};

}  // namespace hopscotch
