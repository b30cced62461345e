// Choices that depend on the machine.
#include "host/run/run_choices.hpp"

#include <tbb/info.h>

namespace hopscotch {

int threads_for(int wanted) { return wanted > 0 ? wanted : tbb::info::default_concurrency(); }

}  // namespace hopscotch
