// Both libraries' own limits.
#include "host/run/thread_limit.hpp"

#include <algorithm>

#include <omp.h>

namespace hopscotch {

thread_limit::thread_limit(int n_threads, int n_at_once)
    : tbb_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n_threads)),
      before_(omp_get_max_threads()) {
    omp_set_num_threads(std::max(1, n_threads / n_at_once));
}

thread_limit::~thread_limit() { omp_set_num_threads(before_); }

}  // namespace hopscotch
