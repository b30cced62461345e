// What the analysis adds to the run of a sweep: labels and audit of every map, and facts for the
// table. Used by the command `run`.
#pragma once

#include "host/run/run_sweep.hpp"

namespace hopscotch {

sweep_hooks hooks_of_sweep();

}  // namespace hopscotch
