// Samples cells, knows their answers, counts wrong ones.
#include "bench/labelled_cells.hpp"

#include "kernels/lanes/scalar.hpp"  // before what computes with it

#include "analysis/labels/one_sided.hpp"
#include "analysis/labels/plan.hpp"
#include "bench/report.hpp"
#include "host/run/audit.hpp"
#include "host/run/truth_orbits.hpp"
#include "kernels/ensemble/traps.hpp"
#include "tests/hard/boundary_zoom.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <span>
#include <stdexcept>

#include <tbb/parallel_for.h>

namespace hopscotch::bench {
namespace {

constexpr std::uint64_t n_grid_cells = 400;
constexpr std::uint64_t n_slow_grid_cells = 100;
constexpr int n_lines = 4;
constexpr int n_slow_lines = 1;
constexpr int most_lines = 16;        // that are looked at for those with changes
constexpr std::size_t n_changes = 3;  // per line
constexpr int n_decades = 15;

constexpr std::size_t n_timed_orbits = 24;
constexpr std::int64_t lost = -1;  // a solver that has found no event: no label

/// The label of the trap that a state lies in, or 0.
std::int64_t trap_at(const label_plan& plan, std::size_t point, const double* state) {
    const auto find = [&](const std::vector<trap_interval>& traps, int n) -> std::int64_t {
        const auto n_here = static_cast<std::size_t>(n);
        for (const trap_interval& trap : std::span(traps).subspan(point * n_here, n_here)) {
            if (state[0] >= trap.lowest && state[0] <= trap.highest) return trap.label;
        }
        return 0;
    };
    if (plan.decided_by == decision::certificate) return find(plan.immediate, plan.n_immediate);
    if (plan.decided_by == decision::intervals) return find(plan.traps, plan.n_traps);
    const auto n_here = static_cast<std::size_t>(plan.n_ellipsoids);
    if (n_here == 0) return 0;
    for (const trap_ellipsoid& trap : std::span(plan.ellipsoids).subspan(point * n_here, n_here)) {
        if (holds(trap, state)) return trap.label;
    }
    return 0;
}

/// The intervals that a certificate proves, for solvers that have none: the immediate basins, and
/// the first branch, on which hopping dies.
void add_traps_of_certificate(const scene& what, label_plan& plan) {
    if (plan.decided_by != decision::certificate) return;
    add_immediate_basins(what, plan);
    const auto points = parameter_points(what, plan.point_axes);
    const std::size_t n = plan.immediate.size() / points.size();
    std::vector<trap_interval> traps;
    for (std::size_t point = 0; point < points.size(); ++point) {
        map_branch first;
        what.model->branch(0, points[point].data(), first);
        const trap_interval dies{0.0, first.end, plan.died_label};
        traps.push_back(dies);
        const auto basins = std::span(plan.immediate).subspan(point * n, n);
        traps.insert(traps.end(), basins.begin(), basins.end());
    }
    plan.immediate = traps;
    ++plan.n_immediate;
}

}  // namespace

labelled_cells::labelled_cells(const labelled_scene& which) {
    const std::filesystem::path scenes = HOPSCOTCH_SOURCE "/configs/scenes";
    const scene whole = read_scene(scenes / (which.scene + ".toml"), which.overrides);
    groups_.push_back(
        {whole, {}, audited_cells(whole, which.is_slow ? n_slow_grid_cells : n_grid_cells, 1), {}});
    group& grid = groups_.front();
    if (whole.question.has_labels) grid.plan = plan_labels(grid.what);
    if (!which.yardstick.empty()) add_traps_of_certificate(grid.what, grid.plan);
    add_boundaries(which);
    find_truth();
}

std::size_t labelled_cells::n_boundary() const {
    std::size_t n = 0;
    for (std::size_t i = 1; i < groups_.size(); ++i) n += groups_[i].cells.size();
    return n;
}

void labelled_cells::add_boundaries(const labelled_scene& which) {
    int n_left = which.is_slow ? n_slow_lines : n_lines;
    for (int i = 0; n_left > 0 && i < most_lines; ++i) {
        const double place = std::fmod(0.25 + 0.618033988749895 * i, 1.0);
        const scene line = hard::line_through(whole(), place);
        label_plan plan = line.question.has_labels ? plan_labels(line) : label_plan{};
        if (!which.yardstick.empty()) add_traps_of_certificate(line, plan);
        const kernel_choice kernel = kernel_of(line, "auto");
        const auto changes = hard::changes_on(line, plan, kernel, 60, n_changes);
        for (const double at : changes) add_around(line, plan, at);
        n_left -= changes.empty() ? 0 : 1;
    }
    if (n_boundary() == 0) throw std::runtime_error(which.name + ": no boundaries found");
}

/// Two cells at every distance, on either side.
void labelled_cells::add_around(const scene& line, const label_plan& plan, double at) {
    const scene_axis& axis = line.axes[0];
    for (int decade = 1; decade <= n_decades; ++decade) {
        const double away =
            std::fmax((axis.highest - axis.lowest) * std::pow(10.0, -decade), hard::ulp_of(at));
        const double low = std::fmax(at - away, axis.lowest);
        const double high = std::fmin(at + away, axis.highest);
        groups_.push_back({hard::part_of(line, low, high, 2), plan, {0, 1}, {}});
    }
}

labelled_cells::answer labelled_cells::precise(const group& of, std::uint64_t cell,
                                               precision value) const {
    const auto coordinates = coordinates_of(of.what, cell);
    owned_row row = row_of(of.what, of.plan, coordinates);
    row.row.tolerance = 0.0;
    const orbit_answer orbit = run_cell(of.what, of.plan, coordinates, value, row.row);
    return of.what.question.has_labels ? orbit.label : static_cast<answer>(orbit.returns);
}

void labelled_cells::find_truth() {
    std::atomic<std::size_t> n_wrong[2] = {0, 0};  // of double-double; grid, boundaries
    for (group& of : groups_) {
        const std::vector<answer> plain =
            answers(of, of.cells, kernel_of(of.what, "auto").run, 0.0);
        of.truth.resize(of.cells.size());
        tbb::parallel_for(std::size_t{0}, of.cells.size(), [&](std::size_t i) {
            const answer wide = precise(of, of.cells[i], precision::dd);
            of.truth[i] = wide;
            if (wide == plain[i]) return;
            of.truth[i] = precise(of, of.cells[i], precision::mp50);
            if (of.truth[i] != wide) ++n_wrong[&of == &groups_.front() ? 0 : 1];
        });
    }
    double_double_.grid = static_cast<double>(n_wrong[0]) / static_cast<double>(n_grid());
    double_double_.boundary = static_cast<double>(n_wrong[1]) / static_cast<double>(n_boundary());
}

double labelled_cells::double_double_cells_per_second() const {
    const group& grid = groups_.front();
    const std::size_t n = std::min(n_timed_orbits, grid.cells.size());
    const double seconds = seconds_of([&] {
        for (std::size_t i = 0; i < n; ++i) precise(grid, grid.cells[i], precision::dd);
    });
    return static_cast<double>(n) / seconds;
}

std::vector<labelled_cells::answer> labelled_cells::answers(const group& of,
                                                            const std::vector<std::uint64_t>& cells,
                                                            const kernel_run& kernel,
                                                            double tolerance) const {
    const std::size_t n = cells.size();
    cell_request request = request_of(of.what, of.plan, cells);
    std::vector<std::int16_t> label(n);
    std::vector<std::uint8_t> end(n);
    std::vector<std::uint32_t> returns(n);
    if (of.what.question.has_labels) request.request.label = label.data();
    request.request.outcome = end.data();
    request.request.returns = returns.data();
    request.request.tolerance = tolerance;
    run_labelled(of.what, of.plan, kernel, request.request);
    std::vector<answer> found(n);
    for (std::size_t i = 0; i < n; ++i) {
        found[i] = of.what.question.has_labels ? label[i] : static_cast<answer>(returns[i]);
    }
    return found;
}

double labelled_cells::difference(const std::vector<std::uint64_t>& cells, const kernel_run& one,
                                  double tolerance, const kernel_run& other) const {
    const group& grid = groups_.front();
    const std::vector<answer> left = answers(grid, cells, one, tolerance);
    const std::vector<answer> right = answers(grid, cells, other, 0.0);
    double n = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) n += left[i] != right[i] ? 1.0 : 0.0;
    return n / static_cast<double>(cells.size());
}

