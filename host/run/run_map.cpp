// The run of a map.
#include "host/run/run_map.hpp"

#include "host/refine/refinement.hpp"
#include "host/run/attributes.hpp"
#include "host/run/device_error.hpp"
#include "host/run/open_cells.hpp"
#include "host/run/orbit_diagram.hpp"
#include "host/run/plan_digest.hpp"
#include "host/run/plan_tables.hpp"
#include "host/run/requests.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/thread_limit.hpp"
#include "host/run/tile_pipeline.hpp"
#include "host/run/tiles.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/questions.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>

namespace hopscotch {
namespace {

void set_shares(std::vector<attractor_row>& attractors, const value_counts& labels,
                std::uint64_t n_cells) {
    for (attractor_row& row : attractors) {
        const auto found = labels.find(row.label);
        const std::uint64_t n = found == labels.end() ? 0 : found->second;
        row.share = static_cast<double>(n) / static_cast<double>(n_cells);
    }
}

attribute_list refinement_attributes(const scene& scene, const run_report& report) {
    const double saved =
        static_cast<double>(report.n_inherited) / static_cast<double>(report.n_cells);
    return {{"refine_levels", fmt::format("{}", scene.refine)},
            {"refine_computed_cells", fmt::format("{}", report.n_cells - report.n_inherited)},
            {"refine_saved_share", fmt::format("{:.17g}", saved)}};
}

std::string conserved_names(const scene& scene, const label_plan& plan) {
    std::string names;
    for (const int column : plan.conserved) {
        if (!names.empty()) names += ' ';
        names += scene.end_section().columns[static_cast<std::size_t>(column)].name;
    }
    return names;
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
    report.gain = gain_of(scene, run);
    if (hooks.finish_layers) hooks.finish_layers(scene, run);
    const bool has_verdicts = !is_orbit_diagram(scene);  // a diagram is checked by its sums
    if (hooks.audit && has_verdicts && scene.accuracy.audit_cells > 0)
        report.audit = hooks.audit(scene, plan, run);
    report.hash = run.hash();
    attribute_list attributes = report.audit;
    if (scene.refine > 0) {
        report.n_inherited = run.counts("level")[refine::inherited_level];
        const attribute_list refined = refinement_attributes(scene, report);
        attributes.insert(attributes.end(), refined.begin(), refined.end());
    }
    if (!report.device_failure.empty()) {
        attributes.emplace_back("backend", report.backend);
        attributes.emplace_back("device_failure", report.device_failure);
    }
    if (!plan.searched.empty()) attributes.emplace_back(searched_cells, text_of(plan.searched));
    if (!plan.conserved.empty()) {
        attributes.emplace_back("conserved_columns", conserved_names(scene, plan));
    }
    if (report.gain.n_labelled > 0) attributes.emplace_back("trap_gain", text_of(report.gain));
    map_summary summary{attributes, report.attractors, plan.point_columns, {}};
    if (auto traps = tables_of(scene, plan)) summary.groups.push_back(std::move(*traps));
    run.finish(summary);
    report.is_finished = true;
}

/// Name under which a plan is kept: that of the first search, or of a second one from open cells.
const char* kept_plan_of(std::span<const std::uint64_t> searched) {
    return searched.empty() ? kept_plan : "second_plan";
}

/// The kernel that every process of a run computes with. A diagram's calls are too small for a
/// device.
kernel_in_use run_kernel(const scene& scene, const run_choices& choices, const run_hooks& hooks) {
    if (is_orbit_diagram(scene)) return kernel_in_use(kernel_of(scene, choices.backend));
    return hooks.kernel ? hooks.kernel(scene) : map_kernel_of(scene, choices.backend);
}

/// Name under which is kept that the rounds of refinement have begun.
constexpr const char* kept_refining = "refining";

/// Name under which a helper keeps what the device has said that it has lost.
constexpr const char* kept_lost_device = "lost_device";

/// A tile's first computation: whole, or its part of the coarse grid.
tile_result compute_first(const tile_job& job, const tile_box& box) {
    return job.what.refine > 0 ? refine::compute_coarse(job, box) : compute_tile(job, box);
}

/// One run by a team, seen from one rank. The members are called in the order they stand here.
class team_run {
public:
    team_run(const scene& scene, const run_choices& choices, const run_hooks& hooks, team& ranks)
        : scene_(scene),
          choices_(choices),
          hooks_(hooks),
          ranks_(ranks),
          stop_(choices.walltime),
          kernel_(run_kernel(scene, choices, hooks)),
          layout_(layout_of(scene)),
          layers_(chosen_layers(scene)),
          n_threads_(choices.n_threads > 0 ? choices.n_threads : ranks.default_threads()),
          threads_(n_threads_, choices.n_at_once) {
        report_.file = choices.file.empty() ? scene.output.file : choices.file;
        report_.backend = kernel_.backends();
        report_.n_cells = layout_.n_cells();
        report_.n_tiles = choices.part.n_tiles(layout_.n_tiles());
        report_.n_ranks = ranks.size();
    }

