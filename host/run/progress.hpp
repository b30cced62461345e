// The line that says how far a run is: share done, cells per second, time left, share undecided,
// how full the lanes are. On a terminal it is rewritten in place, elsewhere a new line comes every
// ten seconds.
#pragma once

#include "kernels/ensemble/request.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace hopscotch {

/// What is known of the cells computed so far in this run.
struct run_tally {
    std::uint64_t tiles = 0;
    std::uint64_t cells = 0;
    std::uint64_t undecided = 0;  // spent their budget or met what cannot be decided
    lane_statistics lanes;
    double busy = 0.0;  // seconds that threads have spent on tiles

    run_tally& operator+=(const run_tally& other) {
        tiles += other.tiles;
        cells += other.cells;
        undecided += other.undecided;
        lanes += other.lanes;
        busy += other.busy;
        return *this;
    }
};

class progress_line {
public:
    /// \param total  cells of the map
    /// \param done   cells that an earlier run has finished
    progress_line(std::uint64_t total, std::uint64_t done, bool is_quiet);
    ~progress_line();
    progress_line(const progress_line&) = delete;
    progress_line& operator=(const progress_line&) = delete;

    /// From one thread at a time.
    void show(const run_tally& tally);

private:
    std::string line(const run_tally& tally, double seconds) const;

    std::uint64_t total_;
    std::uint64_t done_;
    bool is_quiet_;
    bool is_terminal_;
    bool has_line_ = false;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point next_;
};

/// "1:02:03", "4:05".
std::string clock_text(double seconds);

}  // namespace hopscotch
