// The host's part of the CUDA backend on a device that is not there (tests/cuda/fake_runtime.hpp):
// pieces, streams, several devices, memory, and every call that can fail.
#include "host/device/device_pool.hpp"
#include "host/run/kernel_in_use.hpp"
#include "tests/cuda/fake_runtime.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

namespace hopscotch {
namespace {

using emulation::fake_runtime;
using testing::HasSubstr;

/// One warp's share of a kernel that writes what it reads: start, parameter, trap of the cell's
/// point, and counts a step per cell of which every second one is useful.
void echo(const device_work& work, unsigned) {
    const ensemble_request& request = work.request;
    while (true) {
        const std::uint64_t number = std::atomic_ref(work.counters->drawn)++;
        if (number >= work.n_cells) return;
        const std::uint64_t cell = work.first_cell + number;
        request.time[cell] = request.columns[0].at(cell) + 1000.0 * request.parameters[0].at(cell);
        const auto point = static_cast<std::uint64_t>(request.trap_point.at(cell));
        request.label[cell] = static_cast<std::int16_t>(request.traps[point * 2 + 1].label);
        request.outcome[cell] = static_cast<std::uint8_t>(cell % 7);
        std::atomic_ref(work.counters->issued) += 2;
        std::atomic_ref(work.counters->useful) += 1;
    }
}

const device_kernel echo_kernel{reinterpret_cast<const void*>(&echo), 32};

/// A grid of starts and parameters; the points of its cells begin at point 5.
struct grid_request {
    std::vector<double> starts, parameters, points;
    std::vector<trap_interval> traps;
    std::vector<double> time;
    std::vector<std::int16_t> label;
    std::vector<std::uint8_t> outcome;
    ensemble_request request;

    grid_request(std::size_t n_starts, std::size_t n_parameters) {
        starts.resize(n_starts);
        parameters.resize(n_parameters);
        points.resize(n_parameters);
        std::iota(starts.begin(), starts.end(), 1.0);
        std::iota(parameters.begin(), parameters.end(), 1.0);
        std::iota(points.begin(), points.end(), 5.0);
        for (int i = 0; i < 2 * (5 + static_cast<int>(n_parameters)); ++i) {
            traps.push_back({0.0, 1.0, i % 1000});
        }
        const std::size_t n = n_starts * n_parameters;
        time.assign(n, -1.0), label.assign(n, -1), outcome.assign(n, 255);
        request.n_cells = n;
        request.columns[0] = {starts.data(), 1, n_starts};
        request.parameters[0] = {parameters.data(), n_starts, n_parameters};
        request.trap_point = {points.data(), n_starts, n_parameters};
        request.traps = traps.data();
        request.n_traps = 2;
        request.time = time.data();
        request.label = label.data();
        request.outcome = outcome.data();
    }

