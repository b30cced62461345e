// How does a map scale over ranks, and what would a job of a thousand ranks meet first? Strong and
// weak scaling over 1, 2 and 4 ranks of one thread each; the cost of every tile, of its file and of
// the serial end; one-sided draws per second; a model of large jobs from these figures. Scalar
// kernels, so that cells cost about what they do in the integrated models on vector units. Usage:
// scaling PROGRAM SCENE (measures), scaling draw N (one rank's part, under mpirun).
#include "analysis/labels/plan.hpp"
#include "bench/child.hpp"
#include "bench/rank_model.hpp"
#include "bench/report.hpp"
#include "host/mpi/start_team.hpp"
#include "host/run/attributes.hpp"
#include "host/run/backends.hpp"
#include "host/run/kernel_in_use.hpp"
#include "host/run/requests.hpp"
#include "host/run/tiles.hpp"
#include "host/scene/grid.hpp"
#include "host/store/map_run.hpp"

#include <chrono>
#include <cstdlib>
#include <map>
#include <numeric>
#include <thread>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr int n_rounds = 3;
constexpr int rank_counts[] = {1, 2, 4};
constexpr std::uint64_t rows = 1024;  // of 2000 cells each, in tiles of 64 x 125

std::vector<std::string> grid_of(std::uint64_t n_rows) {
    return {fmt::format("grid.axis[0].cells={}", n_rows), "grid.axis[1].cells=2000",
            "output.tile=[64, 125]", "accuracy.audit_cells=0"};
}

double since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct job_figures {
    std::vector<double> seconds;  // drawing, computing and writing tiles
    std::vector<double> busy;     // share of the ranks' time in kernels
    std::vector<double> idle;     // share of the ranks' time at the end
};

void run_job(const program_and_scene& given, int n_ranks, std::uint64_t n_rows, job_figures& into) {
    const scratch_directory scratch;
    const std::string map = (scratch.path() / "map.h5").string();
    std::vector<std::string> command{"/usr/bin/env",
                                     "OMPI_ALLOW_RUN_AS_ROOT=1",
                                     "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                     "mpirun",
                                     "--oversubscribe",
                                     "--bind-to",
                                     "none",
                                     "-n",
                                     std::to_string(n_ranks),
                                     given.program,
                                     "run",
                                     given.scene,
                                     "--quiet",
                                     "--backend",
                                     "scalar",
                                     "--threads",
                                     "1",
                                     "-o",
                                     map};
    for (const std::string& word : grid_of(n_rows)) command.push_back(word);
    run_child(command);
    const std::string summary = text_of_file(scratch.path() / "map.json");
    into.seconds.push_back(json_number_of(summary, "seconds"));
    into.busy.push_back(json_number_of(summary, "busy"));
    into.idle.push_back(json_number_of(summary, "idle_at_end"));
}

/// \param rows_per_rank  0: the map is the same for every number of ranks
void scale(const program_and_scene& given, std::string_view kind, std::uint64_t rows_of_all,
           std::uint64_t rows_per_rank) {
    std::map<int, job_figures> figures;
    for (int round = 0; round < n_rounds; ++round) {
        for (const int n : rank_counts) {
            const auto n_rows = rows_of_all + static_cast<std::uint64_t>(n) * rows_per_rank;
            run_job(given, n, n_rows, figures[n]);
        }
    }
    const auto n_cores = static_cast<int>(std::thread::hardware_concurrency());
    for (const int n : rank_counts) {
        const job_figures& job = figures[n];
        std::vector<double> ratios;  // to one rank, round by round
        for (int round = 0; round < n_rounds; ++round) {
            const auto r = static_cast<std::size_t>(round);
            ratios.push_back(figures[1].seconds[r] / job.seconds[r]);
        }
        json_line("scaling")
            .add("kind", kind)
            .add("ranks", static_cast<double>(n))
            .add("oversubscribed", n > n_cores)
            .add("seconds", median(job.seconds))
            .add("one_rank_over_this", median(ratios))
            .add("busy", median(job.busy))
            .add("idle_at_end", median(job.idle))
            .print();
        fmt::print(
            "{:<6} {} ranks{}  {:.2f} s, one rank's time over it {:.2f} ({:.2f} to {:.2f}), "
            "kernels {:.0f} %, idle at the end {:.2f} %\n",
            kind, n, n > n_cores ? " on fewer cores" : "", median(job.seconds), median(ratios),
            quantile(ratios, 0.0), quantile(ratios, 1.0), 100.0 * median(job.busy),
            100.0 * median(job.idle));
    }
}

