// Rows of starts, and maps of scenes.
#include "bench/device_work.hpp"

#include "analysis/labels/plan.hpp"
#include "bench/hopper_returns.hpp"
#include "bench/model_returns.hpp"
#include "host/run/estimate.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_sampled = 4000;

/// Starts of one section, the same parameters for all of them.
struct row_work {
    const model_entry* model;
    int section = 0;
    std::vector<std::vector<double>> columns;
    std::vector<double> parameters;
    std::uint32_t returns = 1;
    double tolerance = 0.0;

    ensemble_request request(std::size_t first, std::size_t n, request_memory& memory) const {
        ensemble_request request;
        request.n_cells = n;
        request.section = section;
        request.max_returns = returns;
        request.tolerance = tolerance;
        memory.outcome.resize(n), memory.returns.resize(n);
        memory.state.resize(n * columns.size());
        for (std::size_t c = 0; c < columns.size(); ++c) {
            request.columns[c] = {columns[c].data() + first, 1, n};
            request.state[c] = memory.state.data() + c * n;
        }
        for (std::size_t p = 0; p < parameters.size(); ++p)
            request.parameters[p].values = &parameters[p];
        request.outcome = memory.outcome.data();
        request.returns = memory.returns.data();
        return request;
    }
};

device_work_item work_of_rows(std::string name, std::shared_ptr<const row_work> rows,
                              std::size_t n_pieces) {
    device_work_item work{.name = std::move(name), .unit = "return", .model = rows->model};
    const int options[most_options] = {};
    work.variant =
        rows->model->variant({rows->parameters.data(), rows->parameters.data(), options, false});
    const std::size_t n = rows->columns[0].size();
    work.n_pieces = n_pieces;
    work.piece = [rows, n](std::size_t, request_memory& memory) {
        return rows->request(0, n, memory);
    };
    work.sample = [rows, n](request_memory& memory) {
        return rows->request(0, std::min(n, n_sampled), memory);
    };
    return work;
}

/// A scene with its labels planned.
struct scene_map {
    scene what;
    label_plan plan;
    map_layout layout;

    ensemble_request with_layers(cell_request cells, request_memory& memory) const {
        const std::size_t n = cells.request.n_cells;
        memory.label.resize(n), memory.outcome.resize(n), memory.returns.resize(n);
        memory.numbers = std::move(cells.tables);
        cells.request.label = memory.label.data();
        cells.request.outcome = memory.outcome.data();
        cells.request.returns = memory.returns.data();
        return cells.request;
    }
};

}  // namespace

double device_work_item::units_of(const ensemble_request& request) const {
    if (unit == "cell") return static_cast<double>(request.n_cells);
    double sum = 0.0;
    for (std::uint64_t i = 0; i < request.n_cells; ++i) sum += request.returns[i];
    return sum;
}

device_work_item hopper_work(double mass_ratio) {
    auto rows = std::make_shared<row_work>();
    rows->model = find_model("passive_hopper");
    rows->columns = {uniform_starts(std::size_t{1} << 20)};
    const model_returns hopper("passive_hopper", "liftoff", {{"mass_ratio", mass_ratio}});
    rows->parameters = hopper.parameters();
    return work_of_rows(fmt::format("passive hopper, M = {:g}", mass_ratio), rows, 16);
}

device_work_item valve_work() {
    auto rows = std::make_shared<row_work>();
    rows->model = find_model("relief_valve");
    rows->returns = 10;
    rows->tolerance = 1e-10;
    model_returns valve("relief_valve", "maximum", {});
    valve.set_starts(uniform_rows(std::size_t{1} << 16, {{0.2, 6.0}, {0.0, 20.0}}));
    valve.settle(32);
    rows->parameters = valve.parameters();
    rows->columns.resize(2);
    for (std::size_t i = 0; i < std::size_t{1} << 20; ++i) {
        const double* const start = valve.start(i % valve.size());
        for (std::size_t c = 0; c < 2; ++c) rows->columns[c].push_back(start[c]);
    }
    return work_of_rows("relief valve, tolerance 1e-10", rows, 4);
}

device_work_item scene_work(const std::string& name, const std::string& scene_file,
                            std::uint64_t cells_per_axis) {
    constexpr std::uint64_t rows_per_piece = 64;
    const std::string cells = std::to_string(cells_per_axis);
    auto map = std::make_shared<scene_map>();
    const std::vector<std::string> size{"grid.axis.0.cells=" + cells, "grid.axis.1.cells=" + cells,
                                        fmt::format("output.tile=[{}, {}]", rows_per_piece, cells)};
    map->what = read_scene(scene_file, size);
    const auto begin = std::chrono::steady_clock::now();
    map->plan = plan_labels(map->what, {});
    const std::chrono::duration<double> planned = std::chrono::steady_clock::now() - begin;
    map->layout = layout_of(map->what);
    device_work_item work{.name = name, .unit = "cell", .model = map->what.model};
    work.planned_in = planned.count();
    work.variant = variant_of(map->what);
    work.n_pieces = map->layout.n_tiles();
    work.piece = [map](std::size_t piece, request_memory& memory) {
        return map->with_layers(
            request_of(map->what, map->plan, map->layout, box_of(map->layout, piece)), memory);
    };
    work.sample = [map](request_memory& memory) {
        const auto chosen = sample_cells(map->what.n_cells(), n_sampled, 1);
        return map->with_layers(request_of(map->what, map->plan, chosen), memory);
    };
    return work;
}

timed_work time_work(const device_work_item& work, backend which, std::size_t n_pieces,
                     int n_threads) {
    timed_work total;
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    const auto begin = std::chrono::steady_clock::now();
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < n_threads; ++i) {
            threads.emplace_back([&] {
                request_memory memory;
                for (std::size_t piece = next++; piece < n_pieces; piece = next++) {
                    const ensemble_request request = work.piece(piece, memory);
                    const lane_statistics lanes = work.model->kernel(which, work.variant)(request);
                    const std::lock_guard lock(mutex);
                    total.lanes += lanes;
                    total.units += work.units_of(request);
                }
            });
        }
    }
    const auto end = std::chrono::steady_clock::now();
    total.seconds = std::chrono::duration<double>(end - begin).count();
    return total;
}

counted_work count_per_unit(const device_work_item& work) {
    request_memory memory;
    const ensemble_request request = work.sample(memory);
    const counted_work counts = count_work(work.model->info->name, work.variant, request);
    return counts.per(work.units_of(request));
}

}  // namespace hopscotch::bench
