// The shared counters.
#include "host/mpi/mpi_queue.hpp"

#include <chrono>
#include <cmath>
#include <utility>

namespace hopscotch {
namespace {

constexpr int owner = 0;                                      // the rank that holds the counters
constexpr std::uint64_t beyond_all = std::uint64_t{1} << 40;  // more than any queue's tiles

}  // namespace

mpi_queue::mpi_queue(mpi_session& session, std::vector<std::uint64_t> all, progress_display show)
    : session_(session), tiles_(std::move(all)), show_(std::move(show)) {
    const bool is_owner = session_.rank() == owner;
    {
        const std::lock_guard guard(session_.turn());
        std::uint64_t* base = nullptr;
        const MPI_Aint bytes = is_owner ? sizeof(counters) : 0;
        MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, session_.all(), &base,
                         &window_);
        MPI_Win_lock_all(0, window_);
        if (is_owner) {
            for (std::size_t i = 0; i < n_places; ++i) base[i] = 0;
            MPI_Win_sync(window_);
        }
    }
    session_.meet();
    if (is_owner) keeper_ = std::jthread([this](std::stop_token stop) { keep_moving(stop); });
}

mpi_queue::~mpi_queue() {
    keeper_ = {};
    session_.meet();
    const std::lock_guard guard(session_.turn());
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
}

std::optional<std::uint64_t> mpi_queue::next() {
    if (is_dry_) return std::nullopt;
    const std::uint64_t one = 1;
    std::uint64_t mine = 0;
    {
        const std::lock_guard guard(session_.turn());
        MPI_Fetch_and_op(&one, &mine, MPI_UINT64_T, owner, drawn, MPI_SUM, window_);
        MPI_Win_flush(owner, window_);
    }
    if (mine < tiles_.size()) return tiles_[mine];
    is_dry_ = true;
    return std::nullopt;
}

void mpi_queue::count(const run_tally& of_tile) {
    const counters more{0,
                        of_tile.tiles,
                        of_tile.cells,
                        of_tile.undecided,
                        of_tile.lanes.issued,
                        of_tile.lanes.useful,
                        static_cast<std::uint64_t>(std::llround(1e6 * of_tile.busy))};
    const std::lock_guard guard(session_.turn());
    MPI_Accumulate(more.data(), n_places, MPI_UINT64_T, owner, 0, n_places, MPI_UINT64_T, MPI_SUM,
                   window_);
    MPI_Win_flush(owner, window_);
}

void mpi_queue::halt() {
    is_dry_ = true;
    if (std::exchange(is_halted_, true)) return;
    const std::lock_guard guard(session_.turn());
    MPI_Accumulate(&beyond_all, 1, MPI_UINT64_T, owner, drawn, 1, MPI_UINT64_T, MPI_SUM, window_);
    MPI_Win_flush(owner, window_);
}

run_tally mpi_queue::close() {
    session_.meet();
    keeper_ = {};
    const run_tally all = total();
    if (session_.rank() == owner) show_(all);
    return all;
}

mpi_queue::counters mpi_queue::read() {
    const counters nothing{};
    counters now{};
    const std::lock_guard guard(session_.turn());
    MPI_Get_accumulate(nothing.data(), n_places, MPI_UINT64_T, now.data(), n_places, MPI_UINT64_T,
                       owner, 0, n_places, MPI_UINT64_T, MPI_NO_OP, window_);
    MPI_Win_flush(owner, window_);
    return now;
}

run_tally mpi_queue::total() {
    const counters now = read();
    return {now[tiles],
            now[cells],
            now[undecided],
            {now[issued], now[useful]},
            1e-6 * static_cast<double>(now[microseconds])};
}

/// Where the network has no remote memory access, the owner's library answers the others only while
/// somebody is inside it; all its other threads may be deep in tiles.
void mpi_queue::keep_moving(std::stop_token stop) {
    using clock = std::chrono::steady_clock;
    auto next_look = clock::now();
    while (!stop.stop_requested()) {
        {
            const std::lock_guard guard(session_.turn());
            int is_there = 0;
            MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, session_.all(), &is_there, MPI_STATUS_IGNORE);
        }
        if (clock::now() >= next_look) {
            show_(total());
            next_look = clock::now() + std::chrono::milliseconds(200);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace hopscotch