    run_report run() {
        open();
        if (report_.is_finished) return report_;
        make_plan();
        if (!compute_missing()) return report_;
        report_.is_part_done = !choices_.part.is_whole();
        if (report_.is_part_done) return report_;
        if (!compute(search_again())) return report_;
        if (!refine()) return report_;
        finish();
        return report_;
    }

private:
    std::vector<std::uint64_t> shape() const {
        std::vector<std::uint64_t> cells;
        for (const axis& along : layout_.axes) cells.push_back(along.size());
        return cells;
    }

    /// Rank 0 checks what is there, the others then join it.
    void open() {
        require_one_scene();
        ranks_.together([&] {
            if (!ranks_.is_first()) return;
            open_as(run_role::owner);
            if (choices_.is_merge) run_->require_all_tiles();
        });
        missing_ = ranks_.from_first(run_ ? run_->missing_tiles() : missing_);
        searched_ = ranks_.from_first(run_ ? cells_of(run_->kept(searched_cells)) : searched_);
        report_.is_finished = ranks_.from_first({run_ && run_->complete() ? 1U : 0U})[0] == 1;
        if (report_.is_finished) return;
        ranks_.together([&] {
            if (!ranks_.is_first()) open_as(run_role::helper);
        });
        for (const double each : ranks_.from_all(n_threads_)) n_all_threads_ += each;
        report_.n_threads = static_cast<int>(n_all_threads_);
    }

    void require_one_scene() {
        const std::string other =
            ranks_.who_differs(scene_.fingerprint + " " + report_.file.string());
        ranks_.together([&] {
            if (other.empty()) return;
            throw scene_error({scene_.file, other, "", "it was given another scene or map file",
                               "the same command on every rank"});
        });
    }

    void open_as(run_role role) {
        run_.emplace(layout_, run_options{.map = report_.file,
                                          .fingerprint = scene_.fingerprint,
                                          .attributes = attributes_of(scene_, kernel_.first()),
                                          .existing = choices_.existing,
                                          .role = role,
                                          .part = choices_.part,
                                          .adopted = choices_.adopted,
                                          .keeps_tiles = choices_.keeps_tiles});
        report_.notes = run_->notes();
    }

    void make_plan() {
        if (!hooks_.plan || !has_plan(scene_)) return;
        ranks_.together([&] { plan_ = hooks_.plan(scene_, searched_); });
        require_one_plan();
    }

    /// The search for attractors is deterministic, but the C library's functions are not the same
    /// on every processor: ranks with different plans would give a map that no single machine does.
    void require_one_plan() {
        const std::string digest = plan_digest(plan_);
        const std::string strangers = ranks_.who_differs(digest);
        ranks_.together([&] {
            if (!strangers.empty()) {
                throw device_error(strangers +
                                   " (found other attractors than rank 0: another kind of "
                                   "processor); nodes of one kind?");
            }
            if (ranks_.is_first()) keep_plan(digest);
        });
    }

    /// The same for shards and for runs that were begun elsewhere or by another version.
    void keep_plan(const std::string& digest) {
        const char* name = kept_plan_of(plan_.searched);
        const std::string before = run_->kept(name);
        if (before.empty()) return run_->keep(name, digest);
        if (before == digest) return;
        throw store_error(map_run::directory_of(report_.file).string(),
                          "begun with other attractors, by another version or on another kind of "
                          "processor",
                          "go on there, or begin anew with --force");
    }

    tile_job job() { return {scene_, plan_, layout_, layers_, kernel_}; }

    /// Cells that the first pass computes in a tile.
    std::uint64_t n_cells_of(std::uint64_t tile) const {
        return refine::coarse_cells_in(box_of(layout_, tile), scene_.refine);
    }

    /// Computes the tiles that are missing; true where none is left.
    bool compute_missing() {
        if (!is_orbit_diagram(scene_)) return compute(missing_);
        const tile_job work = job();
        orbit_diagram diagram(work, *run_, stop_, choices_.part, choices_.backend, missing_);
        return compute(
            missing_, diagram.heads(),
            [&](const tile_box& head, const tile_sink& store) { diagram.compute(head, store); });
    }

