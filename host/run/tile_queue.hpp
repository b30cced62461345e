// The order in which the processes of a run draw tiles, and the counts of what they have computed.
// One queue serves one pass over tiles; every thread and every rank draws from it, so that costly
// tiles balance.
#pragma once

#include "host/run/progress.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace hopscotch {

class tile_queue {
public:
    virtual ~tile_queue() = default;

    /// The next tile; none when all are drawn or the queue was halted. From one thread at a time.
    virtual std::optional<std::uint64_t> next() = 0;

    /// A tile is finished and safe. From one thread at a time.
    virtual void count(const run_tally& of_tile) = 0;

    /// Nobody draws another tile; tiles in flight are finished.
    virtual void halt() = 0;

    /// What all have computed. Collective: waits until every rank has come here.
    virtual run_tally close() = 0;
};

/// Shows how far a pass is, given what all have computed so far.
using progress_display = std::function<void(const run_tally&)>;

/// The queue of one process.
class local_queue : public tile_queue {
public:
    local_queue(std::vector<std::uint64_t> tiles, progress_display show);
    std::optional<std::uint64_t> next() override;
    void count(const run_tally& of_tile) override;
    void halt() override;
    run_tally close() override;

private:
    std::vector<std::uint64_t> tiles_;
    std::size_t next_ = 0;
    progress_display show_;
    run_tally total_;
};

}  // namespace hopscotch
