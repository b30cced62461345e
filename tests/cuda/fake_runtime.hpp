// A GPU runtime without a GPU. What is asked of a stream is done when it is waited for and not
// before, device memory is poisoned and checked for leaks and bounds, kernels are emulated warps on
// threads of the host, and any call can be made to fail.
#pragma once

#include "host/device/device_runtime.hpp"
#include "host/run/device_error.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace hopscotch::emulation {

/// What a device_kernel's function points to here: the work of one block, which is one warp.
using warp_function = void (*)(const device_work&, unsigned block);

class fake_runtime final : public device_runtime {
public:
    int devices = 1;
    std::size_t free_bytes = std::size_t{1} << 30;
    std::uint64_t resident_blocks = 2;  // of a device; each on a thread of its own

    std::string failing_call;     // the name of a call, as an error gives it
    int calls_until_failure = 0;  // of that name; the device stays lost afterwards
    int lost_device = -1;         // only that one fails; -1: any

    /// All devices are there again, and no call fails.
    void repair() {
        const std::lock_guard lock(mutex_);
        is_lost_ = false;
        lost_device = -1;
        failing_call.clear();
    }

    /// What has been done, for the tests to look at.
    struct record {
        int n_launches = 0;
        int n_streams = 0;
        int most_in_flight = 0;  // streams with work not yet waited for
        std::size_t most_bytes = 0;
        std::uint64_t most_blocks = 0;  // of a launch
        std::vector<int> launches_of_device = std::vector<int>(16);
    };
    record seen() const {
        const std::lock_guard lock(mutex_);
        return record_;
    }
    /// Nothing is held any more.
    bool is_clean() const { return memory_.empty() && pinned_.empty() && n_open_ == 0; }

    int n_devices() override { return devices; }

    device_description describe(int device) override {
        check("cudaGetDeviceProperties", device);
        return {.name = "emulated device",
                .free_bytes = free_bytes,
                .total_bytes = free_bytes,
                .n_multiprocessors = 1};
    }

    std::byte* allocate(int device, std::size_t bytes) override {
        check("cudaMalloc", device);
        const std::lock_guard lock(mutex_);
        if (bytes_ + bytes > free_bytes) throw device_error("cudaMalloc (out of memory)");
        bytes_ += bytes;
        record_.most_bytes = std::max(record_.most_bytes, bytes_);
        return add(memory_, bytes);
    }
    void release(int, std::byte* memory) noexcept override {
        const std::lock_guard lock(mutex_);
        bytes_ -= memory_.at(memory).size();
        memory_.erase(memory);
    }
    std::byte* allocate_pinned(int device, std::size_t bytes) override {
        check("cudaHostAlloc", device);
        const std::lock_guard lock(mutex_);
        return add(pinned_, bytes);
    }
    void release_pinned(std::byte* memory) noexcept override {
        const std::lock_guard lock(mutex_);
        pinned_.erase(memory);
    }

    device_stream open_stream(int device) override {
        check("cudaStreamCreateWithFlags", device);
        const std::lock_guard lock(mutex_);
        ++n_open_;
        ++record_.n_streams;
        return new stream;
    }
    void close_stream(int, device_stream which) noexcept override {
        const std::lock_guard lock(mutex_);
        --n_open_;
        delete static_cast<stream*>(which);
    }

    void copy_to_device(int device, device_stream to_stream, std::byte* to, const std::byte* from,
                        std::size_t bytes) override {
        check("cudaMemcpyAsync to the device", device);
        require_inside(memory_, to, bytes);
        require_inside(pinned_, from, bytes);
        later(to_stream, [=] { std::memcpy(to, from, bytes); });
    }
    void copy_to_host(int device, device_stream to_stream, std::byte* to, const std::byte* from,
                      std::size_t bytes) override {
        check("cudaMemcpyAsync to the host", device);
        require_inside(pinned_, to, bytes);
        require_inside(memory_, from, bytes);
        later(to_stream, [=] { std::memcpy(to, from, bytes); });
    }
    void clear(int device, device_stream to_stream, std::byte* memory, std::size_t bytes) override {
        check("cudaMemsetAsync", device);
        require_inside(memory_, memory, bytes);
        later(to_stream, [=] { std::memset(memory, 0, bytes); });
    }
    std::uint64_t most_blocks(int device, const device_kernel&) override {
        check("cudaOccupancyMaxActiveBlocksPerMultiprocessor", device);
        return resident_blocks;
    }
    void launch(int device, device_stream to_stream, const device_kernel& kernel,
                std::uint64_t n_blocks, const device_work& work) override {
        check("cudaLaunchKernel", device);
        {
            const std::lock_guard lock(mutex_);
            ++record_.n_launches;
            record_.most_blocks = std::max(record_.most_blocks, n_blocks);
            ++record_.launches_of_device[static_cast<std::size_t>(device)];
        }
        const auto function = reinterpret_cast<warp_function>(const_cast<void*>(kernel.function));
        const std::size_t workspace =
            n_blocks * kernel.workspace_bytes * static_cast<std::size_t>(kernel.threads_per_block);
        if (workspace > 0) require_inside(memory_, work.workspace, workspace);
        later(to_stream, [=] {
            std::vector<std::jthread> warps;
            for (unsigned block = 0; block < n_blocks; ++block) {
                warps.emplace_back([&work, function, block] { function(work, block); });
            }
        });
    }

    void wait(int device, device_stream which) override {
        const std::vector<std::function<void()>> all = std::move(static_cast<stream*>(which)->work);
        static_cast<stream*>(which)->work.clear();
        if (!all.empty()) {
            const std::lock_guard lock(mutex_);
            --n_in_flight_;
        }
        check("cudaStreamSynchronize", device);
        for (const auto& each : all) each();
    }

private:
    struct stream {
        std::vector<std::function<void()>> work;
    };
    using blocks = std::map<const std::byte*, std::vector<std::byte>>;

    std::byte* add(blocks& to, std::size_t bytes) {
        std::vector<std::byte> block(bytes, std::byte{0xa5});  // poison: reading it shows
        std::byte* const begin = block.data();
        to.emplace(begin, std::move(block));
        return begin;
    }

    void require_inside(const blocks& all, const std::byte* first, std::size_t bytes) const {
        const std::lock_guard lock(mutex_);
        auto after = all.upper_bound(first);
        if (after == all.begin()) throw device_error("a copy outside of all memory");
        const auto& [begin, block] = *std::prev(after);
        if (first + bytes > begin + block.size()) throw device_error("a copy beyond its memory");
    }

    void later(device_stream which, std::function<void()> work) {
        stream& to = *static_cast<stream*>(which);
        if (to.work.empty()) {
            const std::lock_guard lock(mutex_);
            record_.most_in_flight = std::max(record_.most_in_flight, ++n_in_flight_);
        }
        to.work.push_back(std::move(work));
    }

    void check(const std::string& call, int device) {
        const std::lock_guard lock(mutex_);
        if (lost_device >= 0 && device != lost_device) return;
        if (!is_lost_ && (call != failing_call || calls_until_failure-- > 0)) return;
        is_lost_ = true;
        throw device_error(call + " (cudaErrorLaunchFailure: the test asked for it)");
    }

    mutable std::mutex mutex_;
    blocks memory_;
    blocks pinned_;
    std::size_t bytes_ = 0;
    int n_open_ = 0;
    int n_in_flight_ = 0;
    bool is_lost_ = false;
    record record_;
};

}  // namespace hopscotch::emulation
