// Models and sections as arguments of commands.
#pragma once

#include "kernels/contract/entry.hpp"

#include <string>

namespace hopscotch {

/// \error usage_error with a suggestion
const model_entry& model_named(const std::string& name);

/// Index of the section; an empty name is the model's first. \error usage_error with a suggestion
int section_named(const model_info& info, const std::string& name);

}  // namespace hopscotch
