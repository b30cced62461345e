// Text and JSON of a run.
#include "host/run/summary.hpp"

#include "host/run/json.hpp"
#include "kernels/contract/motion.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

namespace hopscotch {
namespace {

struct share_row {
    int value;
    std::string name;
    std::uint64_t cells;
    double share;
};

std::string name_of_label(const std::vector<attractor_row>& attractors, int label) {
    for (const attractor_row& row : attractors) {
        if (row.label == label) return row.name;
    }
    return label == 0 ? "none" : "label " + std::to_string(label);
}

std::vector<share_row> label_shares(const run_report& report) {
    std::vector<share_row> rows;
    for (const auto& [label, cells] : report.labels) {
        rows.push_back({label, name_of_label(report.attractors, label), cells,
                        static_cast<double>(cells) / static_cast<double>(report.n_cells)});
    }
    return rows;
}

/// Shares of the codes of an enumeration, by their names.
std::vector<share_row> shares_of(const value_counts& counts,
                                 std::span<const std::string_view> names, std::uint64_t n_cells) {
    std::vector<share_row> rows;
    for (const auto& [code, cells] : counts) {
        const auto index = static_cast<std::size_t>(code);
        const bool is_known = index < names.size();
        rows.push_back({code, is_known ? std::string(names[index]) : "not computed", cells,
                        static_cast<double>(cells) / static_cast<double>(n_cells)});
    }
    return rows;
}

std::vector<share_row> outcome_shares(const run_report& report) {
    return shares_of(report.outcomes, outcome_names, report.n_cells);
}

std::vector<share_row> motion_shares(const run_report& report) {
    return shares_of(report.motions, motion_names, report.n_cells);
}

void append_shares(std::string& text, std::string_view title, const std::vector<share_row>& rows) {
    if (rows.empty()) return;
    text += fmt::format("{}\n", title);
    for (const share_row& row : rows) {
        text += fmt::format("  {:>4}  {:<24} {:>22.17g}  ({} cells)\n", row.value, row.name,
                            row.share, row.cells);
    }
}

std::string json_shares(const std::vector<share_row>& rows) {
    std::string text = "[";
    for (const share_row& row : rows) {
        text += fmt::format(
            "{}\n    {{\"value\": {}, \"name\": {}, \"cells\": {}, \"share\": {:.17g}}}",
            text.size() > 1 ? "," : "", row.value, json_text(row.name), row.cells, row.share);
    }
    return text + (rows.empty() ? "]" : "\n  ]");
}

std::string json_attributes(const attribute_list& attributes) {
    std::string text = "{";
    for (const auto& [name, value] : attributes) {
        text += fmt::format("{}\n    {}: {}", text.size() > 1 ? "," : "", json_text(name),
                            json_text(value));
    }
    return text + (attributes.empty() ? "}" : "\n  }");
}

double rate_of(const run_report& report) {
    return static_cast<double>(report.tally.cells) / std::max(report.seconds, 1e-9);
}

/// Share of the threads' time spent on computing tiles.
double busy_share(const run_report& report) {
    return report.tally.busy / std::max(report.n_threads * report.seconds, 1e-9);
}

}  // namespace

std::string text_of(const scene& scene, const run_report& report) {
    std::string text = fmt::format("{}\n", scene.title);
    text += fmt::format("file             {}\n", report.file.string());
    text += fmt::format("cells            {} ({} now, backend {})\n", report.n_cells,
                        report.tally.cells, report.backend);
    text += fmt::format("seconds          {:.3f}\n", report.seconds);
    text += fmt::format("cells/s          {:.4g}\n", rate_of(report));
    text += fmt::format("lane efficiency  {:.1f} %\n", 100.0 * report.tally.lanes.efficiency());
    if (report.n_ranks > 1) {
        text += fmt::format(
            "ranks            {} ({} threads, {:.1f} % busy, {:.1f} % idle at the end)\n",
            report.n_ranks, report.n_threads, 100.0 * busy_share(report),
            100.0 * report.idle_at_end);
    }
    if (scene.refine > 0) {
        const double saved =
            static_cast<double>(report.n_inherited) / static_cast<double>(report.n_cells);
        text += fmt::format("refinement       {} levels, {:.2f} % of the cells computed\n",
                            scene.refine, 100.0 * (1.0 - saved));
    }
    append_shares(text, "labels", label_shares(report));
    append_shares(text, "motion", motion_shares(report));
    append_shares(text, "outcomes", outcome_shares(report));
    if (report.gain.n_labelled > 0) {
        text += fmt::format("traps            {}\n", text_of(report.gain));
    }
    for (const auto& [name, value] : report.audit) text += fmt::format("{:<16} {}\n", name, value);
    text += fmt::format("hash             {}\n", report.hash);
    return text;
}

std::string json_of(const scene& scene, const run_report& report) {
    std::string text = "{\n";
    const auto add = [&](std::string_view name, const std::string& value) {
        text += fmt::format("  {}: {},\n", json_text(name), value);
    };
    add("title", json_text(scene.title));
    add("model", json_text(scene.info().name));
    add("question", json_text(scene.question.kind));
    add("file", json_text(report.file.filename().string()));
    add("fingerprint", json_text(scene.fingerprint));
    add("backend", json_text(report.backend));
    add("cells", fmt::format("{}", report.n_cells));
    add("cells_computed", fmt::format("{}", report.tally.cells));
    add("seconds", fmt::format("{:.17g}", report.seconds));
    add("cells_per_second", fmt::format("{:.17g}", rate_of(report)));
    add("lane_efficiency", fmt::format("{:.17g}", report.tally.lanes.efficiency()));
    add("ranks", fmt::format("{}", report.n_ranks));
    add("threads", fmt::format("{}", report.n_threads));
    add("busy", fmt::format("{:.17g}", busy_share(report)));
    add("idle_at_end", fmt::format("{:.17g}", report.idle_at_end));
    if (scene.refine > 0) {
        add("refine_levels", fmt::format("{}", scene.refine));
        add("refine_saved_share", fmt::format("{:.17g}", static_cast<double>(report.n_inherited) /
                                                             static_cast<double>(report.n_cells)));
    }
    add("labels", json_shares(label_shares(report)));
    if (!report.motions.empty()) add("motions", json_shares(motion_shares(report)));
    add("outcomes", json_shares(outcome_shares(report)));
    if (report.gain.n_labelled > 0) {
        add("returns_per_labelled_cell", json_number(report.gain.mean()));
        add("trap_gain", json_number(report.gain.factor()));
    }
    add("audit", json_attributes(report.audit));
    return text + fmt::format("  \"hash\": {}\n}}\n", json_text(report.hash));
}

std::string text_of(const scene& scene, const run_estimate& estimate) {
    std::string text = fmt::format("{}\n", scene.title);
    if (estimate.n_maps > 1) text += fmt::format("maps       {}\n", estimate.n_maps);
    text += fmt::format("cells      {}\n", estimate.n_cells);
    text += fmt::format("tiles      {} of {} cells\n", estimate.n_tiles,
                        fmt::join(estimate.tile, " x "));
    text += fmt::format("bytes      {} before compression ({})\n", estimate.bytes,
                        bytes_text(estimate.bytes));
    text += fmt::format("memory     {} ({}) of tiles in flight\n", estimate.memory,
                        bytes_text(estimate.memory));
    text += fmt::format("backend    {}, {} threads\n", estimate.backend, estimate.n_threads);
    text += fmt::format("time       about {} ({} cells sampled)\n", clock_text(estimate.seconds),
                        estimate.n_sampled);
    text += fmt::format("undecided  {:.3g} % of the sample\n", 100.0 * estimate.undecided);
    return text;
}

std::string bytes_text(std::uint64_t bytes) {
    constexpr std::array<std::string_view, 5> units{"bytes", "KiB", "MiB", "GiB", "TiB"};
    auto amount = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (amount >= 1024.0 && unit + 1 < units.size()) {
        amount /= 1024.0;
        ++unit;
    }
    return unit == 0 ? fmt::format("{} bytes", bytes)
                     : fmt::format("{:.2f} {}", amount, units[unit]);
}

}  // namespace hopscotch
