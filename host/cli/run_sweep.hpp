// The command `run` for a scene with a sweep.
#pragma once

#include "host/run/run_map.hpp"

namespace hopscotch {

/// Computes (or with `is_dry` only plans) the maps and says what came of it. \return the exit code
int run_and_tell_sweep(const scene& sweep, const run_choices& choices, bool is_dry, team& ranks);

}  // namespace hopscotch
