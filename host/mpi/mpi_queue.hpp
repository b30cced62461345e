// Tiles drawn by the ranks of an MPI job: one counter on rank 0, raised by one-sided fetch-and-add,
// and next to it the counts of what is done. Per tile there is one fetch and one accumulate.
#pragma once

#include "host/mpi/mpi_session.hpp"
#include "host/run/tile_queue.hpp"

#include <array>
#include <thread>

namespace hopscotch {

class mpi_queue : public tile_queue {
public:
    /// Collective. `tiles` are the same on all ranks; `show` is called on rank 0 only.
    mpi_queue(mpi_session& session, std::vector<std::uint64_t> tiles, progress_display show);
    ~mpi_queue() override;  // collective

    std::optional<std::uint64_t> next() override;
    void count(const run_tally& of_tile) override;
    void halt() override;
    run_tally close() override;

private:
    enum place : std::size_t { drawn, tiles, cells, undecided, issued, useful, microseconds };
    static constexpr std::size_t n_places = 7;
    using counters = std::array<std::uint64_t, n_places>;

    counters read();
    run_tally total();
    void keep_moving(std::stop_token stop);

    mpi_session& session_;
    std::vector<std::uint64_t> tiles_;
    progress_display show_;
    MPI_Win window_ = MPI_WIN_NULL;
    bool is_dry_ = false;
    bool is_halted_ = false;
    std::jthread keeper_;
};

}  // namespace hopscotch
