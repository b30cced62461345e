// Holds a command to the threads that its user allows: TBB's (tiles, maps of a sweep, audit) and
// OpenMP's (the search for attractors, passes over finished layers). Used by whatever takes
// `run_choices::n_threads`.
#pragma once

#include <tbb/global_control.h>

namespace hopscotch {

/// While it lives, TBB starts no more than `n_threads` threads in this process, and the thread that
/// has made it no more than its share of them for an OpenMP region. Limits nest.
///
/// OpenMP keeps its limit per thread: one that is made by a worker of TBB needs a limit of its own.
class thread_limit {
public:
    /// \param n_threads  > 0
    /// \param n_at_once  threads (> 0) with such a limit that work side by side, at most
    explicit thread_limit(int n_threads, int n_at_once = 1);
    ~thread_limit();
    thread_limit(const thread_limit&) = delete;
    thread_limit& operator=(const thread_limit&) = delete;

private:
    tbb::global_control tbb_;
    int before_;  // of OpenMP
};

}  // namespace hopscotch