    void expect_answered() const {
        for (std::size_t cell = 0; cell < time.size(); ++cell) {
            const std::size_t row = cell / starts.size();
            ASSERT_EQ(time[cell], starts[cell % starts.size()] + 1000.0 * parameters[row]) << cell;
            ASSERT_EQ(label[cell], traps[(5 + row) * 2 + 1].label) << cell;
            ASSERT_EQ(outcome[cell], cell % 7) << cell;
        }
    }
};

TEST(device_pool, computes_every_cell_of_a_request_once_in_pieces) {
    fake_runtime runtime;
    grid_request grid(123, 77);
    {
        device_pool pool(runtime, {.workers_per_device = 2, .least_cells = 1000});
        const lane_statistics lanes = pool.run(echo_kernel, grid.request);
        EXPECT_EQ(lanes.issued, 2 * grid.request.n_cells);
        EXPECT_EQ(lanes.useful, grid.request.n_cells);
    }
    grid.expect_answered();
    EXPECT_GE(runtime.seen().n_launches, 4);
    EXPECT_TRUE(runtime.is_clean());
}

TEST(device_pool, a_small_request_is_one_launch) {
    fake_runtime runtime;
    grid_request grid(10, 10);
    device_pool(runtime).run(echo_kernel, grid.request);
    grid.expect_answered();
    EXPECT_EQ(runtime.seen().n_launches, 1);
}

TEST(device_pool, one_request_keeps_two_streams_or_more_at_work) {
    fake_runtime runtime;
    grid_request grid(200, 100);
    device_pool(runtime, {.workers_per_device = 2, .least_cells = 100})
        .run(echo_kernel, grid.request);
    grid.expect_answered();
    EXPECT_EQ(runtime.seen().n_streams, 2);
    EXPECT_EQ(runtime.seen().most_in_flight, 2);
}

TEST(device_pool, several_devices_share_one_request) {
    fake_runtime runtime;
    runtime.devices = 3;
    grid_request grid(200, 100);
    device_pool pool(runtime, {.workers_per_device = 2, .least_cells = 100});
    pool.run(echo_kernel, grid.request);
    grid.expect_answered();
    for (std::size_t device = 0; device < 3; ++device) {
        EXPECT_GT(runtime.seen().launches_of_device[device], 0) << device;
    }
    EXPECT_EQ(pool.names(), "3 x emulated device");
}

TEST(device_pool, many_threads_share_the_workers) {
    fake_runtime runtime;
    device_pool pool(runtime, {.workers_per_device = 2, .least_cells = 64});
    std::vector<grid_request> grids(6, grid_request(1, 1));
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        threads.emplace_back([&, i] {
            grids[i] = grid_request(37 + i, 29);
            // the request points into the moved vectors, which stay where they are
            for (int round = 0; round < 5; ++round) pool.run(echo_kernel, grids[i].request);
        });
    }
    threads.clear();
    for (const grid_request& grid : grids) grid.expect_answered();
}

TEST(device_pool, memory_stays_within_its_limit_whatever_the_size) {
    fake_runtime runtime;
    grid_request grid(1000, 400);  // 11 bytes a cell: 4.4 MB of layers
    {
        device_pool pool(runtime, {.workers_per_device = 2, .most_bytes = 200000});
        pool.run(echo_kernel, grid.request);
    }
    grid.expect_answered();
    EXPECT_LE(runtime.seen().most_bytes, 200000u);
    EXPECT_GE(runtime.seen().n_launches, 40);
}

TEST(device_pool, pieces_follow_the_free_memory) {
    fake_runtime runtime;
    runtime.free_bytes = 300000;  // of which half may be taken
    grid_request grid(1000, 100);
    device_pool(runtime, {.workers_per_device = 1}).run(echo_kernel, grid.request);
    grid.expect_answered();
    EXPECT_LE(runtime.seen().most_bytes, 150000u);
}

/// As echo; first every thread of the block fills its part of the workspace with the block's
/// number, and at the end finds it as it was.
void echo_beside_workspace(const device_work& work, unsigned block) {
    constexpr std::size_t bytes = 32 * 100;  // of a block
    std::byte* const mine = work.workspace + block * bytes;
    std::fill(mine, mine + bytes, static_cast<std::byte>(block));
    echo(work, block);
    const bool is_whole = std::all_of(
        mine, mine + bytes, [&](std::byte b) { return b == static_cast<std::byte>(block); });
    if (!is_whole) work.request.outcome[work.first_cell] = 99;
}

const device_kernel workspace_kernel{reinterpret_cast<const void*>(&echo_beside_workspace), 32,
                                     100};

TEST(device_pool, workers_share_the_threads_that_need_workspace) {
    fake_runtime runtime;
    runtime.resident_blocks = 12;
    grid_request grid(1000, 10);
    {
        device_pool pool(runtime, {.workers_per_device = 3, .least_cells = 1000});
        pool.run(workspace_kernel, grid.request);
        grid.expect_answered();
        EXPECT_EQ(runtime.seen().most_blocks, 4u);
        pool.run(echo_kernel, grid.request);  // this one needs none
        EXPECT_EQ(runtime.seen().most_blocks, 12u);
    }
    EXPECT_TRUE(runtime.is_clean());
}

TEST(device_pool, workspace_stays_within_its_limit) {
    fake_runtime runtime;
    runtime.resident_blocks = 500;
    const std::size_t limit = 3 * 7 * 3200;  // seven blocks of each worker
    grid_request grid(1000, 10);
    device_pool pool(
        runtime, {.workers_per_device = 3, .most_bytes = 600000, .most_workspace_bytes = limit});
    pool.run(workspace_kernel, grid.request);
    grid.expect_answered();
    EXPECT_EQ(runtime.seen().most_blocks, 7u);
    EXPECT_LE(runtime.seen().most_bytes, 600000u + limit);
}

TEST(device_pool, tables_that_do_not_fit_are_an_error_that_says_so) {
    fake_runtime runtime;
    grid_request grid(100000, 1);
    device_pool pool(runtime, {.workers_per_device = 1, .most_bytes = 100000});
    try {
        pool.run(echo_kernel, grid.request);
        FAIL() << "no error";
    } catch (const device_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("do not fit into the 100000 bytes"));
    }
}

