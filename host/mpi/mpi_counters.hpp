// Counters of an MPI job: they lie on rank 0 and are raised by one-sided fetch-and-add. A queue
// that is open meanwhile keeps rank 0 answering (mpi_queue.hpp).
#pragma once

#include "host/mpi/mpi_session.hpp"
#include "host/run/shared_counters.hpp"

namespace hopscotch {

class mpi_counters : public shared_counters {
public:
    mpi_counters(mpi_session& session, std::size_t n);  // collective
    ~mpi_counters() override;                           // collective

    std::uint64_t add(std::size_t counter, std::uint64_t amount) override;

private:
    mpi_session& session_;
    MPI_Win window_ = MPI_WIN_NULL;
};

}  // namespace hopscotch
