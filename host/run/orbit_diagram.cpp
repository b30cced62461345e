// Settles orbits, records their returns, writes them as a map.
#include "host/run/orbit_diagram.hpp"

#include "host/run/attributes.hpp"
#include "host/run/requests.hpp"
#include "host/run/stop_condition.hpp"
#include "host/scene/grid.hpp"
#include "host/scene/layers.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <mutex>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace hopscotch {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool has_sweeps(const scene& scene) { return scene.question.number("sweeps") > 0.0; }

/// Orbits that are followed together: their states, and why those that ended have ended.
struct orbit_batch {
    std::vector<std::vector<double>> columns;  // [column][orbit], of the section below
    std::vector<std::vector<double>> parameters;
    std::vector<std::uint8_t> ends;
    int section = 0;

    std::size_t size() const { return ends.size(); }
    bool goes_on(std::size_t i) const { return ends[i] == static_cast<std::uint8_t>(outcome::ok); }
};

/// Recorded states: [column][(parameter, orbit, sample)], and outcomes in the same order.
struct recorded_states {
    std::vector<std::vector<double>> columns;
    std::vector<std::uint8_t> ends;
};

class diagram_computation {
public:
    diagram_computation(const scene& scene, const map_layout& layout, const kernel_choice& kernel,
                        const stop_condition& stop)
        : scene_(scene),
          kernel_(kernel),
          stop_(stop),
          n_points_(layout.axes[0].size()),
          n_orbits_(layout.axes[orbit_axis].size()),
          n_samples_(layout.axes[sample_axis].size()) {
        const std::size_t n = layout.n_cells();
        states_.columns.assign(scene.end_section().columns.size(), std::vector<double>(n, nan));
        states_.ends.assign(n, 0);
    }

    /// \error interruption
    void compute() {
        const std::size_t n_jobs = (scene_.n_cells() + rows_per_job - 1) / rows_per_job;
        const std::size_t n_sweeps = has_sweeps(scene_) ? 2 : 0;
        tbb::parallel_for(std::size_t{0}, n_sweeps + n_jobs, [&](std::size_t job) {
            if (job < n_sweeps) {
                sweep(job == 0);
            } else {
                settle_starts((job - n_sweeps) * rows_per_job);
            }
        });
    }

    const recorded_states& states() const { return states_; }
    lane_statistics lanes() const { return lanes_; }

private:
    static constexpr std::size_t rows_per_job = 2048;

    /// Cells [first, first + rows_per_job) of the scene's grid, each a parameter point and a start.
    void settle_starts(std::size_t first) {
        const std::size_t last = std::min<std::size_t>(first + rows_per_job, scene_.n_cells());
        orbit_batch batch;
        std::vector<std::pair<std::size_t, std::size_t>> places;  // parameter point, orbit
        for (std::size_t cell = first; cell < last; ++cell) {
            const std::vector<std::uint64_t> coordinates = coordinates_of(scene_, cell);
            add(batch, start_of(scene_, coordinates));
            places.emplace_back(coordinates[0],
                                start_of_cell(coordinates) + (has_sweeps(scene_) ? 2 : 0));
        }
        batch.section = scene_.section;
        follow(batch, places);
    }

    /// Along the first axis; every orbit starts where the one before it ended, the first one and
    /// those after an orbit that ended start at the grid's first start.
    void sweep(bool is_upward) {
        std::vector<std::uint64_t> coordinates(scene_.axes.size(), 0);
        std::vector<double> columns;
        for (std::size_t i = 0; i < n_points_; ++i) {
            coordinates[0] = is_upward ? i : n_points_ - 1 - i;
            cell_start start = start_of(scene_, coordinates);
            orbit_batch batch;
            batch.section = columns.empty() ? scene_.section : end_section();
            if (!columns.empty()) {
                // an axis that is a state column (a conserved one) keeps its own value
                const scene_axis& axis = scene_.axes[0];
                const auto index = static_cast<std::size_t>(axis.index);
                if (axis.kind == axis_kind::column) columns[index] = start.columns[index];
                start.columns = columns;
            }
            add(batch, start);
            follow(batch, {{coordinates[0], is_upward ? std::size_t{0} : std::size_t{1}}});
            columns.clear();
            if (!batch.goes_on(0)) continue;
            for (const auto& column : batch.columns) columns.push_back(column[0]);
        }
    }