    /// Computes tiles, each by itself; true where all of them are done.
    bool compute(const std::vector<std::uint64_t>& tiles) {
        const tile_job work = job();
        return compute(tiles, tiles, [&](const tile_box& box, const tile_sink& store) {
            store(compute_first(work, box));
        });
    }

    /// The rounds after the coarse grid, until one finds no boundary that is not known. A resumed
    /// run goes through all of them again: what is there is not computed twice.
    bool refine() {
        if (scene_.refine == 0) return true;
        ranks_.together([&] {
            if (ranks_.is_first()) run_->keep(kept_refining, "1");
        });
        const tile_job work = job();
        refine::refinement rounds(work, *run_);
        std::vector<std::uint64_t> tiles(layout_.n_tiles());
        std::iota(tiles.begin(), tiles.end(), std::uint64_t{0});
        for (int round = 1; !tiles.empty(); round += round <= scene_.refine ? 1 : 0) {
            std::vector<std::uint64_t> changed;
            std::mutex mutex;
            const auto work_on = [&](const tile_box& box, const tile_sink& store) {
                std::optional<tile_result> found = rounds.compute(box, round);
                if (found) found->seconds += run_->seconds(box.index);
                store(found);
                const std::lock_guard guard(mutex);
                if (found) changed.push_back(box.index);
            };
            const bool is_done = compute(tiles, tiles, work_on);
            if (!is_done) return false;
            double n_changed = 0.0;
            for (const double each : ranks_.from_all(static_cast<double>(changed.size()))) {
                n_changed += each;
            }
            if (ranks_.size() > 1) rounds.forget_all();
            rounds.forget(changed);
            if (round <= scene_.refine) continue;
            // the last round is gone through until nothing changes
            if (n_changed == 0.0) return true;
            if (ranks_.size() == 1) tiles = refine::with_neighbours(layout_, changed);
        }
        return true;
    }

    /// A pass over tiles; true where all of them are done.
    /// \param drawn  those that stand for a piece of work in the queue: all, or one of several that
    ///               are computed together
    bool compute(const std::vector<std::uint64_t>& tiles, const std::vector<std::uint64_t>& drawn,
                 const tile_work& work) {
        std::uint64_t n_wanted = 0;
        for (const std::uint64_t tile : tiles) n_wanted += n_cells_of(tile);
        const tile_box whole{0, std::vector<std::uint64_t>(layout_.axes.size(), 0), shape()};
        const std::uint64_t n_all = refine::coarse_cells_in(whole, scene_.refine);
        const bool is_round = n_passes_++ > 0 && scene_.refine > 0;  // nobody knows how many
        progress_line line(n_all, n_all - std::min(n_wanted, n_all),
                           choices_.is_quiet || is_round || !ranks_.is_first());
        const auto queue =
            ranks_.open_queue(drawn, [&](const run_tally& tally) { line.show(tally); });
        const double begin = stop_.elapsed();
        double end = begin;
        ranks_.together([&] {
            compute_tiles(job(), work, *queue, *run_, stop_, n_threads_);
            end = stop_.elapsed();
        });
        const run_tally total = queue->close();
        report_.idle_at_end = idle_share(ranks_.from_all(end - begin));
        report_.tally += total;
        report_.seconds += stop_.elapsed() - begin;
        report_.n_missing = tiles.size() - total.tiles;
        tell_failed_devices();
        ranks_.together([&] {
            if (ranks_.is_first() && ranks_.has_helpers()) run_->rescan(tiles);
        });
        return report_.n_missing == 0;
    }

    /// A rank whose device has failed goes on with its processor. The bits are the same, but the
    /// map says so.
    void tell_failed_devices() {
        const std::string failure = kernel_.failure();
        double n_failed = 0.0;
        for (const double each : ranks_.from_all(failure.empty() ? 0.0 : 1.0)) n_failed += each;
        const std::string of_helper = run_->kept(kept_lost_device);
        if (n_failed == 0.0 && of_helper.empty()) return;
        if (!report_.device_failure.empty()) return;
        report_.backend = kernel_.backends();
        report_.device_failure = failure;
        if (failure.empty()) {
            report_.device_failure = of_helper.empty()
                                         ? fmt::format("of {} ranks other than the first", n_failed)
                                         : of_helper;
        }
        report_.notes.push_back(
            fmt::format("the device failed ({}): computed on by {}", report_.device_failure,
                        failure.empty() ? "the processor or other devices" : kernel_.successor()));
    }

