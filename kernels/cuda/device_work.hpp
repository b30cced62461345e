// The plain data that passes between the host and a GPU kernel, and the host's entry that the
// generated units call: a backend `cuda` is a table of ensemble functions like any other.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <cstddef>
#include <cstdint>

namespace hopscotch {

/// What the threads of one launch share; zero at its start.
struct device_counters {
    std::uint64_t drawn;   // cells handed out so far
    std::uint64_t issued;  // steps of a warp times its threads
    std::uint64_t useful;  // of these, steps that advanced a trajectory
};

/// The argument of a launch. All pointers are the device's. A layer is addressed by the cell's
/// number in the whole request: its pointer is where cell 0 would be.
struct device_work {
    ensemble_request request;
    std::uint64_t first_cell = 0;
    std::uint64_t n_cells = 0;  // from first_cell on
    device_counters* counters = nullptr;
    std::byte* workspace = nullptr;  // of all threads, see thread_workspace.hpp
};

/// A kernel as the runtime knows it, with the threads per block it is compiled for.
struct device_kernel {
    const void* function;
    int threads_per_block;
    std::size_t workspace_bytes = 0;  // that each thread needs beside its stack
};

/// Computes a request on the GPUs of this machine and returns when its results lie in the host's
/// layers. Any thread may call it; host/device/device_pool.hpp does the work.
/// \error device_error with the runtime's call and reason
lane_statistics run_on_devices(const device_kernel& kernel, const ensemble_request& request);

}  // namespace hopscotch
