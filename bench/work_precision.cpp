// What does accuracy cost? Per model, one return of the same starts by every method, tolerance and
// precision offered: microseconds against error of state and time, share of wrong outcomes, and
// drift of what a return conserves (energy with what impacts took from it; a runner's speed). Then
// whole orbits of a scene: cells per second against the share of wrong labels (label_curves.hpp).
//
// Kernels (all backends; a ladder of tolerances where flows are integrated), single orbits in
// double-double and 50 digits, and the yardsticks of bench/systems/. Errors are measured against 50
// digits; bench/draw_work_precision.py draws the lines that this prints.
#include "bench/kernel_drifts.hpp"
#include "bench/known_returns.hpp"
#include "bench/label_curves.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr int n_rounds = 5;
constexpr std::size_t n_precise = 24;  // starts of the slow arithmetics

void put(const yardstick_case& what, std::string_view method, double tolerance,
         const accuracy& result, double us_per_return) {
    const auto share_of = [](const std::vector<double>& errors, double share) {
        return errors.empty() ? HUGE_VAL : quantile(errors, share);
    };
    json_line line("work_precision");
    line.add("case", what.name)
        .add("model", what.model)
        .add("method", method)
        .add("tolerance", tolerance)
        .add("us_per_return", us_per_return)
        .add("returns_per_second", 1e6 / us_per_return)
        .add("error_median", share_of(result.errors, 0.5))
        .add("error_worst", share_of(result.errors, 1.0))
        .add("wrong_share", result.wrong_share());
    if (!result.time_errors.empty()) {
        line.add("time_error_median", share_of(result.time_errors, 0.5))
            .add("time_error_worst", share_of(result.time_errors, 1.0));
    }
    if (!result.drifts.empty()) {
        line.add("drift_median", share_of(result.drifts, 0.5))
            .add("drift_worst", share_of(result.drifts, 1.0));
    }
    line.print();
    fmt::print("{:<26} {:<20} {:>8.0e} {:>12.4f} us  error {:.1e} worst {:.1e}  wrong {:.3f}\n",
               what.name, method, tolerance, us_per_return, share_of(result.errors, 0.5),
               share_of(result.errors, 1.0), result.wrong_share());
    std::fflush(stdout);
}

/// Every backend in turn; they give the same bits, so one error serves them all.
void run_kernels(const yardstick_case& what, known_returns& known, double tolerance) {
    const accuracy result = known.of_kernel(tolerance);
    model_returns& work = known.work();
    std::vector<std::function<void()>> pieces;
    for (const backend which : work.backends()) {
        pieces.emplace_back([&work, which, tolerance] { work.compute(which, tolerance); });
    }
    const auto seconds = alternate(pieces, n_rounds);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const double us = known.per_return(median(seconds[k]), known_returns::n_copies);
        put(what, name_of(work.backends()[k]), tolerance, result, us);
    }
}

void run_precise(const yardstick_case& what, const known_returns& known,
                 const model_returns& work) {
    const std::size_t n = std::min(n_precise, known.size());
    const auto us_of = [&](model_returns::digits digits) {
        const double seconds = seconds_of([&] {
            for (std::size_t i = 0; i < n; ++i) work.precise(i, digits);
        });
        return 1e6 * seconds / static_cast<double>(n);
    };
    put(what, "double-double", 0.0, known.of_double_double(n),
        us_of(model_returns::digits::thirty_two));
    json_line("work_precision")
        .add("case", what.name)
        .add("model", what.model)
        .add("method", "50 digits")
        .add("us_per_return", us_of(model_returns::digits::fifty))
        .print();
}

void run(const yardstick_case& what) {
    known_returns known(what, true);
    run_kernels(what, known, 0.0);
    for (int decade = 4; decade <= 13 && what.is_integrated; ++decade) {
        run_kernels(what, known, std::pow(10.0, -decade));
    }
    run_precise(what, known, known.work());
    for (const yardstick_case::solver& solver : what.solvers) {
        for (int decade = 4; decade <= 13; ++decade) {
            const double tolerance = std::pow(10.0, -decade);
            const yardstick one = solver.make(known.work().parameters().data(), tolerance);
            accuracy result;
            const double seconds = seconds_of([&] { result = known.of_solver(one); });
            put(what, solver.name, tolerance, result, known.per_return(seconds, 1));
        }
    }
}

}  // namespace
}  // namespace hopscotch::bench

/// Names of cases, or beginnings of them, limit the run to these.
int main(int argc, char** argv) {
    using namespace hopscotch::bench;
    stay_on_this_core();
    std::vector<yardstick_case>& cases = all_cases();
    std::ranges::sort(cases, {}, &yardstick_case::name);
    const auto is_wanted = [&](std::string_view name) {
        const auto begins_so = [&](const char* word) { return name.starts_with(word); };
        return argc < 2 || std::any_of(argv + 1, argv + argc, begins_so);
    };
    for (const yardstick_case& one : cases) {
        if (is_wanted(one.name)) run(one);
    }
    put_kernel_drifts(is_wanted);
    for (const labelled_scene& one : labelled_scenes()) {
        if (is_wanted(one.name)) put_label_curves(one);
    }
}
