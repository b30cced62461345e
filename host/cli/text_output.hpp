// Text results of commands: to a file that appears whole or not at all, or to standard output.
#pragma once

#include <string>

namespace hopscotch {

/// \param file  "" or "-" for standard output
/// \error store_error
void put_text(const std::string& file, const std::string& text);

}  // namespace hopscotch
