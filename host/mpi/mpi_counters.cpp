// One window of counters on rank 0.
#include "host/mpi/mpi_counters.hpp"

#include <algorithm>

namespace hopscotch {
namespace {

constexpr int owner = 0;

}  // namespace

mpi_counters::mpi_counters(mpi_session& session, std::size_t n) : session_(session) {
    const bool is_owner = session_.rank() == owner;
    {
        const std::lock_guard guard(session_.turn());
        std::uint64_t* base = nullptr;
        const auto bytes = static_cast<MPI_Aint>(is_owner ? n * sizeof(std::uint64_t) : 0);
        MPI_Win_allocate(bytes, sizeof(std::uint64_t), MPI_INFO_NULL, session_.all(), &base,
                         &window_);
        MPI_Win_lock_all(0, window_);
        if (is_owner) {
            std::fill_n(base, n, std::uint64_t{0});
            MPI_Win_sync(window_);
        }
    }
    session_.meet();
}

mpi_counters::~mpi_counters() {
    session_.meet();
    const std::lock_guard guard(session_.turn());
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
}

std::uint64_t mpi_counters::add(std::size_t counter, std::uint64_t amount) {
    std::uint64_t before = 0;
    const std::lock_guard guard(session_.turn());
    MPI_Fetch_and_op(&amount, &before, MPI_UINT64_T, owner, static_cast<MPI_Aint>(counter), MPI_SUM,
                     window_);
    MPI_Win_flush(owner, window_);
    return before;
}

}  // namespace hopscotch
