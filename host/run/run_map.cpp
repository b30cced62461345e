// The run of a map.
#include "host/run/run_map.hpp"

#include "host/run/attributes.hpp"
#include "host/run/open_cells.hpp"
#include "host/run/orbit_diagram.hpp"
#include "host/run/requests.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/tiles.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/questions.hpp"

#include <algorithm>
#include <atomic>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace hopscotch {
namespace {

struct finished_tile {
    compressed_tile tile;
    lane_statistics lanes;
};

/// Compute and compress in parallel, write one at a time; no more than two tiles per thread in
/// flight.
class tile_pipeline {
public:
    tile_pipeline(const tile_job& job, std::vector<std::uint64_t> tiles, map_run& run,
                  const stop_condition& stop, int n_threads, bool is_quiet)
        : job_(job),
          run_(run),
          stop_(stop),
          n_threads_(n_threads),
          tiles_(std::move(tiles)),
          progress_(job.layout.n_cells(), cells_done(), is_quiet) {}

    run_tally compute() {
        const auto n_threads = static_cast<std::size_t>(n_threads_);
        tbb::task_arena arena(n_threads_);
        arena.execute([&] {
            using tbb::filter_mode;
            tbb::parallel_pipeline(
                2 * n_threads,
                tbb::make_filter<void, std::uint64_t>(
                    filter_mode::serial_in_order,
                    [&](tbb::flow_control& flow) { return next(flow); }) &
                    tbb::make_filter<std::uint64_t, finished_tile>(
                        filter_mode::parallel, [&](std::uint64_t tile) { return finish(tile); }) &
                    tbb::make_filter<finished_tile, void>(
                        filter_mode::serial_out_of_order,
                        [&](const finished_tile& tile) { write(tile); }));
        });
        return tally_;
    }

    /// Tiles that were not reached before the run had to stop.
    std::size_t n_left() const { return tiles_.size() - next_; }

private:
    std::uint64_t cells_done() const {
        std::uint64_t wanted = 0;
        for (const std::uint64_t tile : tiles_) wanted += box_of(job_.layout, tile).n_cells();
        return job_.layout.n_cells() - wanted;
    }

    std::uint64_t next(tbb::flow_control& flow) {
        if (next_ < tiles_.size() && !stop_.is_due(1.5 * slowest_)) return tiles_[next_++];
        flow.stop();
        return 0;
    }

    finished_tile finish(std::uint64_t index) {
        const tile_result result = compute_tile(job_, box_of(job_.layout, index));
        const int level = job_.what.output.compression;
        return {compress(job_.layout, result.data, level, result.seconds), result.lanes};
    }

    void write(const finished_tile& finished) {
        run_.put(finished.tile);
        const tile_summary& summary = finished.tile.summary;
        if (summary.seconds > slowest_) slowest_ = summary.seconds;
        tally_.cells += finished.tile.box.n_cells();
        tally_.lanes += finished.lanes;
        for (std::size_t i = 0; i < job_.layers.size(); ++i) {
            if (job_.layers[i].role != layer_role::outcome) continue;
            for (const auto& [code, n] : summary.counts[i]) {
                if (is_undecided(job_.what, code)) tally_.undecided += n;
            }
        }
        progress_.show(tally_);
    }

    const tile_job& job_;
    map_run& run_;
    const stop_condition& stop_;
    int n_threads_;
    std::vector<std::uint64_t> tiles_;
    std::size_t next_ = 0;
    std::atomic<double> slowest_ = 0.0;  // seconds of the slowest tile so far
    run_tally tally_;
    progress_line progress_;
};

void set_shares(std::vector<attractor_row>& attractors, const value_counts& labels,
                std::uint64_t n_cells) {
    for (attractor_row& row : attractors) {
        const auto found = labels.find(row.label);
        const std::uint64_t n = found == labels.end() ? 0 : found->second;
        row.share = static_cast<double>(n) / static_cast<double>(n_cells);
    }
}

/// Searches for attractors from the cells that the first pass has left without a label. Returns the
/// tiles to compute once more: those with such cells, if new attractors were found.
std::vector<std::uint64_t> search_again(const scene& scene, const run_hooks& hooks, map_run& run,
                                        label_plan& plan) {
    const open_cells open = find_open_cells(scene, run);
    if (open.sample.empty()) return {};
    if (!plan.searched.empty()) return open.tiles;  // a resumed run: some may be done already
    label_plan more = hooks.plan(scene, open.sample);
    if (more.attractors.size() == plan.attractors.size()) return {};
    run.keep(searched_cells, text_of(open.sample));
    plan = std::move(more);
    return open.tiles;
}

void finish_map(const scene& scene, const label_plan& plan, const run_hooks& hooks, map_run& run,
                run_report& report) {
    if (scene.question.has_labels) report.labels = run.counts("label");
    if (is_chaos_map(scene)) report.motions = run.counts("motion");
    report.outcomes = run.counts("outcome");
    report.attractors = plan.attractors;
    set_shares(report.attractors, report.labels, report.n_cells);
    if (plan.decided_by == decision::ellipsoids) {  // labels held ready that no cell has needed
        std::erase_if(report.attractors, [](const attractor_row& row) {
            return row.points.empty() && row.share == 0.0;
        });
    }
    if (hooks.audit && scene.accuracy.audit_cells > 0) report.audit = hooks.audit(scene, plan, run);
    report.hash = run.hash();
    attribute_list attributes = report.audit;
    if (!plan.searched.empty()) attributes.emplace_back(searched_cells, text_of(plan.searched));
    run.finish({attributes, report.attractors, plan.point_columns});
    report.is_finished = true;
}

}  // namespace

