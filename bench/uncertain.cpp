// Does every wrong label carry the flag `uncertain`? Per model, cells around basin boundaries (one
// ulp apart, and a sixteenth of the flag's displacement apart where that is more) and cells drawn
// from the scene's own grid: how many are flagged, how many are wrong (against double-double,
// disputed ones against 50 digits), how many wrong ones lack the flag. Exit code 1 where one does.
//
// Half a million cells of either kind per model, or as many as `--seconds` (of processor time per
// model and kind; 150) leave time for. Names of cases, or beginnings of them, limit the run.
#include "bench/report.hpp"
#include "tests/hard/uncertain_cases.hpp"

#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::uint64_t n_wanted = 500'000;  // cells of either kind

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
    const scene_axis& axis = line.axes[0];
    const double size = std::max(std::abs(axis.lowest), std::abs(axis.highest));
    const double ulp = hard::ulp_of(at);
    const double sixteenth = displacement_of(at, size, tolerance_of(line)) / 16.0;
    if (sixteenth > 4.0 * ulp) return {ulp, sixteenth};
    return {ulp};
}

hard::tally around_boundaries(const hard::boundary_case& which, const scene& whole,
                              const stopwatch& time) {
    hard::tally found;
    for (int i = 0; found.cells < n_wanted && !time.is_over(); ++i) {
        const scene line = hard::line_through(whole, hard::place_of_line(i));
        const label_plan plan = line.question.has_labels ? plan_labels(line) : label_plan{};
        const kernel_choice kernel = kernel_of(line, "auto");
        for (const double at : hard::changes_on(line, plan, kernel, which.n_cells, 100)) {
            for (const double step : steps_at(line, at)) {
                if (found.cells >= n_wanted || time.is_over()) return found;
                found += hard::judge_around(
                    line, plan, kernel, at, step, [&](std::size_t cell, const auto& verdict) {
                        const double x = at + (static_cast<double>(cell) - hard::reach) * step;
                        complain(fmt::format("{} line {} at {:.17g}", which.name, i, x), verdict);
                    });
            }
        }
    }
    return found;
}

hard::tally on_the_grid(const hard::boundary_case& which, const scene& whole,
                        const stopwatch& time) {
    const label_plan plan = whole.question.has_labels ? plan_labels(whole) : label_plan{};
    const kernel_choice kernel = kernel_of(whole, "auto");
    hard::tally found;
    for (std::uint64_t part = 1; found.cells < n_wanted && !time.is_over(); ++part) {
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
        .add("processor_seconds", seconds)
        .print();
    fmt::print("{:<28} {:<10} {:>7} cells {:>7} flagged {:>7} wrong, {} of them not flagged\n",
               which.name, kind, found.cells, found.flagged, found.wrong, found.wrong_unflagged);
    std::fflush(stdout);
}

/// \return wrong cells without the flag
std::uint64_t run(const hard::boundary_case& which, double seconds) {
    const scene whole = hard::scene_of(which, HOPSCOTCH_SOURCE);
    double begin = used_seconds();
    const hard::tally near = around_boundaries(which, whole, stopwatch(seconds));
    put(which, whole, "boundaries", near, used_seconds() - begin);
    begin = used_seconds();
    const hard::tally grid = on_the_grid(which, whole, stopwatch(seconds));
    put(which, whole, "grid", grid, used_seconds() - begin);
    return near.wrong_unflagged + grid.wrong_unflagged;
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch;
    double seconds = 150.0;
    std::vector<std::string_view> names;
    for (int i = 1; i < argc; ++i) {
        if (std::string_view(argv[i]) == "--seconds" && i + 1 < argc) {
            seconds = std::atof(argv[++i]);
        } else {
            names.emplace_back(argv[i]);
        }
    }
    std::uint64_t n_bad = 0;
    for (const hard::boundary_case& which : hard::all_cases()) {
        const std::string_view name = which.name;
        const auto is_named = [&](std::string_view word) { return name.starts_with(word); };
        if (!names.empty() && std::none_of(names.begin(), names.end(), is_named)) continue;
        n_bad += bench::run(which, seconds);
    }
    return n_bad == 0 ? 0 : 1;
}
