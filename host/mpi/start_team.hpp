// The team that this process belongs to. A program built without MPI has the same function; both
// look at the environment first, so that a program started by hand never waits for MPI to begin.
#pragma once

#include "host/run/team.hpp"

#include <string>

namespace hopscotch {

/// The ranks of the MPI job whose launcher has started this process, else a team of one. Begins MPI
/// at the first call; MPI ends with the program.
/// \error  device_error where a launcher has started several ranks that cannot find each other
team& start_team();

/// The MPI library in words, e.g. "Open MPI v4.1.4"; empty where the program is built without.
std::string mpi_library();

}  // namespace hopscotch
