// One run per run directory: a lock file with process, host and start time. A second run meets a
// clear error; the lock of a dead run is taken over.
#pragma once

#include <filesystem>
#include <string>

namespace hopscotch {

class run_lock {
public:
    /// \error  store_error where a living run holds the directory, or one on another host may
    explicit run_lock(const std::filesystem::path& directory);
    ~run_lock();  // removes the lock file
    run_lock(const run_lock&) = delete;
    run_lock& operator=(const run_lock&) = delete;

    /// What was taken over, in one line; empty where the directory was free.
    const std::string& note() const { return note_; }

private:
    std::filesystem::path file_;
    int descriptor_ = -1;
    std::string note_;
};

}  // namespace hopscotch
