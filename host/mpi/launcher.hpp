// What the environment says about the launcher (mpirun, srun) that has started this process.
#pragma once

#include <string>

namespace hopscotch {

struct launch {
    int rank = 0;
    int size = 1;          // processes it has started together; 0 where it does not say
    bool has_mpi = false;  // it offers them MPI
};

/// Reads the variables that Open MPI, PMIx, MPICH's and Intel's launchers and srun set.
launch this_launch();

}  // namespace hopscotch