struct tile_costs {
    std::vector<double> compute;  // seconds of processor time per tile, in the order of tiles
    double compress = 0.0;        // mean per tile, processor time
    double put = 0.0;             // mean per tile, wall: one file written and renamed
    double scan = 0.0;            // rank 0 reads and checks one tile of another rank
    double pack = 0.0;            // rank 0 packs one tile and removes its file
    double plan = 0.0;            // search for attractors, on every rank
    double bytes = 0.0;           // of a tile's file
};

tile_costs take_apart(const std::string& scene_file) {
    const scene scene = read_scene(scene_file, grid_of(rows));
    const kernel_choice kernel = choose_kernel(*scene.model, variant_of(scene), "scalar");
    const map_layout layout = layout_of(scene);
    const std::vector<layer_plan> layers = chosen_layers(scene);
    const scratch_directory scratch;
    tile_costs costs;
    double begin = thread_seconds();
    const label_plan plan = plan_labels(scene);
    costs.plan = thread_seconds() - begin;
    kernel_in_use in_use(kernel);
    const tile_job job{scene, plan, layout, layers, in_use};
    run_options options{.map = scratch.path() / "map.h5",
                        .fingerprint = scene.fingerprint,
                        .attributes = attributes_of(scene, kernel)};
    map_run owner(layout, options);
    options.role = run_role::helper;
    map_run helper(layout, options);
    const auto n = static_cast<double>(layout.n_tiles());
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        begin = thread_seconds();
        const tile_result result = compute_tile(job, box_of(layout, tile));
        costs.compute.push_back(thread_seconds() - begin);
        begin = thread_seconds();
        const compressed_tile packed =
            compress(layout, result.data, scene.output.compression, result.seconds);
        costs.compress += (thread_seconds() - begin) / n;
        const auto written = std::chrono::steady_clock::now();
        helper.put(packed);
        costs.put += since(written) / n;
        for (const auto& chunk : packed.chunks)
            costs.bytes += static_cast<double>(chunk.size()) / n;
    }
    auto serial = std::chrono::steady_clock::now();
    owner.rescan(owner.missing_tiles());
    costs.scan = since(serial) / n;
    serial = std::chrono::steady_clock::now();
    owner.finish({{}, plan.attractors, plan.point_columns});
    costs.pack = since(serial) / n;
    return costs;
}

void report(const tile_costs& costs) {
    const double mean = std::accumulate(costs.compute.begin(), costs.compute.end(), 0.0) /
                        static_cast<double>(costs.compute.size());
    json_line("scaling_tiles")
        .add("tiles", static_cast<double>(costs.compute.size()))
        .add("compute_mean", mean)
        .add("compute_median", median(costs.compute))
        .add("compute_99_percent", quantile(costs.compute, 0.99))
        .add("compute_largest", quantile(costs.compute, 1.0))
        .add("compress", costs.compress)
        .add("put", costs.put)
        .add("scan", costs.scan)
        .add("pack", costs.pack)
        .add("plan", costs.plan)
        .add("bytes", costs.bytes)
        .print();
    fmt::print(
        "a tile: compute {:.2f} ms (median {:.2f}, 99 % {:.2f}, largest {:.2f}); compress "
        "{:.2f}, file {:.2f}; at the end on rank 0: check {:.2f}, pack {:.2f} ms\n",
        1e3 * mean, 1e3 * median(costs.compute), 1e3 * quantile(costs.compute, 0.99),
        1e3 * quantile(costs.compute, 1.0), 1e3 * costs.compress, 1e3 * costs.put, 1e3 * costs.scan,
        1e3 * costs.pack);
}

