// A warp of a GPU as persistent_lane sees it: votes, and draws with one atomic addition per warp.
// Compiled by nvcc only.
#pragma once

#include "kernels/cuda/device_work.hpp"
#include "kernels/target.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET {

class gpu_warp {
public:
    static constexpr int width = 32;

    __device__ explicit gpu_warp(device_counters* counters) : counters_(counters) {}

    __device__ int count(bool flag) const { return __popc(__ballot_sync(everyone, flag)); }

    __device__ std::uint64_t draw(bool wants) {
        const unsigned drawing = __ballot_sync(everyone, wants);
        unsigned long long first = 0;
        if (place() == 0) {
            first =
                atomicAdd(word(counters_->drawn), static_cast<unsigned long long>(__popc(drawing)));
        }
        first = __shfl_sync(everyone, first, 0);
        const unsigned before_me = (1u << place()) - 1u;
        return first + static_cast<unsigned>(__popc(drawing & before_me));
    }

    __device__ void book(const lane_statistics& statistics) {
        if (place() != 0) return;
        atomicAdd(word(counters_->issued), static_cast<unsigned long long>(statistics.issued));
        atomicAdd(word(counters_->useful), static_cast<unsigned long long>(statistics.useful));
    }

private:
    static constexpr unsigned everyone = 0xffffffffu;
    device_counters* counters_;

    __device__ static unsigned place() { return threadIdx.x % 32u; }
    __device__ static unsigned long long* word(std::uint64_t& counter) {
        return reinterpret_cast<unsigned long long*>(&counter);
    }
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