    /// Index of a cell's start, in C order over the axes after the first.
    std::size_t start_of_cell(const std::vector<std::uint64_t>& coordinates) const {
        std::size_t start = 0;
        for (std::size_t axis = 1; axis < scene_.axes.size(); ++axis) {
            start = start * scene_.axes[axis].cells + coordinates[axis];
        }
        return start;
    }

    static void add(orbit_batch& batch, const cell_start& start) {
        batch.columns.resize(start.columns.size());
        batch.parameters.resize(start.parameters.size());
        for (std::size_t c = 0; c < start.columns.size(); ++c) {
            batch.columns[c].push_back(start.columns[c]);
        }
        for (std::size_t p = 0; p < start.parameters.size(); ++p) {
            batch.parameters[p].push_back(start.parameters[p]);
        }
        batch.ends.push_back(static_cast<std::uint8_t>(outcome::ok));
    }

    /// Past the transient, then return by return into the recorded states.
    void follow(orbit_batch& batch,
                const std::vector<std::pair<std::size_t, std::size_t>>& places) {
        const auto transient = static_cast<std::uint32_t>(scene_.question.number("transient"));
        if (transient > 0) advance(batch, transient);
        for (std::size_t sample = 0; sample < n_samples_; ++sample) {
            if (stop_condition::is_interrupted() || stop_.is_due()) throw interruption();
            advance(batch, 1);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                const auto [point, orbit] = places[i];
                const std::size_t at = (point * n_orbits_ + orbit) * n_samples_ + sample;
                states_.ends[at] = batch.ends[i];
                if (!batch.goes_on(i)) continue;
                for (std::size_t c = 0; c < states_.columns.size(); ++c) {
                    states_.columns[c][at] = batch.columns[c][i];
                }
            }
        }
    }

    int end_section() const { return scene_.start_section().returns_to; }

    /// Orbits that have ended stay as they are.
    void advance(orbit_batch& batch, std::uint32_t returns) {
        const std::size_t n = batch.size();
        ensemble_request request;
        request.n_cells = n;
        request.section = batch.section;
        for (std::size_t c = 0; c < batch.columns.size(); ++c) {
            request.columns[c] = {batch.columns[c].data(), 1, n};
        }
        for (std::size_t p = 0; p < batch.parameters.size(); ++p) {
            request.parameters[p] = {batch.parameters[p].data(), 1, n};
        }
        std::copy(scene_.options.begin(), scene_.options.end(), request.options);
        request.max_returns = returns;
        request.max_steps = static_cast<double>(scene_.accuracy.max_events);
        std::vector<std::uint8_t> ends(n);
        std::vector<std::vector<double>> next(states_.columns.size(), std::vector<double>(n));
        request.outcome = ends.data();
        for (std::size_t c = 0; c < next.size(); ++c) request.state[c] = next[c].data();
        const lane_statistics lanes = kernel_.run(request);
        for (std::size_t i = 0; i < n; ++i) {
            if (batch.goes_on(i)) batch.ends[i] = ends[i];
        }
        batch.columns = std::move(next);
        batch.section = end_section();
        const std::lock_guard lock(mutex_);
        lanes_ += lanes;
    }

    const scene& scene_;
    const kernel_choice& kernel_;
    const stop_condition& stop_;
    std::size_t n_points_;
    std::size_t n_orbits_;
    std::size_t n_samples_;
    recorded_states states_;
    lane_statistics lanes_;
    std::mutex mutex_;
};

/// The numbers of one tile, cut from the whole diagram: tiles divide the parameter only.
tile_data tile_of(const map_layout& layout, const std::vector<layer_plan>& layers,
                  const recorded_states& states, std::uint64_t index) {
    tile_data tile{box_of(layout, index), {}};
    const std::size_t per_point = layout.axes[orbit_axis].size() * layout.axes[sample_axis].size();
    const std::size_t first = tile.box.origin[0] * per_point;
    const std::size_t n = tile.box.n_cells();
    for (const layer_plan& layer : layers) {
        auto& buffer = tile.layers.emplace_back(n * bytes_of(layer.description.type));
        const void* from =
            layer.role == layer_role::outcome
                ? static_cast<const void*>(states.ends.data() + first)
                : states.columns[static_cast<std::size_t>(layer.index)].data() + first;
        std::memcpy(buffer.data(), from, buffer.size());
    }
    return tile;
}