/// Draws and counts that two ranks get from the counter per second, nothing else to do.
double draws_per_second(const std::string& self) {
    constexpr int n_draws = 200000;
    const child_result child = run_child(
        {"/usr/bin/env", "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "mpirun",
         "--oversubscribe", "--bind-to", "none", "-n", "2", self, "draw", std::to_string(n_draws)});
    const double rate = std::strtod(child.output.c_str(), nullptr);
    json_line("scaling_counter").add("draws_per_second", rate).print();
    fmt::print("counter: {:.3g} draws with their counts per second, two ranks of one node\n", rate);
    return rate;
}

void draw(std::uint64_t n) {
    team& ranks = start_team();
    std::vector<std::uint64_t> tiles(n);
    std::iota(tiles.begin(), tiles.end(), std::uint64_t{0});
    const auto queue = ranks.open_queue(std::move(tiles), [](const run_tally&) {});
    const auto begin = std::chrono::steady_clock::now();
    while (queue->next()) queue->count({.tiles = 1, .cells = 1});
    const run_tally all = queue->close();
    if (ranks.is_first()) fmt::print("{}\n", static_cast<double>(all.tiles) / since(begin));
}

/// \param slowness  how many times more a cell costs than in the measured scene
void model(const tile_costs& costs, double slowness, std::uint64_t tiles_per_rank) {
    std::vector<double> seconds = costs.compute;
    for (double& each : seconds) each = each * slowness + costs.compress + costs.put;
    for (const std::uint64_t n : {2, 10, 100, 1000}) {
        const std::uint64_t n_tiles = n * tiles_per_rank;
        const rank_model job = model_ranks(seconds, n_tiles, n);
        const double serial = static_cast<double>(n_tiles) * (costs.scan + costs.pack);
        json_line("scaling_model")
            .add("slowness", slowness)
            .add("ranks", static_cast<double>(n))
            .add("tiles", static_cast<double>(n_tiles))
            .add("seconds", job.seconds)
            .add("idle_at_end", job.idle_share)
            .add("counter_operations_per_second", 2.0 * job.tiles_per_second)
            .add("files_per_second", job.tiles_per_second)
            .add("metadata_operations_per_second", 3.0 * job.tiles_per_second)
            .add("megabytes_per_second", 1e-6 * costs.bytes * job.tiles_per_second)
            .add("serial_end_seconds", serial)
            .print();
        fmt::print(
            "model, cells {:>4.0f} times as slow, {:>5} ranks, {:>7} tiles: {:.3g} s, idle "
            "{:.2f} %, {:.3g} counter and {:.3g} metadata operations per second, then {:.3g} "
            "s on rank 0\n",
            slowness, n, n_tiles, job.seconds, 100.0 * job.idle_share, 2.0 * job.tiles_per_second,
            3.0 * job.tiles_per_second, serial);
    }
}

void measure(const program_and_scene& given, const std::string& self) {
    if (mpi_library().empty()) {
        throw std::runtime_error("this program is built without MPI (libopenmpi-dev)");
    }
    const tile_costs costs = take_apart(given.scene);
    report(costs);
    draws_per_second(self);
    for (const double slowness : {1.0, 100.0}) model(costs, slowness, 100);
    scale(given, "strong", rows, 0);
    scale(given, "weak", 0, rows);
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch;
    try {
        if (argc == 3 && std::string_view(argv[1]) == "draw") {
            bench::draw(std::strtoull(argv[2], nullptr, 10));
            return 0;
        }
        bench::measure(bench::arguments_of(argc, argv), argv[0]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "scaling: {}\n", error.what());
        return 1;
    }
}
