// A team of one; what ranks lose by waiting.
#include "host/run/team.hpp"

#include <algorithm>
#include <utility>

#include <tbb/info.h>

namespace hopscotch {

int team_of_one::default_threads() const { return tbb::info::default_concurrency(); }

std::unique_ptr<tile_queue> team_of_one::open_queue(std::vector<std::uint64_t> tiles,
                                                    progress_display show) {
    return std::make_unique<local_queue>(std::move(tiles), std::move(show));
}

std::unique_ptr<shared_counters> team_of_one::open_counters(std::size_t n) {
    return std::make_unique<local_counters>(n);
}

double idle_share(const std::vector<double>& seconds) {
    const double longest = *std::max_element(seconds.begin(), seconds.end());
    double idle = 0.0;
    for (const double each : seconds) idle += longest - each;
    return longest > 0.0 ? idle / (longest * static_cast<double>(seconds.size())) : 0.0;
}

}  // namespace hopscotch
