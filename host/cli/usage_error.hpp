// A command typed wrongly; exit code 2.
#pragma once

#include <stdexcept>
#include <string>

namespace hopscotch {

class usage_error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace hopscotch
