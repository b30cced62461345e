// How much faster and more right are the kernels than general ODE solvers doing the same returns?
// Per model (bench/systems/): same starts, same core, same run, in turn; work against precision.
//
// Every solver runs at a ladder of tolerances; the errors are measured against 50 digits. The ratio
// is taken at the loosest tolerance whose median error is at most the case's target (1e-10 for
// models with exact flows, whose kernels are then still more right; 1e-9 for integrated ones, whose
// kernels run at their own loosest sufficient tolerance). A result is wrong where the orbit ends
// instead of returning, or the other way round.
#include "bench/known_returns.hpp"
#include "bench/report.hpp"
#include "bench/yardstick_case.hpp"
#include "host/run/backends.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace hopscotch::bench {

namespace {

constexpr int n_rounds = 5;

/// One case with its kernels, starts and truth.
class comparison {
public:
    explicit comparison(const yardstick_case& what)
        : what_(what), known_(what, what.wants_time), work_(known_.work()) {}

    /// \param kernels_only  without the other solvers
    void run(bool kernels_only) {
        const double tolerance =
            what_.is_integrated && model_returns::takes_tolerance() ? kernel_tolerance() : 0.0;
        const accuracy ours = known_.of_kernel(tolerance);
        const double us = time_of_kernel(work_.backends().front(), tolerance);
        report("hopscotch", tolerance, ours, us);
        report_lanes(tolerance, us);
        if (kernels_only) return;
        for (const yardstick_case::solver& solver : what_.solvers) {
            const std::optional<double> chosen = climb(solver);
            if (chosen) compare(solver, *chosen, tolerance, ours);
            if (what_.fixed_tolerance > 0.0)
                compare(solver, what_.fixed_tolerance, tolerance, ours);
        }
    }

private:
    /// The loosest tolerance at which the kernel meets the target.
    double kernel_tolerance() {
        for (double tolerance = 1e-4; tolerance > 1e-14; tolerance *= std::sqrt(0.1)) {
            if (known_.of_kernel(tolerance).middle() <= what_.target_error) return tolerance;
        }
        return 0.0;
    }

    double time_of_kernel(backend which, double tolerance) {
        const auto seconds = alternate({[&] { work_.compute(which, tolerance); }}, n_rounds);
        return known_.per_return(median(seconds[0]), known_returns::n_copies);
    }
    /// Runs the ladder of tolerances up to the loosest that meets the target.
    std::optional<double> climb(const yardstick_case::solver& solver) {
        for (int rung = 8; rung <= 26; ++rung) {
            const double tolerance = std::pow(10.0, -0.5 * rung);
            const yardstick one = solver.make(work_.parameters().data(), tolerance);
            accuracy result;
            const double seconds = seconds_of([&] { result = known_.of_solver(one); });
            report(solver.name, tolerance, result, known_.per_return(seconds, 1));
            if (result.middle() <= what_.target_error) return tolerance;
        }
        return std::nullopt;
    }

    /// The solver and every kernel in turn.
    void compare(const yardstick_case::solver& solver, double theirs, double ours,
                 const accuracy& our_accuracy) {
        const std::vector<backend> kernels = work_.backends();
        const yardstick one = solver.make(work_.parameters().data(), theirs);
        const accuracy their_accuracy = known_.of_solver(one);
        std::vector<std::function<void()>> pieces;
        for (const backend which : kernels)
            pieces.emplace_back([this, which, ours] { work_.compute(which, ours); });
        pieces.emplace_back([&] {
            for (std::size_t i = 0; i < known_.size(); ++i) sum_ += one(work_.start(i)).columns[0];
        });
        const auto seconds = alternate(pieces, n_rounds);
        const double slow = known_.per_return(median(seconds.back()), 1);
        for (std::size_t k = 0; k < kernels.size(); ++k) {
            const double fast = known_.per_return(median(seconds[k]), known_returns::n_copies);
            json_line("yardsticks_ratio")
                .add("case", what_.name)
                .add("solver", solver.name)
                .add("kernel", name_of(kernels[k]))
                .add("target_error", what_.target_error)
                .add("tolerance", theirs)
                .add("kernel_tolerance", ours)
                .add("error_median", their_accuracy.middle())
                .add("kernel_error_median", our_accuracy.middle())
                .add("us_per_return", slow)
                .add("kernel_us_per_return", fast)
                .add("times_faster", slow / fast)
                .print();
            if (k > 0) continue;
            fmt::print(
                "{:<26} {} {:.4f} us per return (error {:.0e}) is {:.0f} times as fast as {} at "
                "{:.0e}: {:.2f} us (error {:.0e})\n",
                what_.name, name_of(kernels[k]), fast, our_accuracy.middle(), slow / fast,
                solver.name, theirs, slow, their_accuracy.middle());
            std::fflush(stdout);
        }
    }

    void report(std::string_view solver, double tolerance, const accuracy& result,
                double us_per_return) const {
        json_line("yardsticks")
            .add("case", what_.name)
            .add("solver", solver)
            .add("tolerance", tolerance)
            .add("starts", static_cast<double>(known_.size()))
            .add("us_per_return", us_per_return)
            .add("error_median", result.middle())
            .add("error_99", quantile(result.errors, 0.99))
            .add("error_worst", quantile(result.errors, 1.0))
            .add("wrong_share", result.wrong_share())
            .print();
    }

    /// What bounds a kernel: steps (events or integrator steps) per return and how full its lanes
    /// were.
    void report_lanes(double tolerance, double us_per_return) {
        const lane_statistics lanes = work_.compute(work_.backends().front(), tolerance);
        const double steps = static_cast<double>(lanes.useful) / static_cast<double>(work_.size());
        json_line("yardsticks_lanes")
            .add("case", what_.name)
            .add("kernel", name_of(work_.backends().front()))
            .add("tolerance", tolerance)
            .add("steps_per_return", steps)
            .add("lane_efficiency", lanes.efficiency())
            .add("us_per_return", us_per_return)
            .add("ns_per_step", 1e3 * us_per_return / steps)
            .print();
        fmt::print("{:<26} {:.4f} us per return, {:.2f} steps of {:.0f} ns, lanes {:.0f} % full\n",
                   what_.name, us_per_return, steps, 1e3 * us_per_return / steps,
                   100.0 * lanes.efficiency());
    }

    const yardstick_case& what_;
    known_returns known_;
    model_returns& work_;
    double sum_ = 0.0;  // keeps the solvers' work alive
};

}  // namespace
}  // namespace hopscotch::bench

/// Names of cases, or beginnings of them, limit the run to these; `--kernels` leaves out the other
/// solvers.
int main(int argc, char** argv) {
    using namespace hopscotch::bench;
    stay_on_this_core();
    std::vector<yardstick_case>& cases = all_cases();
    std::ranges::sort(cases, {}, &yardstick_case::name);
    std::vector<std::string_view> words(argv + 1, argv + argc);
    const bool kernels_only = std::erase(words, "--kernels") > 0;
    for (const yardstick_case& one : cases) {
        const auto is_named = [&](std::string_view word) { return one.name.starts_with(word); };
        if (!words.empty() && std::ranges::none_of(words, is_named)) continue;
        comparison(one).run(kernels_only);
    }
}
