// Exit codes: promises to scripts.
#pragma once

#include <exception>

namespace hopscotch {

enum exit_code : int {
    exit_done = 0,
    exit_failed = 1,  // a mistake in this program
    exit_usage = 2,
    exit_input = 3,
    exit_store = 4,
    exit_device = 5,
    exit_resumable = 75
};

/// The exit code that an error of a run ends in.
int exit_code_of(const std::exception& error);

}  // namespace hopscotch