template <class Answers>
wrong_answers labelled_cells::wrong_share(const Answers& answers_of) const {
    double n_wrong[2] = {0.0, 0.0};  // grid, boundaries
    for (const group& of : groups_) {
        const std::vector<answer> found = answers_of(of);
        double& wrong = n_wrong[&of == &groups_.front() ? 0 : 1];
        for (std::size_t i = 0; i < found.size(); ++i) wrong += found[i] != of.truth[i] ? 1.0 : 0.0;
    }
    return {n_wrong[0] / static_cast<double>(n_grid()),
            n_wrong[1] / static_cast<double>(n_boundary())};
}

wrong_answers labelled_cells::of_kernel(const kernel_run& kernel, double tolerance) const {
    return wrong_share([&](const group& of) { return answers(of, of.cells, kernel, tolerance); });
}

void labelled_cells::compute(const std::vector<std::uint64_t>& cells, const kernel_run& kernel,
                             double tolerance) const {
    answers(groups_.front(), cells, kernel, tolerance);
}

wrong_answers labelled_cells::of_solver(const yardstick_maker& make, double tolerance,
                                        double& cells_per_second) const {
    return wrong_share([&](const group& of) {
        std::vector<answer> found;
        const double seconds = seconds_of([&] {
            for (const std::uint64_t cell : of.cells) {
                found.push_back(answer_of(of, cell, make, tolerance));
            }
        });
        if (&of == &groups_.front()) {
            cells_per_second = static_cast<double>(found.size()) / seconds;
        }
        return found;
    });
}

/// As the ensemble loop decides it, but that a certificate is replaced by the intervals it proves.
labelled_cells::answer labelled_cells::answer_of(const group& of, std::uint64_t cell,
                                                 const yardstick_maker& make,
                                                 double tolerance) const {
    const auto coordinates = coordinates_of(of.what, cell);
    const cell_start start = start_of(of.what, coordinates);
    const std::size_t point = point_index(of.what, of.plan, coordinates);
    const yardstick solver = make(start.parameters.data(), tolerance);
    double state[most_columns] = {};
    std::ranges::copy(start.columns, state);
    answer label = trap_at(of.plan, point, state);
    const answer most = most_returns_of(of.what);
    answer n_returns = 0;
    while (label == 0 && n_returns < most) {
        const yardstick_return got = solver(state);
        if (!got.returned) {
            label = got.lost ? lost : of.plan.died_label;
            break;
        }
        ++n_returns;
        std::copy_n(got.columns.begin(), start.columns.size(), state);
        label = trap_at(of.plan, point, state);
    }
    if (!of.what.question.has_labels) return n_returns;
    if (label == 0 && n_returns == most) {
        label = of.plan.chaotic_label(point, std::span(state, start.columns.size()));
    }
    return label;
}

}  // namespace hopscotch::bench
