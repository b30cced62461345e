// What `run` and `merge` have in common: the analysis' part in a run, and how it is answered on the
// terminal and beside the map.
#pragma once

#include "host/run/run_map.hpp"
#include "host/run/team.hpp"

#include <filesystem>

namespace hopscotch {

/// Computes a map by all ranks; rank 0 tells its end, writes summary and picture.
/// \return  the exit code, of every rank
/// \error   as run_map
int run_and_tell(const scene& scene, const run_choices& choices, team& ranks);

/// Plans and audits of the analysis for a map file.
run_hooks hooks_of(const scene& scene, const std::filesystem::path& file);

}  // namespace hopscotch
