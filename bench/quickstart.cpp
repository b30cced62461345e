// How many cells per second does the quickstart scene give, file written, and where does the time
// go? Runs `hopscotch run` on 1, 2, 4 ... threads for every backend of the processor, and takes the
// same map apart in this process on one thread: compute, compress, write. Usage: quickstart PROGRAM
// SCENE
#include "analysis/labels/plan.hpp"
#include "bench/child.hpp"
#include "bench/report.hpp"
#include "host/run/run_map.hpp"
#include "host/run/attributes.hpp"
#include "host/run/backends.hpp"
#include "host/run/kernel_in_use.hpp"
#include "host/run/requests.hpp"
#include "host/run/tiles.hpp"
#include "host/scene/grid.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr int n_repeats = 5;

std::vector<std::string_view> usable_backends(const scene& scene) {
    std::vector<std::string_view> names;
    for (const backend which : {backend::avx512, backend::avx2}) {
        if (scene.model->has(which) && reason_against(which).empty())
            names.push_back(name_of(which));
    }
    if (names.empty()) names.push_back(name_of(backend::scalar));
    return names;
}

std::vector<int> thread_counts() {
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<int> counts;
    for (int n = 1; n < cores; n *= 2) counts.push_back(n);
    counts.push_back(cores);
    return counts;
}

/// `hopscotch run` as a user types it; cells per second of the part that `run` itself times
/// (compute, compress, write tiles), and of the whole process (also audit, packing the file,
/// picture).
void run_program(const program_and_scene& given, std::string_view backend_name, int n_threads,
                 double n_cells) {
    std::vector<double> rates;
    std::vector<double> walls;
    std::vector<double> walls_unaudited;
    for (int i = 0; i < n_repeats; ++i) {
        for (const bool is_audited : {false, true}) {
            const scratch_directory scratch;
            const std::string file = (scratch.path() / "map.h5").string();
            std::vector<std::string> command{given.program,
                                             "run",
                                             given.scene,
                                             "--quiet",
                                             "--force",
                                             "-o",
                                             file,
                                             "--backend",
                                             std::string(backend_name),
                                             "--threads",
                                             std::to_string(n_threads)};
            if (!is_audited) command.push_back("accuracy.audit_cells=0");
            const child_result child = run_child(command);
            const std::string summary = text_of_file(scratch.path() / "map.json");
            rates.push_back(json_number_of(summary, "cells_per_second"));
            (is_audited ? walls : walls_unaudited).push_back(child.wall_seconds);
        }
    }
    const double per_second = median(rates);
    json_line("quickstart")
        .add("backend", backend_name)
        .add("threads", static_cast<double>(n_threads))
        .add("cells", n_cells)
        .add("cells_per_second", per_second)
        .add("cells_per_second_best", quantile(rates, 1.0))
        .add("wall_seconds", median(walls))
        .add("wall_seconds_without_audit", median(walls_unaudited))
        .add("cells_per_second_of_wall", n_cells / median(walls))
        .print();
    fmt::print(
        "{:<7} {:>2} threads  {:.3g} cells/s (best {:.3g}); whole process {:.2f} s, {:.2f} s "
        "without audit\n",
        backend_name, n_threads, per_second, quantile(rates, 1.0), median(walls),
        median(walls_unaudited));
}

double since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The map of `run`, one step after the other on this thread.
void take_apart(const scene& scene, std::string_view backend_name) {
    kernel_in_use kernel(choose_kernel(*scene.model, variant_of(scene), backend_name));
    const map_layout layout = layout_of(scene);
    const std::vector<layer_plan> layers = chosen_layers(scene);
    std::vector<double> seconds[4];
    lane_statistics lanes;
    for (int i = 0; i < n_repeats; ++i) {
        const scratch_directory scratch;
        auto begin = std::chrono::steady_clock::now();
        const label_plan plan = plan_labels(scene);
        seconds[0].push_back(since(begin));
        const tile_job job{scene, plan, layout, layers, kernel};
        map_run run(layout, {.map = scratch.path() / "map.h5",
                             .fingerprint = scene.fingerprint,
                             .attributes = attributes_of(scene, kernel.first())});
        double parts[3] = {};
        for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
            begin = std::chrono::steady_clock::now();
            const tile_result result = compute_tile(job, box_of(layout, tile));
            parts[0] += since(begin);
            lanes += result.lanes;
            begin = std::chrono::steady_clock::now();
            const compressed_tile packed =
                compress(layout, result.data, scene.output.compression, result.seconds);
            parts[1] += since(begin);
            begin = std::chrono::steady_clock::now();
            run.put(packed);
            parts[2] += since(begin);
        }
        for (int p = 0; p < 3; ++p) seconds[p + 1].push_back(parts[p]);
    }
    const auto n_cells = static_cast<double>(layout.n_cells());
    const auto ns = [&](int part) { return 1e9 * median(seconds[part]) / n_cells; };
    json_line("quickstart_parts")
        .add("backend", backend_name)
        .add("threads", 1.0)
        .add("plan_seconds", median(seconds[0]))
        .add("compute_ns_per_cell", ns(1))
        .add("compress_ns_per_cell", ns(2))
        .add("write_ns_per_cell", ns(3))
        .add("lane_efficiency", lanes.efficiency())
        .print();
    fmt::print(
        "{:<7} parts, 1 thread: compute {:.1f}, compress {:.1f}, write {:.1f} ns per cell; plan "
        "{:.3f} s; lanes {:.1f} % full\n",
        backend_name, ns(1), ns(2), ns(3), median(seconds[0]), 100.0 * lanes.efficiency());
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch;
    try {
        const auto given = bench::arguments_of(argc, argv);
        const scene scene = read_scene(given.scene);
        for (const std::string_view backend_name : bench::usable_backends(scene)) {
            for (const int n_threads : bench::thread_counts()) {
                bench::run_program(given, backend_name, n_threads,
                                   static_cast<double>(scene.n_cells()));
            }
            bench::take_apart(scene, backend_name);
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "quickstart: {}\n", error.what());
        return 1;
    }
}
