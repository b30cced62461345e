// The pipeline of tiles.
#include "host/run/tile_pipeline.hpp"

#include "host/run/run_map.hpp"
#include "host/store/compressed_tile.hpp"

#include <atomic>
#include <optional>

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace hopscotch {
namespace {

struct finished_tile {
    std::optional<compressed_tile> tile;  // nothing where it stays as it was
    lane_statistics lanes;
    std::uint64_t n_computed = 0;
};

class tile_pipeline {
public:
    tile_pipeline(const tile_job& job, const tile_work& work, tile_queue& queue, map_run& run,
                  const stop_condition& stop)
        : job_(job), work_(work), queue_(queue), run_(run), stop_(stop) {}

    void compute(int n_threads) {
        using tbb::filter_mode;
        tbb::parallel_pipeline(
            2 * static_cast<std::size_t>(n_threads),
            tbb::make_filter<void, std::uint64_t>(
                filter_mode::serial_in_order, [&](tbb::flow_control& flow) { return next(flow); }) &
                tbb::make_filter<std::uint64_t, finished_tile>(
                    filter_mode::parallel, [&](std::uint64_t tile) { return finish(tile); }) &
                tbb::make_filter<finished_tile, void>(
                    filter_mode::serial_out_of_order,
                    [&](const finished_tile& tile) { write(tile); }));
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

    finished_tile finish(std::uint64_t index) {
        const std::optional<tile_result> result = work_(box_of(job_.layout, index));
        if (!result) return {};
        const int level = job_.what.output.compression;
        return {compress(job_.layout, result->data, level, result->seconds), result->lanes,
                result->n_computed};
    }

    void write(const finished_tile& finished) {
        if (!finished.tile) {
            run_tally unchanged;
            unchanged.tiles = 1;
            return queue_.count(unchanged);
        }
        run_.put(*finished.tile);
        const tile_summary& summary = finished.tile->summary;
        if (summary.seconds > slowest_) slowest_ = summary.seconds;
        run_tally tally{1, finished.n_computed, 0, finished.lanes, summary.seconds};
        for (std::size_t i = 0; i < job_.layers.size(); ++i) {
            if (job_.layers[i].role != layer_role::outcome) continue;
            for (const auto& [code, n] : summary.counts[i]) {
                if (is_undecided(job_.what, code)) tally.undecided += n;
            }
        }
        queue_.count(tally);
    }

    const tile_job& job_;
    const tile_work& work_;
    tile_queue& queue_;
    map_run& run_;
    const stop_condition& stop_;
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
