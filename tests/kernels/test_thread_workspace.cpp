// The memory that GPU threads have beside their stacks: no two numbers of a launch share an
// address, a warp's lie side by side, and a thread cannot take more than its part.
#include "kernels/cuda/thread_workspace.hpp"
#include "kernels/lanes/dual.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace hopscotch {
namespace {

using number = dual<double, 1>;
using space = thread_workspace<number>;

constexpr int n_numbers = 8;
constexpr unsigned n_threads = 96;

struct launch {
    std::vector<number> memory = std::vector<number>(n_threads * n_numbers);

    void open(unsigned thread) {
        space::open(reinterpret_cast<std::byte*>(memory.data()), space::bytes(n_numbers), thread);
    }
    bool holds(const number* at) const {
        return at >= memory.data() && at < memory.data() + memory.size();
    }
};

TEST(thread_workspace, gives_every_number_of_every_thread_a_place_of_its_own) {
    launch threads;
    std::set<const number*> places;
    for (unsigned thread = 0; thread < n_threads; ++thread) {
        threads.open(thread);
        workspace_array<number, 5> first;
        workspace_array<number, 3> second;
        for (int i = 0; i < 5; ++i) EXPECT_TRUE(places.insert(&first[i]).second);
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(places.insert(&second[i]).second);
    }
    EXPECT_EQ(places.size(), n_threads * n_numbers);
    for (const number* place : places) EXPECT_TRUE(threads.holds(place));
}

TEST(thread_workspace, lays_equal_places_of_a_warp_side_by_side) {
    launch threads;
    std::vector<const number*> of_thread;
    for (unsigned thread = 32; thread < 64; ++thread) {
        threads.open(thread);
        workspace_array<number, 5> skipped;
        workspace_array<number, 2> array;
        of_thread.push_back(&array[1]);
    }
    for (std::size_t i = 1; i < of_thread.size(); ++i) {
        EXPECT_EQ(of_thread[i], of_thread[i - 1] + 1);
    }
}

TEST(thread_workspace, takes_back_what_an_array_held) {
    launch threads;
    threads.open(3);
    const number* before = nullptr;
    for (int i = 0; i < 100; ++i) {
        workspace_array<number, n_numbers> array;
        if (i > 0) EXPECT_EQ(&array[0], before);
        before = &array[0];
    }
}

TEST(thread_workspace, an_assigned_array_has_the_others_numbers) {
    launch threads;
    threads.open(40);
    workspace_array<number, 4> from;
    workspace_array<number, 4> to;
    for (int i = 0; i < 4; ++i) from[i] = number::variable(i, 0), to[i] = number(-1.0);
    to = from;
    from[2] = number(7.0);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(to[i].value, i);
        EXPECT_EQ(to[i].slope[0], 1.0);
    }
}

void take_one_too_many() {
    launch threads;
    threads.open(31);
    workspace_array<number, n_numbers> all;
    workspace_array<number, 1> more;
    more = workspace_array<number, 1>();
}

TEST(thread_workspace_death, ends_a_thread_that_wants_more_than_its_part) {
    EXPECT_DEATH(take_one_too_many(), "");
}

}  // namespace
}  // namespace hopscotch
