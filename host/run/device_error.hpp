// The compute device or instruction set asked for cannot be used here; exit code 5.
#pragma once

#include <stdexcept>
#include <string>

namespace hopscotch {

class device_error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace hopscotch
