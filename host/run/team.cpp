// A team of one.
#include "host/run/team.hpp"

#include <utility>

#include <tbb/info.h>

namespace hopscotch {

int team_of_one::default_threads() const { return tbb::info::default_concurrency(); }

std::unique_ptr<tile_queue> team_of_one::open_queue(std::vector<std::uint64_t> tiles,
                                                    progress_display show) {
    return std::make_unique<local_queue>(std::move(tiles), std::move(show));
}

}  // namespace hopscotch
