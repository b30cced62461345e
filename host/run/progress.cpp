// Writes the progress line.
#include "host/run/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace hopscotch {

progress_line::progress_line(std::uint64_t total, std::uint64_t done, bool is_quiet)
    : total_(total),
      done_(done),
      is_quiet_(is_quiet),
      is_terminal_(isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()),
      next_(begin_ + std::chrono::milliseconds(is_terminal_ ? 200 : 10000)) {}

progress_line::~progress_line() {
    if (has_line_ && is_terminal_) std::fputs("\n", stderr);
}

void progress_line::show(const run_tally& tally) {
    const auto now = std::chrono::steady_clock::now();
    const bool is_last = has_line_ && done_ + tally.cells == total_;
    if (is_quiet_ || (now < next_ && !is_last)) return;
    next_ = now + std::chrono::milliseconds(is_terminal_ ? 200 : 10000);
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const char* format = is_terminal_ ? "\r\033[K{}" : "{}\n";
    fmt::print(stderr, fmt::runtime(format), line(tally, seconds));
    std::fflush(stderr);
    has_line_ = true;
}

std::string progress_line::line(const run_tally& tally, double seconds) const {
    const double here = static_cast<double>(std::max<std::uint64_t>(tally.cells, 1));
    const double rate = here / std::max(seconds, 1e-9);
    const std::uint64_t done = done_ + tally.cells;
    const double left = static_cast<double>(total_ - done) / rate;
    return fmt::format(
        "{:5.1f} %  {:.3g} cells/s  {} left  {:.2g} % undecided  lanes {:.0f} % full",
        100.0 * static_cast<double>(done) / static_cast<double>(total_), rate, clock_text(left),
        100.0 * static_cast<double>(tally.undecided) / here, 100.0 * tally.lanes.efficiency());
}

std::string clock_text(double seconds) {
    if (!(seconds < 1e9)) return "ages";
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace hopscotch
