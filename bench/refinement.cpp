// What does boundary refinement save, and what does it cost? Full and refined runs of the same
// scene in turn: cells computed, processor seconds, and the share of labels that differ. A smooth
// scene (few basins, curves between them) and a fractal one, each at two numbers of levels. Usage:
// refinement PROGRAM SCENE (the scene's folder holds the others)
#include "bench/child.hpp"
#include "bench/report.hpp"
#include "host/store/map_reader.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

struct refined_scene {
    const char* name;
    std::vector<std::string> overrides;
};

const std::vector<refined_scene> scenes{
    {"quickstart", {"grid.axis.0.cells=1024", "grid.axis.1.cells=1024"}},
    {"ghigliazza2005_gravity_basins", {"grid.axis.0.cells=512", "grid.axis.1.cells=512"}},
    {"cham2007_fig8_basins", {"grid.axis.0.cells=1024", "grid.axis.1.cells=1024"}}};

constexpr int n_repeats = 3;

struct measured_run {
    double processor_seconds = 0.0;
    double saved = 0.0;  // share of the cells
    std::vector<double> labels;
};

measured_run run(const std::string& program, const std::filesystem::path& scene,
                 const std::vector<std::string>& overrides, int levels) {
    const scratch_directory scratch;
    const std::filesystem::path map = scratch.path() / "map.h5";
    std::vector<std::string> command{program,
                                     "run",
                                     scene.string(),
                                     "accuracy.audit_cells=0",
                                     "output.tile=[128, 128]",
                                     fmt::format("grid.refine={}", levels),
                                     "--quiet",
                                     "-o",
                                     map.string()};
    command.insert(command.end(), overrides.begin(), overrides.end());
    const child_result child = run_child(command);
    measured_run result{child.processor_seconds, 0.0, {}};
    const std::string summary = text_of_file(scratch.path() / "map.json");
    if (levels > 0) result.saved = json_number_of(summary, "refine_saved_share");
    result.labels = map_reader(map).read_all("label");
    return result;
}

double share_of_differences(const std::vector<double>& a, const std::vector<double>& b) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.size(); ++i) n += a[i] != b[i] ? 1 : 0;
    return static_cast<double>(n) / static_cast<double>(a.size());
}

void measure(const program_and_scene& given, const refined_scene& what) {
    const std::filesystem::path scene =
        std::filesystem::path(given.scene).parent_path() / (std::string(what.name) + ".toml");
    const std::vector<int> all_levels{0, 2, 4};
    std::vector<std::vector<double>> seconds(all_levels.size());
    std::vector<measured_run> runs(all_levels.size());
    for (int repeat = 0; repeat < n_repeats; ++repeat) {  // in turn: the machine is not quiet
        for (std::size_t i = 0; i < all_levels.size(); ++i) {
            runs[i] = run(given.program, scene, what.overrides, all_levels[i]);
            seconds[i].push_back(runs[i].processor_seconds);
        }
    }
    const double full = median(seconds[0]);
    fmt::print("{}: full run {:.2f} s of processor time\n", what.name, full);
    for (std::size_t i = 1; i < all_levels.size(); ++i) {
        const double refined = median(seconds[i]);
        const double wrong = share_of_differences(runs[0].labels, runs[i].labels);
        json_line("refinement")
            .add("scene", what.name)
            .add("cells", static_cast<double>(runs[i].labels.size()))
            .add("levels", static_cast<double>(all_levels[i]))
            .add("full_processor_seconds", full)
            .add("refined_processor_seconds", refined)
            .add("time_ratio", refined / full)
            .add("saved_share", runs[i].saved)
            .add("label_share_differing", wrong)
            .print();
        fmt::print(
            "  {} levels: {:.1f} % of cells computed, {:.2f} times the full run's time, {:.2g} "
            "of labels differ\n",
            all_levels[i], 100.0 * (1.0 - runs[i].saved), refined / full, wrong);
    }
    std::fflush(stdout);
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch::bench;
    try {
        const program_and_scene given = arguments_of(argc, argv);
        for (const refined_scene& scene : scenes) measure(given, scene);
    } catch (const std::exception& error) {
        fmt::print(stderr, "refinement: {}\n", error.what());
        return 1;
    }
}
