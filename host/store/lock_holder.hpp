// Who holds a run directory: what the lock file says, and the same in words for the user.
#pragma once

#include <filesystem>
#include <string>

namespace hopscotch {

struct lock_holder {
    long process = 0;  // 0: nobody, or the file is empty
    std::string host;
    std::string since;  // UTC, ISO 8601
    std::string job;    // of the batch system; "-" where there is none
    std::string start;  // which start of the job this is: a requeued job counts on

    /// The process that asks.
    static lock_holder this_process();

    /// The text of the lock file, and back.
    std::string line() const;
    static lock_holder read(int descriptor);

    bool is_on_this_host() const;

    /// True for an earlier start of the batch job that this process belongs to: the batch system
    /// has ended it before it queued the job again.
    bool is_earlier_start_of_this_job() const;

    /// "process 4711 on node7 (job 312), started 2026-03-01T10:00:00Z (2:05:00 ago)"
    std::string words() const;
};

/// The name of this machine.
std::string host_name();

/// "0:04:05": since the file was last written or touched.
std::string age_of(const std::filesystem::path& file);

}  // namespace hopscotch