axis numbered_axis(std::string name, std::string meaning, std::uint64_t first, std::uint64_t n) {
    axis result{std::move(name), "1", std::move(meaning), "linear", {}};
    for (std::uint64_t i = 0; i < n; ++i) result.values.push_back(static_cast<double>(first + i));
    return result;
}

}  // namespace

bool is_orbit_diagram(const scene& scene) { return scene.question.kind == "orbit_diagram"; }

map_layout diagram_layout(const scene& scene) {
    constexpr std::uint64_t cells_per_tile = 1 << 18;
    map_layout layout = layout_of(scene);
    const axis parameter = layout.axes[0];
    const std::uint64_t n_starts = scene.n_cells() / parameter.size();
    const std::uint64_t first = has_sweeps(scene) ? 0 : 2;
    layout.axes = {
        parameter,
        numbered_axis("orbit",
                      "0: sweep of rising parameter, 1: of falling parameter, 2 and above: starts",
                      first, n_starts + 2 - first),
        numbered_axis("sample", "returns after the transient", 1, scene.question.returns)};
    const std::uint64_t per_point =
        layout.axes[orbit_axis].size() * layout.axes[sample_axis].size();
    const std::uint64_t points = std::max<std::uint64_t>(cells_per_tile / per_point, 1);
    layout.tile = {std::min(points, parameter.size()), layout.axes[orbit_axis].size(),
                   layout.axes[sample_axis].size()};
    return layout;
}

void check_diagram(const scene& scene) {
    for (std::size_t i = 1; i < scene.axes.size(); ++i) {
        if (scene.axes[i].kind == axis_kind::column) continue;
        throw scene_error({scene.question.place, "question.kind", "\"orbit_diagram\"",
                           fmt::format("axis {} of the grid is a second parameter", i),
                           "only the first axis; the ones after it are state columns: starts"});
    }
    const scene_axis& first = scene.axes[0];
    const bool is_start_only = scene.start_section().returns_to != scene.section;
    if (first.kind == axis_kind::column && is_start_only) {
        throw scene_error(
            {scene.question.place, "question.kind", "\"orbit_diagram\"",
             fmt::format("{} is no column of the section that returns end on", first.name),
             "a parameter as the first axis"});
    }
}

run_report run_diagram(const scene& scene, const run_choices& choices) {
    check_diagram(scene);
    const stop_condition stop(choices.walltime);
    const kernel_choice kernel = kernel_of(scene, choices.backend);
    const map_layout layout = diagram_layout(scene);
    run_report report;
    report.file = choices.file.empty() ? scene.output.file : choices.file;
    report.backend = name_of(kernel.which);
    report.n_cells = layout.n_cells();
    report.n_tiles = layout.n_tiles();
    map_run run(layout, {.map = report.file,
                         .fingerprint = scene.fingerprint,
                         .attributes = attributes_of(scene, kernel),
                         .existing = choices.existing,
                         .keeps_tiles = choices.keeps_tiles});
    report.notes = run.notes();
    report.is_finished = run.complete();
    if (report.is_finished) return report;

    diagram_computation diagram(scene, layout, kernel, stop);
    tbb::task_arena arena(threads_for(choices.n_threads));
    try {
        arena.execute([&] { diagram.compute(); });
    } catch (const interruption&) {
        report.n_missing = report.n_tiles;
        return report;
    }
    report.seconds = stop.elapsed();
    const std::vector<layer_plan> layers = chosen_layers(scene);
    for (std::uint64_t tile = 0; tile < report.n_tiles; ++tile) {
        run.put(compress(layout, tile_of(layout, layers, diagram.states(), tile),
                         scene.output.compression,
                         report.seconds / static_cast<double>(report.n_tiles)));
    }
    report.tally = {report.n_tiles, report.n_cells, 0, diagram.lanes(), report.seconds};
    report.outcomes = run.counts("outcome");
    report.hash = run.hash();
    run.finish({});
    report.is_finished = true;
    return report;
}

}  // namespace hopscotch
