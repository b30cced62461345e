// Beginning, waiting, ending.
#include "host/mpi/mpi_session.hpp"

#include "host/run/device_error.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

namespace hopscotch {

mpi_session::mpi_session() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) {
        throw device_error(
            "MPI (this library does not let threads take turns); one built with "
            "thread support?");
    }
    MPI_Comm_dup(MPI_COMM_WORLD, &all_);
    MPI_Comm_rank(all_, &rank_);
    MPI_Comm_size(all_, &size_);
    MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &node_);
    MPI_Comm_rank(node_, &rank_in_node_);
    MPI_Comm_size(node_, &size_of_node_);
}

mpi_session::~mpi_session() {
    std::fflush(nullptr);
    MPI_Finalize();
}

void mpi_session::wait(MPI_Request request) {
    using namespace std::chrono_literals;
    auto pause = 20us;
    while (true) {
        int is_done = 0;
        {
            const std::lock_guard guard(turn_);
            MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        }
        if (is_done != 0) return;
        std::this_thread::sleep_for(pause);
        pause = std::min<std::chrono::microseconds>(2 * pause, 1ms);
    }
}

void mpi_session::meet() {
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::lock_guard guard(turn_);
        MPI_Ibarrier(all_, &request);
    }
    wait(request);
}

}  // namespace hopscotch
