// One run per run directory, or one per shard: a lock file with process, host, job and start time.
// A second run meets a clear error; the lock of a dead run is taken over.
#pragma once

#include "host/map/shard.hpp"

#include <filesystem>
#include <string>

namespace hopscotch {

class run_lock {
public:
    /// The lock of a whole run excludes all others, that of a shard excludes the same shard and
    /// whole runs.
    /// \error  store_error where a living run holds the directory, or one on another host may
    run_lock(const std::filesystem::path& directory, const shard& part);
    ~run_lock();  // removes the lock file
    run_lock(const run_lock&) = delete;
    run_lock& operator=(const run_lock&) = delete;

    /// What was taken over, in one line; empty where the directory was free.
    const std::string& note() const { return note_; }

    /// A sign of life: the lock file's time is now. For other hosts, which cannot see the process.
    void touch() const;

private:
    void take();
    void require_no_other(const shard& part) const;
    void give_back();

    std::filesystem::path file_;
    int descriptor_ = -1;
    std::string note_;
};

bool is_shard_lock(const std::filesystem::path& file);

}  // namespace hopscotch
