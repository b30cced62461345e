// Commands that look at one map take an index of a sweep too: `--point i,j` says which map is
// meant.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace hopscotch {

/// The map that a command's file and `--point` stand for: the file itself, or a map of its sweep.
/// \error  usage_error where an index is given without a point, or a map with one; store_error
std::string chosen_map(const std::string& file, const std::string& point);

/// Adds `--point` to a command.
void add_point(CLI::App& command, std::string& point);

}  // namespace hopscotch
