// The team of a program that is built without MPI.
#include "host/mpi/launcher.hpp"
#include "host/mpi/start_team.hpp"
#include "host/run/device_error.hpp"

#include <fmt/format.h>

namespace hopscotch {

team& start_team() {
    const launch started = this_launch();
    if (started.size > 1) {
        throw device_error(
            fmt::format("{} ranks were started together (this program is built "
                        "without MPI); install libopenmpi-dev and build again?",
                        started.size));
    }
    static team_of_one alone;
    return alone;
}

std::string mpi_library() { return {}; }

}  // namespace hopscotch
