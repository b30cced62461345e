// The team of a program that is built with MPI.
#include "host/mpi/device_of_rank.hpp"
#include "host/mpi/launcher.hpp"
#include "host/mpi/mpi_team.hpp"
#include "host/mpi/start_team.hpp"

namespace hopscotch {
namespace {

team& start_mpi() {
    static mpi_session session;
    static mpi_team ranks(session);
    choose_device(session.rank_in_node());
    return ranks;
}

}  // namespace

team& start_team() {
    const launch started = this_launch();
    if (started.has_mpi && started.size != 1) return start_mpi();
    static team_of_one alone;
    return alone;
}

std::string mpi_library() {
    char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
    int length = 0;
    MPI_Get_library_version(text, &length);
    const std::string words(text, static_cast<std::size_t>(length));
    return words.substr(0, words.find_first_of(",\n"));
}

}  // namespace hopscotch
