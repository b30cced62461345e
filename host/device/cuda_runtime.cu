// CUDA's runtime behind the host's interface. Every call is checked, and an error names the call.
#include "host/device/devices.hpp"
#include "host/run/device_error.hpp"

#include <cuda_runtime_api.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

void require(cudaError_t status, const char* call) {
    if (status == cudaSuccess) return;
    cudaGetLastError();  // an error that the next call could survive is told once
    throw device_error(std::string(call) + " (" + cudaGetErrorName(status) + ": " +
                       cudaGetErrorString(status) + ")");
}

int attribute(cudaDeviceAttr which, int device) {
    int value = 0;
    require(cudaDeviceGetAttribute(&value, which, device), "cudaDeviceGetAttribute");
    return value;
}

cudaStream_t stream_of(device_stream stream) { return static_cast<cudaStream_t>(stream); }

class cuda_runtime final : public device_runtime {
public:
    int n_devices() override {
        const std::lock_guard lock(mutex_);
        if (usable_.empty()) usable_ = find_usable();
        return static_cast<int>(usable_.size());
    }

    device_description describe(int device) override {
        select(device);
        cudaDeviceProp properties{};
        require(cudaGetDeviceProperties(&properties, usable(device)), "cudaGetDeviceProperties");
        device_description result;
        result.name = properties.name;
        require(cudaMemGetInfo(&result.free_bytes, &result.total_bytes), "cudaMemGetInfo");
        result.n_multiprocessors = properties.multiProcessorCount;
        result.clock_hertz = 1e3 * attribute(cudaDevAttrClockRate, usable(device));
        // cores for single precision: 64 in compute capability 8.0, 128 in all later ones
        const int single = properties.major == 8 && properties.minor == 0 ? 64 : 128;
        result.binary64_per_multiprocessor =
            single / attribute(cudaDevAttrSingleToDoublePrecisionPerfRatio, usable(device));
        return result;
    }

    std::byte* allocate(int device, std::size_t bytes) override {
        select(device);
        void* memory = nullptr;
        require(cudaMalloc(&memory, bytes), "cudaMalloc");
        return static_cast<std::byte*>(memory);
    }
    void release(int device, std::byte* memory) noexcept override {
        cudaSetDevice(usable(device));
        cudaFree(memory);
    }
    std::byte* allocate_pinned(int device, std::size_t bytes) override {
        select(device);
        void* memory = nullptr;
        require(cudaHostAlloc(&memory, bytes, cudaHostAllocPortable), "cudaHostAlloc");
        return static_cast<std::byte*>(memory);
    }
    void release_pinned(std::byte* memory) noexcept override { cudaFreeHost(memory); }

    device_stream open_stream(int device) override {
        select(device);
        cudaStream_t stream = nullptr;
        require(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking),
                "cudaStreamCreateWithFlags");
        return stream;
    }
    void close_stream(int device, device_stream stream) noexcept override {
        cudaSetDevice(usable(device));
        cudaStreamDestroy(stream_of(stream));
    }

    void copy_to_device(int device, device_stream stream, std::byte* to, const std::byte* from,
                        std::size_t bytes) override {
        select(device);
        require(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream_of(stream)),
                "cudaMemcpyAsync to the device");
    }
    void copy_to_host(int device, device_stream stream, std::byte* to, const std::byte* from,
                      std::size_t bytes) override {
        select(device);
        require(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream_of(stream)),
                "cudaMemcpyAsync to the host");
    }
    void clear(int device, device_stream stream, std::byte* memory, std::size_t bytes) override {
        select(device);
        require(cudaMemsetAsync(memory, 0, bytes, stream_of(stream)), "cudaMemsetAsync");
    }

    std::uint64_t most_blocks(int device, const device_kernel& kernel) override {
        select(device);
        int resident = 0;
        require(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&resident, kernel.function,
                                                              kernel.threads_per_block, 0),
                "cudaOccupancyMaxActiveBlocksPerMultiprocessor");
        return static_cast<std::uint64_t>(resident) *
               static_cast<std::uint64_t>(
                   attribute(cudaDevAttrMultiProcessorCount, usable(device)));
    }

    void launch(int device, device_stream stream, const device_kernel& kernel,
                std::uint64_t n_blocks, const device_work& work) override {
        select(device);
        void* arguments[] = {const_cast<device_work*>(&work)};
        require(cudaLaunchKernel(kernel.function, dim3(static_cast<unsigned>(n_blocks)),
                                 dim3(static_cast<unsigned>(kernel.threads_per_block)), arguments,
                                 0, stream_of(stream)),
                "cudaLaunchKernel");
    }

    void wait(int device, device_stream stream) override {
        select(device);
        require(cudaStreamSynchronize(stream_of(stream)), "cudaStreamSynchronize");
    }

private:
    std::mutex mutex_;
    std::vector<int> usable_;  // devices as CUDA numbers them; not changed once there are some

    int usable(int device) const { return usable_[static_cast<std::size_t>(device)]; }
    void select(int device) const { require(cudaSetDevice(usable(device)), "cudaSetDevice"); }

    static std::string text_of(int capability) {
        return std::to_string(capability / 10) + "." + std::to_string(capability % 10);
    }

    /// Devices that the kernels are built for. Creates no context on any of them.
    static std::vector<int> find_usable() {
        int n = 0;
        const cudaError_t status = cudaGetDeviceCount(&n);
        if (status == cudaErrorNoDevice) return {};
        int driver = 0;
        if (status == cudaErrorInsufficientDriver && cudaDriverGetVersion(&driver) == cudaSuccess &&
            driver == 0) {
            throw device_error("there is no NVIDIA driver");
        }
        require(status, "cudaGetDeviceCount");
        std::vector<int> found;
        int newest = 0;
        for (int device = 0; device < n; ++device) {
            const int capability = 10 * attribute(cudaDevAttrComputeCapabilityMajor, device) +
                                   attribute(cudaDevAttrComputeCapabilityMinor, device);
            if (capability >= HOPSCOTCH_LEAST_CAPABILITY) found.push_back(device);
            newest = std::max(newest, capability);
        }
        if (n > 0 && found.empty()) {
            throw device_error("the newest GPU has compute capability " + text_of(newest) +
                               ", kernels are built from " + text_of(HOPSCOTCH_LEAST_CAPABILITY) +
                               " on");
        }
        return found;
    }
};

}  // namespace

device_runtime& cuda_devices() {
    static cuda_runtime runtime;
    return runtime;
}

}  // namespace hopscotch