    /// Searches for attractors from the cells that the first pass has left without a label. Returns
    /// the tiles to compute once more: those with such cells, if new attractors were found.
    std::vector<std::uint64_t> search_again() {
        if (!hooks_.plan || plan_.decided_by != decision::ellipsoids || plan_.of_cell) return {};
        std::vector<std::uint64_t> is_refining;  // then the coarse grid has been searched
        if (ranks_.is_first()) is_refining = {run_->kept(kept_refining).empty() ? 0U : 1U};
        if (ranks_.from_first(is_refining)[0] == 1) return {};
        open_cells open;
        ranks_.together([&] {
            if (ranks_.is_first()) open = find_open_cells(scene_, *run_);
        });
        open.sample = ranks_.from_first(std::move(open.sample));
        open.tiles = ranks_.from_first(std::move(open.tiles));
        if (open.sample.empty()) return {};
        if (!plan_.searched.empty()) return open.tiles;  // resumed: some may be done already
        label_plan more;
        ranks_.together([&] { more = hooks_.plan(scene_, open.sample); });
        if (more.attractors.size() == plan_.attractors.size()) return {};
        plan_ = std::move(more);
        require_one_plan();
        ranks_.together([&] {
            if (ranks_.is_first()) run_->keep(searched_cells, text_of(open.sample));
        });
        return open.tiles;
    }

    void finish() {
        ranks_.together([&] {
            if (!ranks_.is_first()) return;
            try {
                finish_map(scene_, plan_, hooks_, *run_, report_);
            } catch (const interruption&) {
                // all tiles are there: a resumed run only audits and packs
            }
        });
        report_.is_finished = ranks_.from_first({report_.is_finished ? 1U : 0U})[0] == 1;
    }

    const scene& scene_;
    const run_choices& choices_;
    const run_hooks& hooks_;
    team& ranks_;
    stop_condition stop_;
    kernel_in_use kernel_;
    map_layout layout_;
    std::vector<layer_plan> layers_;
    int n_threads_;
    thread_limit threads_;
    double n_all_threads_ = 0.0;
    std::optional<map_run> run_;
    std::vector<std::uint64_t> missing_;
    std::vector<std::uint64_t> searched_;
    label_plan plan_;
    int n_passes_ = 0;
    run_report report_;
};

}  // namespace

run_report run_map(const scene& scene, const run_choices& choices, const run_hooks& hooks,
                   team& ranks) {
    check_is_map(scene);
    std::optional<team_run> run;
    ranks.together([&] { run.emplace(scene, choices, hooks, ranks); });
    return run->run();
}

run_report run_map(const scene& scene, const run_choices& choices, const run_hooks& hooks) {
    team_of_one alone;
    return run_map(scene, choices, hooks, alone);
}

void help_with_map(const scene& scene, const run_choices& choices, const run_hooks& hooks,
                   tile_queue& queue) {
    const stop_condition stop(choices.walltime);
    kernel_in_use kernel = run_kernel(scene, choices, hooks);
    const map_layout layout = layout_of(scene);
    const std::vector<layer_plan> layers = chosen_layers(scene);
    map_run run(layout, run_options{.map = choices.file,
                                    .fingerprint = scene.fingerprint,
                                    .attributes = {},
                                    .role = run_role::helper});
    const std::vector<std::uint64_t> missing = run.missing_tiles();
    const std::vector<std::uint64_t> searched = cells_of(run.kept(searched_cells));
    label_plan plan;
    if (hooks.plan && has_plan(scene)) {
        plan = hooks.plan(scene, searched);
        if (run.kept(kept_plan_of(searched)) != plan_digest(plan)) {
            throw device_error(choices.file.string() +
                               " (its owner has found other attractors: another kind of "
                               "processor); nodes of one kind?");
        }
    }
    const tile_job job{scene, plan, layout, layers, kernel};
    const tile_work work = [&](const tile_box& box, const tile_sink& store) {
        if (!std::binary_search(missing.begin(), missing.end(), box.index)) {
            return store(std::nullopt);
        }
        const tile_result result = compute_first(job, box);
        if (!kernel.failure().empty()) run.keep(kept_lost_device, kernel.failure());
        store(result);
    };
    compute_tiles(job, work, queue, run, stop, choices.n_threads);
}

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
    if (is_orbit_diagram(scene)) check_diagram(scene);
    if (scene.accuracy.precision != "double") {
        throw scene_error(
            {scene.accuracy.place, "accuracy.precision", "\"" + scene.accuracy.precision + "\"",
             "maps are computed in double and audited in higher precision", "\"double\""});
    }
}

}  // namespace hopscotch
