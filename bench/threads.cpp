// How much faster are maps on all cores than on one? Pairs of `hopscotch run`, one thread and as
// many as there are cores, in turn: seconds of the map itself (compute, compress, write tiles),
// wall time of the whole process, and the processor time that more threads cost. Needs an idle
// machine: the load before each scene comes with its result. Usage: threads PROGRAM SCENE, the
// scene for the folder that it lies in
#include "bench/child.hpp"
#include "bench/report.hpp"

#include <cstdlib>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

struct threaded_scene {
    const char* name;
    const char* scene;
    std::vector<std::string> overrides;
    int n_pairs;
};

const threaded_scene scenes[] = {
    {"quickstart", "quickstart", {}, 7},
    {"quickstart, 4096 x 4096",
     "quickstart",
     {"grid.axis.0.cells=4096", "grid.axis.1.cells=4096"},
     3},
    {"ghigliazza2005_gravity_basins", "ghigliazza2005_gravity_basins", {}, 2},
    {"cham2007_fig8_basins, 1600 x 1600",
     "cham2007_fig8_basins",
     {"grid.axis.0.cells=1600", "grid.axis.1.cells=1600"},
     3},
    {"koditschek1991_lyapunov", "koditschek1991_lyapunov", {}, 1},
};

struct run_cost {
    double map_seconds;
    double wall_seconds;
    double processor_seconds;
};

run_cost cost_of(const std::string& program, const std::string& scene,
                 const std::vector<std::string>& overrides, int n_threads) {
    const scratch_directory scratch;
    std::vector<std::string> command{program, "run", scene, "--quiet", "--force"};
    command.insert(command.end(), {"-o", (scratch.path() / "map.h5").string()});
    command.insert(command.end(), {"--threads", std::to_string(n_threads)});
    command.emplace_back("accuracy.audit_cells=0");
    command.insert(command.end(), overrides.begin(), overrides.end());
    const child_result child = run_child(command);
    const std::string summary = text_of_file(scratch.path() / "map.json");
    return {json_number_of(summary, "seconds"), child.wall_seconds, child.processor_seconds};
}

double load_now() {
    double load = 0.0;
    return getloadavg(&load, 1) == 1 ? load : -1.0;
}

void measure(const std::string& program, const std::filesystem::path& folder,
             const threaded_scene& what, int n_cores) {
    const double load = load_now();
    const std::string scene = (folder / (std::string(what.scene) + ".toml")).string();
    std::vector<double> map, map_ratio, wall_ratio, processor_ratio;
    for (int pair = 0; pair < what.n_pairs; ++pair) {
        const run_cost one = cost_of(program, scene, what.overrides, 1);
        const run_cost all = cost_of(program, scene, what.overrides, n_cores);
        map.push_back(one.map_seconds);
        map_ratio.push_back(one.map_seconds / all.map_seconds);
        wall_ratio.push_back(one.wall_seconds / all.wall_seconds);
        processor_ratio.push_back(all.processor_seconds / one.processor_seconds);
    }
    json_line("threads")
        .add("case", what.name)
        .add("threads", static_cast<double>(n_cores))
        .add("pairs", static_cast<double>(what.n_pairs))
        .add("load_before", load)
        .add("map_seconds_one_thread", median(map))
        .add("map_speedup", median(map_ratio))
        .add("map_speedup_best", quantile(map_ratio, 1.0))
        .add("wall_speedup", median(wall_ratio))
        .add("processor_time_ratio", median(processor_ratio))
        .print();
    fmt::print(
        "{:<34} map {:7.3f} s on one thread, {:.2f} times as fast on {} (best pair {:.2f}); whole "
        "process {:.2f}; processor time {:.2f} times; load before {:.1f}\n",
        what.name, median(map), median(map_ratio), n_cores, quantile(map_ratio, 1.0),
        median(wall_ratio), median(processor_ratio), load);
    std::fflush(stdout);
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch::bench;
    try {
        const program_and_scene given = arguments_of(argc, argv);
        const auto folder = std::filesystem::path(given.scene).parent_path();
        const int n_cores = static_cast<int>(std::thread::hardware_concurrency());
        for (const threaded_scene& one : scenes) measure(given.program, folder, one, n_cores);
    } catch (const std::exception& error) {
        fmt::print(stderr, "threads: {}\n", error.what());
        return 1;
    }
}