TEST(device_pool, no_device_is_an_error_at_once) {
    fake_runtime runtime;
    runtime.devices = 0;
    EXPECT_THROW(device_pool pool(runtime), device_error);
}

const char* const every_call[] = {"cudaGetDeviceProperties",
                                  "cudaMalloc",
                                  "cudaHostAlloc",
                                  "cudaStreamCreateWithFlags",
                                  "cudaMemcpyAsync to the device",
                                  "cudaMemcpyAsync to the host",
                                  "cudaMemsetAsync",
                                  "cudaOccupancyMaxActiveBlocksPerMultiprocessor",
                                  "cudaLaunchKernel",
                                  "cudaStreamSynchronize"};

std::string name_of_call(const testing::TestParamInfo<const char*>& call) {
    std::string name = call.param;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

class failing_call : public testing::TestWithParam<const char*> {};

TEST_P(failing_call, is_named_and_leaves_nothing_behind) {
    for (int after = 0; after < 5; ++after) {
        fake_runtime runtime;
        runtime.failing_call = GetParam();
        runtime.calls_until_failure = after;
        grid_request grid(100, 100);
        bool has_failed = false;
        try {
            device_pool pool(runtime, {.workers_per_device = 2, .least_cells = 500});
            pool.run(echo_kernel, grid.request);
        } catch (const device_error& error) {
            has_failed = true;
            EXPECT_THAT(error.what(), HasSubstr(GetParam()));
        }
        if (!has_failed) grid.expect_answered();
        EXPECT_TRUE(has_failed || after > 0);
        EXPECT_TRUE(runtime.is_clean());
    }
}

INSTANTIATE_TEST_SUITE_P(every, failing_call, testing::ValuesIn(every_call), name_of_call);

class failing_device : public testing::TestWithParam<const char*> {};

TEST_P(failing_device, leaves_its_pieces_to_the_others) {
    for (int after = 0; after < 7; ++after) {
        fake_runtime runtime;
        runtime.devices = 3;
        runtime.lost_device = 1;
        runtime.failing_call = GetParam();
        runtime.calls_until_failure = after;
        {
            device_pool pool(runtime, {.workers_per_device = 2, .least_cells = 500});
            grid_request grid(100, 100);
            const lane_statistics lanes = pool.run(echo_kernel, grid.request);
            grid.expect_answered();
            EXPECT_EQ(lanes.issued, 2 * grid.request.n_cells);  // none is counted twice
            const int before = runtime.seen().launches_of_device[1];
            const bool has_failed = !pool.failures().empty();
            EXPECT_TRUE(has_failed || after > 0);
            if (has_failed) {
                EXPECT_THAT(pool.failures(), testing::StartsWith("device 1: "));
                EXPECT_THAT(pool.failures(), HasSubstr(GetParam()));
            }
            grid_request another(90, 90);
            pool.run(echo_kernel, another.request);
            another.expect_answered();
            if (has_failed) EXPECT_EQ(runtime.seen().launches_of_device[1], before);
        }
        EXPECT_TRUE(runtime.is_clean());
    }
}

INSTANTIATE_TEST_SUITE_P(every, failing_device, testing::ValuesIn(every_call), name_of_call);

TEST(device_pool, threads_that_wait_for_a_worker_go_on_when_a_device_fails) {
    for (const int lost : {0, -1}) {  // one of two, or both
        fake_runtime runtime;
        runtime.devices = 2;
        runtime.lost_device = lost;
        runtime.failing_call = "cudaStreamSynchronize";
        runtime.calls_until_failure = 10;
        device_pool pool(runtime, {.workers_per_device = 1, .least_cells = 64});
        std::atomic<int> n_answered = 0;
        {
            std::vector<std::jthread> threads;
            for (int i = 0; i < 6; ++i) {
                threads.emplace_back([&] {
                    grid_request grid(37, 29);
                    try {
                        pool.run(echo_kernel, grid.request);
                        grid.expect_answered();
                        ++n_answered;
                    } catch (const device_error& error) {
                        for (const char* part : {"device 0: ", "device 1: ", "cudaStreamSync"}) {
                            EXPECT_THAT(error.what(), HasSubstr(part));
                        }
                    }
                });
            }
        }
        if (lost == 0) EXPECT_EQ(n_answered, 6);
        if (lost < 0) EXPECT_LT(n_answered, 6);
    }
}

int n_processor_runs = 0;

lane_statistics on_the_device(const ensemble_request& request) {
    static int n_runs = 0;
    if (++n_runs > 2) throw device_error("cudaStreamSynchronize (cudaErrorECCUncorrectable)");
    request.outcome[0] = 1;
    return {32, 16};
}
lane_statistics on_the_processor(const ensemble_request& request) {
    ++n_processor_runs;
    request.outcome[0] = 1;
    return {8, 8};
}
lane_statistics always_lost(const ensemble_request&) { throw device_error("cudaMalloc (lost)"); }

TEST(kernel_in_use, the_processor_goes_on_when_the_device_is_lost_and_it_is_told) {
    kernel_in_use kernel({backend::cuda, 0, &on_the_device},
                         kernel_choice{backend::avx2, 0, &on_the_processor});
    std::uint8_t outcome = 0;
    ensemble_request request;
    request.outcome = &outcome;
    for (int tile = 0; tile < 5; ++tile) {
        outcome = 0;
        kernel.run(request);
        EXPECT_EQ(outcome, 1) << tile;
    }
    EXPECT_EQ(n_processor_runs, 3);
    EXPECT_EQ(kernel.backends(), "cuda, avx2");
    EXPECT_EQ(kernel.failure(), "cudaStreamSynchronize (cudaErrorECCUncorrectable)");
}

TEST(kernel_in_use, devices_that_others_stand_in_for_are_told_of) {
    kernel_in_use kernel({backend::cuda, 0, &on_the_processor,
                          [] { return std::string("device 1: cudaMalloc (lost)"); }});
    std::uint8_t outcome = 0;
    ensemble_request request;
    request.outcome = &outcome;
    kernel.run(request);
    EXPECT_EQ(kernel.backends(), "cuda");
    EXPECT_EQ(kernel.failure(), "device 1: cudaMalloc (lost)");
    EXPECT_EQ(kernel.successor(), "the other devices");
}

TEST(kernel_in_use, a_device_asked_for_by_name_is_not_replaced) {
    kernel_in_use kernel({backend::cuda, 0, &always_lost});
    try {
        kernel.run({});
        FAIL() << "no error";
    } catch (const device_error& error) {
        EXPECT_STREQ(error.what(), "cudaMalloc (lost); --backend auto?");
    }
    EXPECT_EQ(kernel.backends(), "cuda");
}

}  // namespace
}  // namespace hopscotch
