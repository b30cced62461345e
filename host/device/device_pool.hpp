// All devices of this machine, several workers on each. Requests, from any number of threads, are
// cut into pieces that go to whichever worker is free.
#pragma once

#include "host/device/device_worker.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

namespace hopscotch {

/// How a device is shared out. With the stacks of the kernels' threads, which the driver keeps
/// (less than 1.1 GB, bench/results/kernel_resources.jsonl), a process takes less than 2 GiB of a
/// device.
struct device_limits {
    int workers_per_device = 3;  // one computes, one copies, one has its host part
    std::size_t most_bytes = std::size_t{1} << 28;            // of tables and layers, whatever the
                                                              // map's size
    std::size_t most_workspace_bytes = std::size_t{1} << 28;  // of threads beside their stacks
    std::uint64_t least_cells = 1u << 18;  // of a piece: fewer do not fill a device
};

class device_pool {
public:
    /// Shares every device out, by its free memory.
    /// \error device_error, also where there is no device
    explicit device_pool(device_runtime& runtime, const device_limits& limits = {});

    /// Computes a request; thread safe. Pieces are small enough for every worker to have some.
    /// \error device_error of any call; the request's layers are then undefined
    lane_statistics run(const device_kernel& kernel, const ensemble_request& request);

    /// "NVIDIA H200", or "2 x NVIDIA H200".
    std::string names() const;

    std::size_t n_workers() const { return workers_.size(); }

private:
    class lease;

    device_worker* take(bool waits);
    void give_back(device_worker* worker);

    device_limits limits_;
    std::vector<std::string> names_;
    std::vector<std::unique_ptr<device_worker>> workers_;
    std::vector<device_worker*> free_;
    std::mutex mutex_;
    std::condition_variable is_free_;
};

}  // namespace hopscotch
