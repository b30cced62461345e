// A warp on the host: 32 fibers that meet at every vote, so that the loop of a GPU thread
// (kernels/cuda/persistent_lane.hpp) runs as it does on a device, refill rule and all.
#pragma once

#include "kernels/cuda/device_work.hpp"

#include <ucontext.h>

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace hopscotch::emulation {

/// Runs one function per fiber, turn by turn; a fiber gives up its turn in `meet`.
class fiber_group {
public:
    static constexpr int size = 32;

    /// Runs body(lane) in every fiber to its end.
    void run(const std::function<void(int)>& body) {
        body_ = &body;
        n_running_ = size;
        for (int lane = 0; lane < size; ++lane) make(lane);
        lane_ = 0;
        swapcontext(&outside_, &contexts_[0]);
    }

    /// Waits until every fiber has come here with its flag; the flags of all, one bit per lane.
    std::uint32_t meet(bool flag) {
        const std::uint32_t bit = 1u << lane_;
        coming_ = flag ? coming_ | bit : coming_ & ~bit;
        const std::uint64_t round = round_;
        if (++n_here_ == size) {
            n_here_ = 0;
            flags_ = coming_;
            ++round_;
        }
        while (round_ == round) pass_on();
        return flags_;
    }

    int lane() const { return lane_; }

    std::uint64_t shared = 0;  // what one fiber tells the others between two meetings

private:
    static constexpr std::size_t stack_bytes = 256 * 1024;

    void make(int lane) {
        ucontext_t& context = contexts_[static_cast<std::size_t>(lane)];
        getcontext(&context);
        context.uc_stack.ss_sp = &stacks_[static_cast<std::size_t>(lane) * stack_bytes];
        context.uc_stack.ss_size = stack_bytes;
        context.uc_link = nullptr;
        const auto self = reinterpret_cast<std::uintptr_t>(this);  // makecontext passes ints only
        makecontext(&context, reinterpret_cast<void (*)()>(&enter), 2,
                    static_cast<unsigned>(self >> 32), static_cast<unsigned>(self));
    }

    static void enter(unsigned high, unsigned low) {
        auto* const self = reinterpret_cast<fiber_group*>(
            (static_cast<std::uintptr_t>(high) << 32) | static_cast<std::uintptr_t>(low));
        (*self->body_)(self->lane_);
        self->leave();
    }

    void pass_on() {
        const int from = lane_;
        lane_ = (lane_ + 1) % size;
        swapcontext(&contexts_[static_cast<std::size_t>(from)],
                    &contexts_[static_cast<std::size_t>(lane_)]);
    }

    /// All fibers end after the same vote, one after the other.
    void leave() {
        if (--n_running_ == 0) setcontext(&outside_);
        pass_on();
    }

    std::vector<std::byte> stacks_ = std::vector<std::byte>(size * stack_bytes);
    ucontext_t outside_{};
    ucontext_t contexts_[size]{};
    const std::function<void(int)>* body_ = nullptr;
    int lane_ = 0;
    int n_running_ = 0;
    int n_here_ = 0;
    std::uint32_t coming_ = 0;
    std::uint32_t flags_ = 0;
    std::uint64_t round_ = 0;
};

/// What persistent_lane asks of a warp.
class emulated_warp {
public:
    static constexpr int width = fiber_group::size;

    emulated_warp(fiber_group& fibers, device_counters& counters)
        : fibers_(fibers), counters_(counters) {}

    int count(bool flag) { return std::popcount(fibers_.meet(flag)); }

    std::uint64_t draw(bool wants) {
        const std::uint32_t drawing = fibers_.meet(wants);
        if (fibers_.lane() == 0) {
            fibers_.shared = std::atomic_ref(counters_.drawn)
                                 .fetch_add(static_cast<std::uint64_t>(std::popcount(drawing)));
        }
        fibers_.meet(true);  // lane 0 has drawn
        const std::uint32_t before_me = (1u << fibers_.lane()) - 1u;
        return fibers_.shared + static_cast<std::uint64_t>(std::popcount(drawing & before_me));
    }

    void book(const lane_statistics& statistics) {
        if (fibers_.lane() != 0) return;
        std::atomic_ref(counters_.issued) += statistics.issued;
        std::atomic_ref(counters_.useful) += statistics.useful;
    }

private:
    fiber_group& fibers_;
    device_counters& counters_;
};

}  // namespace hopscotch::emulation
