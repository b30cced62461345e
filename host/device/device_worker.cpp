// Copies in, launches, copies out.
#include "host/device/device_worker.hpp"

#include "host/run/device_error.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr std::size_t counter_bytes = 256;  // device_counters, and the alignment of what follows
static_assert(sizeof(device_counters) <= counter_bytes);

}  // namespace

device_worker::device_worker(device_runtime& runtime, int device, const device_share& share)
    : runtime_(runtime), device_(device), share_(share), stream_(runtime.open_stream(device)) {}

device_worker::~device_worker() {
    abandon();
    release();
    if (workspace_ != nullptr) runtime_.release(device_, workspace_);
    runtime_.close_stream(device_, stream_);
}

void device_worker::release() noexcept {
    if (memory_.device != nullptr) runtime_.release(device_, memory_.device);
    if (memory_.pinned != nullptr) runtime_.release_pinned(memory_.pinned);
    memory_ = {};
}

void device_worker::grow(std::size_t bytes) {
    if (bytes <= memory_.bytes) return;
    release();
    // room to spare, so that pieces a little larger do not allocate again
    const std::size_t wanted = std::max(bytes, std::min(bytes + bytes / 2, share_.bytes));
    memory_.device = runtime_.allocate(device_, wanted);
    memory_.pinned = runtime_.allocate_pinned(device_, wanted);
    memory_.bytes = wanted;
}

void device_worker::grow_workspace(std::size_t bytes) {
    if (bytes <= workspace_bytes_) return;
    if (workspace_ != nullptr) runtime_.release(device_, workspace_);
    workspace_ = nullptr;
    workspace_bytes_ = 0;
    workspace_ = runtime_.allocate(device_, bytes);
    workspace_bytes_ = bytes;
}

/// As many as stay resident, no more than there are cells: their threads draw cells until none is
/// left. Where they need workspace the device's workers share its threads, for each has a launch
/// under way.
std::uint64_t device_worker::blocks_for(const device_kernel& kernel, std::uint64_t n_cells) {
    const auto threads = static_cast<std::uint64_t>(kernel.threads_per_block);
    std::uint64_t most = runtime_.most_blocks(device_, kernel);
    if (kernel.workspace_bytes > 0) {
        const std::uint64_t fair = (most + share_.of_workers - 1) / share_.of_workers;
        const std::uint64_t fitting = share_.workspace_bytes / (kernel.workspace_bytes * threads);
        most = std::max<std::uint64_t>(std::min(fair, fitting), 1);
    }
    return std::min(most, (n_cells + threads - 1) / threads);
}

std::uint64_t device_worker::most_cells(const device_layout& layout) const {
    const std::size_t taken = counter_bytes + layout.table_bytes();
    const std::uint64_t n = taken < share_.bytes ? layout.cells_within(share_.bytes - taken) : 0;
    if (n > 0) return n;
    throw device_error(
        fmt::format("device {} (its tables of {} bytes do not fit into the {} bytes that a worker "
                    "may take)",
                    device_, layout.table_bytes(), share_.bytes));
}

void device_worker::begin(const device_kernel& kernel, const device_layout& layout,
                          cell_piece piece) {
    const std::size_t layers_at = counter_bytes + layout.table_bytes();
    const std::size_t layer_bytes = layout.layer_bytes(piece.n);
    const std::uint64_t n_blocks = blocks_for(kernel, piece.n);
    grow(layers_at + layer_bytes);
    grow_workspace(kernel.workspace_bytes * n_blocks *
                   static_cast<std::uint64_t>(kernel.threads_per_block));
    piece_ = piece;
    layout.put_tables(memory_.pinned + counter_bytes);
    runtime_.clear(device_, stream_, memory_.device, counter_bytes);
    runtime_.copy_to_device(device_, stream_, memory_.device + counter_bytes,
                            memory_.pinned + counter_bytes, layout.table_bytes());
    device_work work;
    work.request =
        layout.on_device(memory_.device + counter_bytes, memory_.device + layers_at, piece);
    work.first_cell = piece.first;
    work.n_cells = piece.n;
    work.counters = reinterpret_cast<device_counters*>(memory_.device);
    work.workspace = workspace_;
    runtime_.launch(device_, stream_, kernel, n_blocks, work);
    runtime_.copy_to_host(device_, stream_, memory_.pinned, memory_.device,
                          sizeof(device_counters));
    runtime_.copy_to_host(device_, stream_, memory_.pinned + layers_at, memory_.device + layers_at,
                          layer_bytes);
}

lane_statistics device_worker::finish(const device_layout& layout) {
    runtime_.wait(device_, stream_);
    layout.take_layers(memory_.pinned + counter_bytes + layout.table_bytes(), piece_);
    device_counters counters;
    std::memcpy(&counters, memory_.pinned, sizeof counters);
    return {counters.issued, counters.useful};
}

void device_worker::abandon() noexcept {
    try {
        runtime_.wait(device_, stream_);
    } catch (const device_error&) {  // it is told already, or nobody is left to hear it
    }
}

}  // namespace hopscotch
