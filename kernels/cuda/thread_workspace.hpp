// Memory of a GPU thread beside its stack, for the series of integrated flows with derivatives. A
// driver keeps a kernel's stack for every thread that the device could hold (bytes x 2048 x
// multiprocessors), however few the kernel's registers allow; this memory is only that of the
// threads that are launched. The host allocates it with the launch; host code that emulates threads
// has one per thread of its own.
#pragma once

#include "kernels/target.hpp"

#include <cstddef>

namespace hopscotch::inline HOPSCOTCH_TARGET {

#if defined(__CUDACC__) || defined(HOPSCOTCH_EMULATES_THREADS)
inline constexpr bool lanes_are_threads = true;
#else
inline constexpr bool lanes_are_threads = false;
#endif

inline constexpr int threads_per_block = 128;

/// The numbers of one thread, taken and given back like a stack. Those of a warp's 32 threads lie
/// side by side, so that equal places of all threads are read together.
template <class Number>
class thread_workspace {
public:
    static constexpr int warp_width = 32;

    /// Of one thread, in bytes, for so many numbers.
    static constexpr std::size_t bytes(int n) {
        return static_cast<std::size_t>(n) * sizeof(Number);
    }

    /// Before the first use: the memory of all threads of the launch, and which of them this is.
    ///
    /// \param bytes   of every thread
    HOPSCOTCH_DEVICE static void open(std::byte* memory, std::size_t bytes, unsigned thread) {
        const std::size_t n = bytes / sizeof(Number);
        Number* const warp = reinterpret_cast<Number*>(memory) +
                             static_cast<std::size_t>(thread / warp_width) * n * warp_width;
        mine() = {warp + thread % warp_width, warp + n * warp_width};
    }

    /// The first of n numbers; the others follow at a distance of `warp_width`. A kernel that wants
    /// more than it was given ends with an error.
    HOPSCOTCH_DEVICE static Number* take(int n) {
        place& here = mine();
        Number* const first = here.next;
        here.next = first + static_cast<std::ptrdiff_t>(n) * warp_width;
        if (here.next - warp_width >= here.end) stop();
        return first;
    }
    HOPSCOTCH_DEVICE static void give_back(Number* first) { mine().next = first; }

private:
    struct place {
        Number* next;
        Number* end;
    };

    HOPSCOTCH_DEVICE static place& mine() {
#ifdef __CUDA_ARCH__
        __shared__ place places[threads_per_block];
        return places[threadIdx.x];
#else
        static thread_local place only;
        return only;
#endif
    }

    HOPSCOTCH_DEVICE static void stop() {
#ifdef __CUDA_ARCH__
        __trap();
#else
        __builtin_trap();
#endif
    }
};

/// n numbers of the thread's workspace, for as long as the object lives. It is neither copied nor
/// moved on construction, so that what is taken last is given back first.
template <class Number, int n>
class workspace_array {
public:
    HOPSCOTCH_DEVICE workspace_array() : first_(thread_workspace<Number>::take(n)) {}
    HOPSCOTCH_DEVICE ~workspace_array() { thread_workspace<Number>::give_back(first_); }
    workspace_array(const workspace_array&) = delete;
    HOPSCOTCH_DEVICE workspace_array& operator=(const workspace_array& other) {
        for (int i = 0; i < n; ++i) (*this)[i] = other[i];
        return *this;
    }

    HOPSCOTCH_DEVICE Number& operator[](int i) { return first_[i * stride]; }
    HOPSCOTCH_DEVICE const Number& operator[](int i) const { return first_[i * stride]; }

private:
    static constexpr int stride = thread_workspace<Number>::warp_width;
    Number* first_;
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET
