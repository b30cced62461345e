// Environment variables of launchers.
#include "host/mpi/launcher.hpp"

#include <cstdlib>

namespace hopscotch {
namespace {

/// The number in the first of the variables that is set; otherwise -1.
template <class... Names>
int number_in(Names... names) {
    for (const char* name : {names...}) {
        const char* text = std::getenv(name);
        if (text != nullptr && *text != '\0') return std::atoi(text);
    }
    return -1;
}

}  // namespace

launch this_launch() {
    launch result;
    const int rank = number_in("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK");
    result.has_mpi = rank >= 0;
    if (!result.has_mpi) return result;
    result.rank = rank;
    const int size = number_in("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS");
    result.size = size > 0 ? size : 0;
    return result;
}

}  // namespace hopscotch
