// What the command `run` says of a sweep: text for the user, JSON beside the index.
#include "host/cli/run_sweep.hpp"

#include "host/cli/companion.hpp"
#include "host/cli/shard_argument.hpp"
#include "host/cli/sweep_facts.hpp"
#include "host/cli/text_output.hpp"
#include "host/run/exit_code.hpp"
#include "host/run/json.hpp"
#include "host/run/summary.hpp"
#include "host/store/sweep_index.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// JSON has no NaN.
std::string number_text(double value) {
    return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

std::string text_of(const scene& scene, const sweep_report& report) {
    std::string text = fmt::format("{}\n", scene.title);
    text += fmt::format("index            {}\n", report.file.string());
    text += fmt::format("maps             {} ({} now) in {}\n", report.maps.size(),
                        report.n_computed, report.directory.string());
    text += fmt::format("cells            {} per map ({} now)\n", report.n_cells_per_map,
                        report.tally.cells);
    text += fmt::format("seconds          {:.3f}\n", report.seconds);
    text += fmt::format("lane efficiency  {:.1f} %\n", 100.0 * report.tally.lanes.efficiency());
    text += fmt::format("hash             {}\n", report.hash);
    return text;
}

std::string json_of(const scene& scene, const swept_map& map) {
    std::string text = fmt::format("    {{\"file\": {}, \"point\": {{",
                                   json_text(sweep_map_path("", map.point).string()));
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        text += fmt::format("{}{}: {}", i > 0 ? ", " : "", json_text(scene.sweep.axes[i].name),
                            number_text(map.values[i]));
    }
    text += fmt::format(
        "}}, \"hash\": {}, \"seconds\": {}, \"undecided\": {}, \"entropy\": {}, "
        "\"basins\": [",
        json_text(map.hash), number_text(map.seconds), number_text(map.facts.undecided),
        number_text(map.facts.entropy));
    bool is_first = true;
    for (const basin_fact& fact : map.facts.basins) {
        text += fmt::format("{}{{\"value\": {}, \"name\": {}, \"share\": {}, \"error\": {}}}",
                            is_first ? "" : ", ", fact.value, json_text(fact.name),
                            number_text(fact.share), number_text(fact.error));
        is_first = false;
    }
    return text + "]}";
}

std::string json_of(const scene& scene, const sweep_report& report) {
    std::string text = "{\n";
    const auto add = [&](std::string_view name, const std::string& value) {
        text += fmt::format("  {}: {},\n", json_text(name), value);
    };
    add("title", json_text(scene.title));
    add("model", json_text(scene.info().name));
    add("question", json_text(scene.question.kind));
    add("index", json_text(report.file.filename().string()));
    add("fingerprint", json_text(scene.fingerprint));
    add("hash", json_text(report.hash));
    add("maps_computed", fmt::format("{}", report.n_computed));
    add("cells_per_map", fmt::format("{}", report.n_cells_per_map));
    add("cells_computed", fmt::format("{}", report.tally.cells));
    add("idle_at_end", fmt::format("{:.17g}", report.idle_at_end));
    add("tiles_helped", fmt::format("{}", report.n_helped));
    add("seconds", fmt::format("{:.17g}", report.seconds));
    text += "  \"maps\": [";
    for (std::size_t i = 0; i < report.maps.size(); ++i) {
        text += (i > 0 ? ",\n" : "\n") + json_of(scene, report.maps[i]);
    }
    return text + "\n  ]\n}\n";
}

int interrupted(const sweep_report& report) {
    fmt::print(
        stderr,
        "hopscotch: {} ({} of {} maps are done, none is lost); the same command with --resume?\n",
        report.file.string(), report.maps.size() - report.n_missing, report.maps.size());
    return exit_resumable;
}

}  // namespace

int run_and_tell_sweep(const scene& sweep, const run_choices& choices, bool is_dry, team& ranks) {
    const sweep_hooks hooks = hooks_of_sweep();
    if (is_dry) {
        if (ranks.is_first())
            fmt::print("{}", text_of(sweep, estimate_sweep(sweep, choices, hooks)));
        return exit_done;
    }
    const sweep_report report = run_sweep(sweep, choices, hooks, ranks);
    if (!ranks.is_first()) return report.is_finished ? exit_done : exit_resumable;
    for (const std::string& note : report.notes) fmt::print(stderr, "hopscotch: {}\n", note);
    if (!report.is_finished) return interrupted(report);
    if (report.is_part_done) {
        fmt::print(
            "shard {} of {}: its maps are there; when the others' are too, the same command "
            "with --resume and without --shard completes the index\n",
            text_of(choices.part), report.file.string());
        return exit_done;
    }
    fmt::print("{}", text_of(sweep, report));
    const std::filesystem::path summary = companion(report.file, ".json");
    put_text(summary.string(), json_of(sweep, report));
    fmt::print("summary          {}\n", summary.string());
    return exit_done;
}

}  // namespace hopscotch
