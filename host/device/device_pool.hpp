// All devices of this machine, several workers on each. Requests, from any number of threads, are
// cut into pieces that go to whichever worker is free. A device that fails leaves its pieces to the
// others.
#pragma once

#include "host/device/device_worker.hpp"
#include "host/run/device_error.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hopscotch {

/// How a device is shared out. With the stacks of the kernels' threads, which the driver keeps
/// (less than 1.1 GB, bench/results/kernel_resources.jsonl), a process takes less than 2 GiB of a
/// device.
struct device_limits {
    int workers_per_device = 3;  // one computes, one copies, one has its host part
    // of tables and layers, whatever the map's size
    std::size_t most_bytes = std::size_t{1} << 28;
    // of threads beside their stacks
    std::size_t most_workspace_bytes = std::size_t{1} << 28;
    std::uint64_t least_cells = 1u << 18;  // of a piece: fewer do not fill a device
};

class device_pool {
public:
    /// Shares every device out, by its free memory.
    /// \error device_error where there is no device that can be used
    explicit device_pool(device_runtime& runtime, const device_limits& limits = {});

    /// Computes a request; thread safe. Pieces are small enough for every worker to have some. A
    /// piece whose device fails is computed again by another one, and the device is not used any
    /// more. \error device_error when the last device has failed, with what each has said, or where
    /// a
    ///        request does not fit; the request's layers are then undefined
    lane_statistics run(const device_kernel& kernel, const ensemble_request& request);

    /// "NVIDIA H200", or "2 x NVIDIA H200"; also of devices that have failed.
    std::string names() const;

    /// "device 1 (cudaStreamSynchronize (...))": the devices that have failed, each with the first
    /// call that told; "" where all work.
    std::string failures() const;

private:
    class lease;

    struct device {
        std::string name;
        std::string failure;  // "" while it works
        std::vector<std::unique_ptr<device_worker>> workers;
    };

    void open(device_runtime& runtime, int number);
    device_worker* take(bool waits);
    void give_back(device_worker* worker);
    void retire(const device_worker& worker, const device_error& error);
    std::size_t n_working() const;
    std::string failures_so_far() const;

    device_limits limits_;
    std::vector<device> devices_;
    std::vector<device_worker*> free_;
    mutable std::mutex mutex_;  // of `free_` and every `failure`
    std::condition_variable is_free_;
};

}  // namespace hopscotch
