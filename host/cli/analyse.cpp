// hopscotch analyse FILE.h5: basin shares, boundaries and their dimension, distances; as a table
// and as JSON.
#include "analysis/labels/point_search.hpp"
#include "analysis/labels/slice_attractors.hpp"
#include "host/cli/analysis_report.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/map_plan.hpp"
#include "host/cli/side_files.hpp"
#include "host/cli/sweep_point.hpp"
#include "host/cli/text_output.hpp"
#include "host/cli/usage_error.hpp"
#include "host/run/attributes.hpp"

#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace hopscotch {
namespace {

struct analyse_arguments {
    std::string file;
    std::string point;
    std::string layer;
    std::string falls = "separate";
    std::vector<std::string> reference_box;
    std::uint64_t box = 0;
    double wada_tolerance = 8.0;
    std::string output;
};

metrics::fall_rule rule_of(const std::string& name) {
    if (name == "together") return metrics::fall_rule::together;
    return name == "left_out" ? metrics::fall_rule::left_out : metrics::fall_rule::separate;
}

/// "axis=low:high".
std::pair<std::string, std::pair<double, double>> range_in(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::size_t colon = text.find(':', equals == text.npos ? 0 : equals);
    std::pair<double, double> range;
    const auto reads = [&](std::size_t begin, std::size_t end, double& value) {
        const char* const last = text.data() + end;
        const auto [next, failure] = std::from_chars(text.data() + begin, last, value);
        return failure == std::errc{} && next == last;
    };
    const bool is_range = equals != text.npos && colon != text.npos &&
                          reads(equals + 1, colon, range.first) &&
                          reads(colon + 1, text.size(), range.second) && range.first < range.second;
    if (is_range) return {text.substr(0, equals), range};
    throw usage_error(
        fmt::format("--reference-box {} (not an axis and a range); AXIS=LOW:HIGH?", text));
}

/// The map's scene; none where this program does not know its model.
std::optional<scene> known_scene_of(const map_reader& map) try {
    return scene_of(map, all_models());
} catch (const scene_error&) {
    return {};
} catch (const store_error&) {
    return {};
}

/// Where the map's plane lies in the state columns that are no axis.
std::map<std::string, double> plane_of(const scene& scene) {
    std::map<std::string, double> plane;
    for (std::size_t i = 0; i < scene.start.size(); ++i) {
        plane[std::string(scene.start_section().columns[i].name)] = scene.start[i];
    }
    return plane;
}

/// Are there axes over which attractors change, and others?
bool is_over_parameters(const scene& scene, const std::vector<std::size_t>& axes) {
    return scene.question.has_labels && !axes.empty() && axes.size() < scene.axes.size();
}

int analyse(const analyse_arguments& given) {
    metrics::analysis_wish wish;
    wish.classes = {given.layer, rule_of(given.falls)};
    wish.box = given.box;
    for (const std::string& text : given.reference_box) wish.reference_box.insert(range_in(text));
    const map_reader map(given.file);
    const std::optional<scene> scene = known_scene_of(map);
    label_plan plan;
    if (scene) {
        wish.plane = plane_of(*scene);
        const std::vector<std::size_t> axes = axes_of_points(*scene);
        if (is_over_parameters(*scene, axes)) {
            plan = told_plan(*scene, map);
            wish.slices = slices_of(*scene, plan, axes, wish.plane);
        }
    }
    const metrics::map_analysis result = metrics::analyse_map(map, wish);
    const wada_tolerance tolerance{given.wada_tolerance};
    const std::string name = std::filesystem::path(given.file).filename().string();
    const std::string stem = std::filesystem::path(given.file).stem().string();
    const std::string file = given.output.empty() ? stem + "_analysis.json" : given.output;
    // JSON on standard output stands alone, so that it can be read by another program
    if (file != "-") fmt::print("{}: {}", name, analysis_text(result, tolerance));
    put_text(file, analysis_json(result, tolerance, name));
    if (file == "-") return exit_done;
    fmt::print("{}\n", file);
    // maps that were merged, or are one of a sweep, have had none yet
    const bool has_sides = scene && scene->question.kind == "one_sided" && map.is_finished_map();
    if (has_sides) fmt::print("{}", write_sides(given.file));
    return exit_done;
}

}  // namespace

void add_analyse(CLI::App& program, int& exit_code) {
    auto given = std::make_shared<analyse_arguments>();
    CLI::App* command = program.add_subcommand(
        "analyse", "Basin shares, entropy, boundary dimension, distances of a map");
    command->add_option("file", given->file, "Map file (HDF5)")->required();
    add_point(*command, given->point);
    command->add_option("-o,--output", given->output,
                        "JSON file, - for standard output; MAP_analysis.json if not given");
    command->add_option("--layer", given->layer,
                        "Layer whose values are the classes; label, or outcome without labels");
    command
        ->add_option("--falls", given->falls,
                     "Cells without a label whose outcome is a failure: a class each (separate), "
                     "one class (together), or undecided (left_out)")
        ->check(CLI::IsMember({"separate", "together", "left_out"}));
    command->add_option("--box", given->box,
                        "Cells along a side of the basin entropy's boxes; 5 in a plane");
    command->add_option("--reference-box", given->reference_box,
                        "AXIS=LOW:HIGH, once per axis: where basin stability is taken");
    command->add_option("--wada-tolerance", given->wada_tolerance,
                        "Cells within which merged boundaries count as one");
    command->callback([given, &exit_code] {
        given->file = chosen_map(given->file, given->point);
        exit_code = analyse(*given);
    });
}

}  // namespace hopscotch
