// MPI from its beginning to its end, one call at a time. Only this folder includes mpi.h.
#pragma once

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <mutex>
#include <string>

namespace hopscotch {

/// Begins MPI when made and ends it with the program, after the last line is printed: a launcher
/// may end the other ranks as soon as one has left with an error.
class mpi_session {
public:
    mpi_session();
    ~mpi_session();
    mpi_session(const mpi_session&) = delete;
    mpi_session& operator=(const mpi_session&) = delete;

    MPI_Comm all() const { return all_; }
    int rank() const { return rank_; }
    int size() const { return size_; }
    int size_of_node() const { return size_of_node_; }
    int rank_in_node() const { return rank_in_node_; }
    MPI_Comm node() const { return node_; }

    /// Held around every MPI call: threads take turns (MPI_THREAD_SERIALIZED).
    std::mutex& turn() { return turn_; }

    /// Waits for a non-blocking operation and leaves the processor to others meanwhile.
    void wait(MPI_Request request);

    /// Waits until all ranks are here.
    void meet();

private:
    std::mutex turn_;
    MPI_Comm all_ = MPI_COMM_NULL;
    MPI_Comm node_ = MPI_COMM_NULL;
    int rank_ = 0;
    int size_ = 1;
    int rank_in_node_ = 0;
    int size_of_node_ = 1;
};

}  // namespace hopscotch
