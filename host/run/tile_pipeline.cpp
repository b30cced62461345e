// The pipeline of tiles.
#include "host/run/tile_pipeline.hpp"

#include "host/run/run_map.hpp"
#include "host/store/compressed_tile.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace hopscotch {
namespace {

class tile_pipeline {
public:
    tile_pipeline(const tile_job& job, const tile_work& work, tile_queue& queue, map_run& run,
                  const stop_condition& stop)
        : job_(job), work_(work), queue_(queue), run_(run), stop_(stop) {}

    void compute(int n_threads) {
        using tbb::filter_mode;
        const tile_sink store = [&](const std::optional<tile_result>& result) { finish(result); };
        tbb::parallel_pipeline(
            static_cast<std::size_t>(n_threads),
            tbb::make_filter<void, std::uint64_t>(
                filter_mode::serial_in_order, [&](tbb::flow_control& flow) { return next(flow); }) &
                tbb::make_filter<std::uint64_t, void>(
                    filter_mode::parallel,
                    [&](std::uint64_t tile) { work_(box_of(job_.layout, tile), store); }));
    }

private:
    std::uint64_t next(tbb::flow_control& flow) {
        if (stop_condition::is_interrupted()) queue_.halt();
        if (!stop_.is_due(1.5 * slowest_)) {
            if (const std::optional<std::uint64_t> tile = queue_.next()) return *tile;
        }
        flow.stop();
        return 0;
    }

    void finish(const std::optional<tile_result>& result) {
        run_tally tally;
        tally.tiles = 1;
        if (result) tally = write(*result);
        const std::lock_guard guard(counting_);
        slowest_ = std::max(slowest_.load(), tally.busy);
        queue_.count(tally);
    }

    run_tally write(const tile_result& result) {
        const int level = job_.what.output.compression;
        const compressed_tile tile = compress(job_.layout, result.data, level, result.seconds);
        run_.put(tile);
        const tile_summary& summary = tile.summary;
        run_tally tally{1, result.n_computed, 0, result.lanes, summary.seconds};
        for (std::size_t i = 0; i < job_.layers.size(); ++i) {
            if (job_.layers[i].role != layer_role::outcome) continue;
            for (const auto& [code, n] : summary.counts[i]) {
                if (is_undecided(job_.what, code)) tally.undecided += n;
            }
        }
        return tally;
    }

    const tile_job& job_;
    const tile_work& work_;
    tile_queue& queue_;
    map_run& run_;
    const stop_condition& stop_;
    std::mutex counting_;
    std::atomic<double> slowest_ = 0.0;  // seconds of the slowest tile so far
};

}  // namespace

void compute_tiles(const tile_job& job, const tile_work& work, tile_queue& queue, map_run& run,
                   const stop_condition& stop, int n_threads) {
    tile_pipeline pipeline(job, work, queue, run, stop);
    tbb::task_arena arena(n_threads);
    try {
        arena.execute([&] { pipeline.compute(n_threads); });
    } catch (...) {
        queue.halt();
        throw;
    }
}

}  // namespace hopscotch
