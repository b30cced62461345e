// How long does one core take for one return of the passive hopper, and how right is it?
// Starts uniform on (0, 15), one return each; mass ratios 1 and 20; every kernel in turn, with and
// without the times of flight and contact. A flight ends at an impact: flights = returns + bounces.
#include "bench/hopper_returns.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_starts = 1 << 15;
constexpr std::size_t n_checked = 2000;
constexpr int n_rounds = 21;

struct timed_kernel {
    backend which;
    bool is_timed;
};

struct accuracy {
    double worst_relative = 0.0;
    double worst_rounding = 0.0;
    double typical_rounding = 0.0;
    int n_wrong = 0;  // stuck instead of a return, or the other way round
};

accuracy compare(const hopper_returns& work, const std::vector<true_return>& truth) {
    accuracy result;
    std::vector<double> rounding;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool returns = work.ends[i] == static_cast<std::uint8_t>(outcome::ok);
        if (returns != truth[i].returns) ++result.n_wrong;
        if (!returns || !truth[i].returns) continue;
        const return_error error = error_of(work.speeds[i], work.starts[i], truth[i]);
        result.worst_relative = std::max(result.worst_relative, error.relative);
        rounding.push_back(error.rounding);
    }
    result.worst_rounding = quantile(rounding, 1.0);
    result.typical_rounding = median(rounding);
    return result;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void report(double mass, const timed_kernel& kernel, const std::vector<double>& seconds,
            double flights, const accuracy& error, bool is_identical) {
    const auto n = static_cast<double>(n_starts);
    const double per_flight = 1e9 * median(seconds) / flights;
    const double fastest = 1e9 * quantile(seconds, 0.0) / flights;
    json_line("return_map")
        .add("backend", name_of(kernel.which))
        .add("mass_ratio", mass)
        .add("times", kernel.is_timed)
        .add("starts", n)
        .add("flights", flights)
        .add("rounds", static_cast<double>(seconds.size()))
        .add("ns_per_flight", per_flight)
        .add("ns_per_flight_fastest", fastest)
        .add("ns_per_return", 1e9 * median(seconds) / n)
        .add("checked", static_cast<double>(n_checked))
        .add("worst_relative_error_conditioned", error.worst_relative)
        .add("worst_rounding_error_conditioned", error.worst_rounding)
        .add("median_rounding_error_conditioned", error.typical_rounding)
        .add("wrong_outcomes", static_cast<double>(error.n_wrong))
        .add("bit_identical_to_first", is_identical)
        .print();
    fmt::print(
        "{:<7} M {:<3} {:<13} {:7.1f} ns per flight (fastest {:.1f}), {:7.1f} ns per return; "
        "error {:.1e} relative, {:.1f} roundings at most, {} wrong{}\n",
        name_of(kernel.which), mass, kernel.is_timed ? "with times" : "without times", per_flight,
        fastest, 1e9 * median(seconds) / n, error.worst_relative, error.worst_rounding,
        error.n_wrong, is_identical ? "" : ", NOT bit identical");
}

void measure(double mass) {
    hopper_returns work(mass, uniform_starts(n_starts));
    const double flights = work.count_flights();
    std::vector<true_return> truth;
    for (std::size_t i = 0; i < n_checked; ++i) truth.push_back(truth_of(work.starts[i], mass));

    std::vector<timed_kernel> kernels;
    std::vector<std::function<void()>> pieces;
    for (const backend which : cpu_backends()) {
        for (const bool is_timed : {false, true}) {
            kernels.push_back({which, is_timed});
            pieces.emplace_back([&work, which, is_timed] { work.compute(which, is_timed); });
        }
    }
    const auto seconds = alternate(pieces, n_rounds);
    pieces.front()();
    const std::vector<double> first = work.speeds;
    for (std::size_t i = 0; i < kernels.size(); ++i) {
        pieces[i]();
        report(mass, kernels[i], seconds[i], flights, compare(work, truth),
               same_bits(first, work.speeds));
    }
}

}  // namespace
}  // namespace hopscotch::bench

int main() {
    hopscotch::bench::stay_on_this_core();
    for (const double mass : {1.0, 20.0}) hopscotch::bench::measure(mass);
}
