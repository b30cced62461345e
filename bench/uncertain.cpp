// Does every wrong label carry the flag `uncertain`? Per model, cells on lines across basin
// boundaries, at seven distances from one ulp (of the place of the boundary) to 4096, or around the
// flag's own displacement where a flow is integrated, and cells drawn from the scene's own grid.
//
// Truth is double-double, and 50 digits where that disagrees with the map. Every cell from the grid
// is evaluated; on the lines eight or more to a line, then half-way between differing ones down to
// neighbours, and every cell whose label is not that of the evaluated ones around it (for flagged
// cells alone at most 100 per line, so that `wrong` is a lower bound in fractal basins). So a cell
// without the flag counts as right unproven only where its label is the true one of evaluated cells
// on both sides: it could be wrong only in a true stripe that contains no evaluated cell and that
// the map does not show. How often that happens is measured: every 500th such cell is evaluated too
// (`checked`, `checked_wrong`). Exit code 1 where a wrong label lacks the flag.
//
// A million cells on lines per model and as many from the grid as `--seconds` (of processor time
// per model; 60) leave time for; `--cells` asks for fewer on lines. Names of cases limit the
// run.
#include "bench/report.hpp"
#include "tests/hard/uncertain_cases.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

struct wishes {
    std::uint64_t n_cells = 1'000'000;  // on lines
    double seconds = 60.0;              // for cells from the grid
};

/// Processor time of the whole process.
double used_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class stopwatch {
public:
    explicit stopwatch(double allowed) : end_(used_seconds() + allowed) {}
    bool is_over() const { return used_seconds() > end_; }

private:
    double end_;
};

void complain(const std::string& where, const cell_verdict& verdict) {
    fmt::print("WRONG AND NOT FLAGGED: {}: {} instead of {}\n", where, verdict.stored,
               verdict.computed);
}

/// Distances between the cells around a change.
std::vector<double> steps_at(const scene& line, double at) {
    double step = std::max(
        hard::ulp_of(at), displacement_of(line.axes[0].kind, at, 0.0, tolerance_of(line)) / 1024.0);
    std::vector<double> steps;
    for (int i = 0; i < 7; ++i, step *= 4.0) steps.push_back(step);
    return steps;
}

hard::tally around_boundaries(const hard::boundary_case& which, const scene& whole,
                              std::uint64_t n_wanted) {
    hard::tally found;
    hard::line_check how;
    how.stride = static_cast<std::size_t>(std::max(32, which.reach / 4));
    int n_empty = 0;  // lines in a row without a boundary
    for (int i = 0; found.cells < n_wanted && n_empty < 50; ++i, ++n_empty) {
        const scene line =
            hard::line_through(whole, hard::place_of_line(i), static_cast<std::size_t>(i));
        const label_plan plan = plan_labels(line);
        const kernel_choice kernel = kernel_of(line, "auto");
        for (const double at : hard::changes_on(line, plan, kernel, which.n_cells, 30)) {
            n_empty = 0;
            for (const double step : steps_at(line, at)) {
                const double reach = which.reach;
                const scene window = hard::part_of(line, at - reach * step, at + reach * step,
                                                   2 * static_cast<std::uint64_t>(which.reach) + 1);
                const auto told = [&](std::size_t cell, const cell_verdict& verdict) {
                    complain(fmt::format("{} line {} cell {} of {} around {:.17g}, {:.17g} apart",
                                         which.name, i, cell, window.n_cells(), at, step),
                             verdict);
                };
                found += hard::judge_line(window, plan, kernel, how, told);
                if (found.cells >= n_wanted) return found;
            }
        }
    }
    return found;
}

hard::tally on_the_grid(const hard::boundary_case& which, const scene& whole, double seconds) {
    const label_plan plan = plan_labels(whole);
    const kernel_choice kernel = kernel_of(whole, "auto");
    const stopwatch time(seconds);
    hard::tally found;
    for (std::uint64_t part = 1; found.cells < whole.n_cells() && !time.is_over(); ++part) {
        const std::vector<std::uint64_t> cells = audited_cells(whole, 200, part);
        found +=
            hard::judge_cells(whole, plan, kernel, cells, [&](std::size_t i, const auto& verdict) {
                complain(fmt::format("{} cell {}", which.name, cell_text(whole, cells[i])),
                         verdict);
            });
    }
    return found;
}

void put(const hard::boundary_case& which, const scene& scene, const char* kind,
         const hard::tally& found, double seconds) {
    const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
    json_line("uncertain")
        .add("case", which.name)
        .add("model", scene.info().name)
        .add("scene", which.scene)
        .add("cells_from", kind)
        .add("cells", number(found.cells))
        .add("flagged", number(found.flagged))
        .add("wrong", number(found.wrong))
        .add("wrong_unflagged", number(found.wrong_unflagged))
        .add("evaluated", number(found.evaluated))
        .add("checked", number(found.checked))
        .add("checked_wrong", number(found.checked_wrong))
        .add("processor_seconds", seconds)
        .print();
    fmt::print(
        "{:<28} {:<6} {:>8} cells {:>8} flagged {:>7} wrong, {} of them not flagged ({} evaluated, "
        "{} of {} wrong that were taken for right)\n",
        which.name, kind, found.cells, found.flagged, found.wrong, found.wrong_unflagged,
        found.evaluated, found.checked_wrong, found.checked);
    std::fflush(stdout);
}

/// \return wrong cells without the flag
std::uint64_t run(const hard::boundary_case& which, const wishes& wanted) {
    const scene whole = hard::scene_of(which, HOPSCOTCH_SOURCE);
    double begin = used_seconds();
    const hard::tally near = around_boundaries(which, whole, wanted.n_cells);
    put(which, whole, "lines", near, used_seconds() - begin);
    begin = used_seconds();
    const hard::tally grid = on_the_grid(which, whole, wanted.seconds);
    put(which, whole, "grid", grid, used_seconds() - begin);
    return near.wrong_unflagged + grid.wrong_unflagged;
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch;
    bench::wishes wanted;
    std::vector<std::string_view> names;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--seconds" && i + 1 < argc) {
            wanted.seconds = std::atof(argv[++i]);
        } else if (word == "--cells" && i + 1 < argc) {
            wanted.n_cells = std::strtoull(argv[++i], nullptr, 10);
        } else {
            names.push_back(word);
        }
    }
    std::uint64_t n_bad = 0;
    for (const hard::boundary_case& which : hard::all_cases()) {
        const std::string_view name = which.name;
        if (!names.empty() && std::find(names.begin(), names.end(), name) == names.end()) continue;
        n_bad += bench::run(which, wanted);
    }
    return n_bad == 0 ? 0 : 1;
}
