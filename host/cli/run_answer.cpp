// Runs, then prints.
#include "host/cli/run_answer.hpp"

#include "analysis/labels/plan.hpp"
#include "analysis/metrics/failing_layer.hpp"
#include "analysis/render/render.hpp"
#include "host/cli/companion.hpp"
#include "host/cli/shard_argument.hpp"
#include "host/cli/side_files.hpp"
#include "host/cli/text_output.hpp"
#include "host/run/audit.hpp"
#include "host/run/exit_code.hpp"
#include "host/run/summary.hpp"

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// The picture is a courtesy: without it the run is still done.
void write_picture(const run_report& report) {
    const std::filesystem::path picture = companion(report.file, ".png");
    try {
        render_map(report.file, picture);
        fmt::print("picture          {}\n", picture.string());
    } catch (const std::exception& error) {
        fmt::print(stderr, "hopscotch: no picture: {}\n", error.what());
    }
}

int finish(const scene& scene, const run_report& report) {
    if (report.n_tiles > 0 && report.hash.empty()) {
        fmt::print("{} is finished already\n", report.file.string());
        return exit_done;
    }
    fmt::print("{}", text_of(scene, report));
    const std::filesystem::path summary = companion(report.file, ".json");
    put_text(summary.string(), json_of(scene, report));
    fmt::print("summary          {}\n", summary.string());
    write_picture(report);
    if (scene.question.kind == "one_sided") fmt::print("{}", write_sides(report.file));
    return exit_done;
}

int interrupted(const run_report& report) {
    fmt::print(
        stderr,
        "hopscotch: {} ({} of {} tiles are done, none is lost); the same command with --resume?\n",
        report.file.string(), report.n_tiles - report.n_missing, report.n_tiles);
    return exit_resumable;
}

/// A shard packs nothing: its tiles wait for the others'.
int part_done(const run_report& report, const shard& part) {
    fmt::print(
        "shard {} of {}: all of its {} tiles are there; when the others' are too: hopscotch "
        "merge {}\n",
        text_of(part), report.file.string(), report.n_tiles, report.file.string());
    return exit_done;
}

}  // namespace

run_hooks hooks_of(const scene& scene, const std::filesystem::path& file) {
    run_hooks hooks;
    hooks.plan = plan_labels;
    if (metrics::wants_failing_distance(scene)) {
        hooks.finish_layers = metrics::fill_failing_distances;
    }
    if (scene.model->orbits_table == nullptr) return hooks;
    hooks.audit = [file](const struct scene& what, const label_plan& plan, const map_run& run) {
        const audit_report report = audit(
            what, plan, [&](std::uint64_t tile) { return run.read(tile); },
            what.accuracy.audit_cells);
        return attributes_of(what, report, file);
    };
    return hooks;
}

int run_and_tell(const scene& scene, const run_choices& choices, team& ranks) {
    const std::filesystem::path file = choices.file.empty() ? scene.output.file : choices.file;
    const run_report report = run_map(scene, choices, hooks_of(scene, file), ranks);
    if (!ranks.is_first()) {
        return report.is_finished || report.is_part_done ? exit_done : exit_resumable;
    }
    for (const std::string& note : report.notes) fmt::print(stderr, "hopscotch: {}\n", note);
    if (report.is_finished) return finish(scene, report);
    return report.is_part_done ? part_done(report, choices.part) : interrupted(report);
}

}  // namespace hopscotch