run_report run_map(const scene& scene, const run_choices& choices, const run_hooks& hooks) {
    check_is_map(scene);
    if (is_orbit_diagram(scene)) return run_diagram(scene, choices);
    const stop_condition stop(choices.walltime);
    const kernel_choice kernel = kernel_of(scene, choices.backend);
    const map_layout layout = layout_of(scene);
    run_report report;
    report.file = choices.file.empty() ? scene.output.file : choices.file;
    report.backend = name_of(kernel.which);
    report.n_cells = layout.n_cells();
    report.n_tiles = layout.n_tiles();
    map_run run(layout, {.map = report.file,
                         .fingerprint = scene.fingerprint,
                         .attributes = attributes_of(scene, kernel),
                         .existing = choices.existing});
    report.notes = run.notes();
    report.is_finished = run.complete();
    if (report.is_finished) return report;

    label_plan plan;
    if (hooks.plan && scene.question.has_labels) {
        plan = hooks.plan(scene, cells_of(run.kept(searched_cells)));
    }
    const std::vector<layer_plan> layers = chosen_layers(scene);
    const tile_job job{scene, plan, layout, layers, kernel};
    const double begin = stop.elapsed();
    const int n_threads = threads_for(choices.n_threads);
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(n_threads));
    const auto compute = [&](std::vector<std::uint64_t> tiles) {
        tile_pipeline pipeline(job, std::move(tiles), run, stop, n_threads, choices.is_quiet);
        const run_tally tally = pipeline.compute();
        report.tally.cells += tally.cells;
        report.tally.undecided += tally.undecided;
        report.tally.lanes += tally.lanes;
        report.seconds = stop.elapsed() - begin;
        report.n_missing = pipeline.n_left();
        return report.n_missing == 0;
    };
    if (!compute(run.missing_tiles())) return report;
    if (hooks.plan && plan.decided_by == decision::ellipsoids && !plan.of_cell) {
        const std::vector<std::uint64_t> open_tiles = search_again(scene, hooks, run, plan);
        if (!compute(open_tiles)) return report;
    }
    try {
        finish_map(scene, plan, hooks, run, report);
    } catch (const interruption&) {
        report.is_finished = false;  // all tiles are there: a resumed run only audits and packs
    }
    return report;
}

int threads_for(int wanted) { return wanted > 0 ? wanted : tbb::info::default_concurrency(); }

bool is_undecided(const scene& scene, int outcome_code) {
    switch (static_cast<outcome>(outcome_code)) {
        case outcome::budget:
        case outcome::not_finite:
        case outcome::unresolved_event:
            return true;
        case outcome::ok:
            return scene.question.has_labels;
        default:
            return false;
    }
}

void check_is_map(const scene& scene) {
    const question_kind* kind = find_question(scene.question.kind);
    if (!kind->is_map) {
        throw scene_error({scene.question.place, "question.kind", "\"" + scene.question.kind + "\"",
                           "not computed as a map in this version", "\"basins\""});
    }
    if (scene.accuracy.precision != "double") {
        throw scene_error(
            {scene.accuracy.place, "accuracy.precision", "\"" + scene.accuracy.precision + "\"",
             "maps are computed in double and audited in higher precision", "\"double\""});
    }
}

}  // namespace hopscotch
