// What would float32 kernels gain? One return of the same starts by the unchanged kernels over
// AVX-512 packs of floats and of doubles, in one plain loop without refill, in turn. What float32
// answers wrongly is measured by work_precision.
#include "bench/model_returns.hpp"
#include "bench/report.hpp"
#include "bench/single_speed.hpp"
#include "host/run/backends.hpp"

#include <cmath>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_starts = 9600;
constexpr int n_rounds = 15;

struct single_case {
    std::string_view model;
    std::string_view section;
    std::vector<std::pair<double, double>> starts;
    named_numbers parameters = {};
    named_words options = {};
};

const single_case cases[] = {
    {"passive_hopper", "liftoff", {{0.0, 15.0}}, {{"mass_ratio", 1.0}}},
    {"mirror_planar", "apex", {{0.35, 0.65}, {0.35, 0.65}, {-0.3, 0.3}}, {}, {{"law", "solvable"}}},
};

void measure(const single_case& what) {
    model_returns work(what.model, what.section, what.parameters, what.options);
    work.set_starts(uniform_rows(2 * n_starts, what.starts));
    work.keep_returning(n_starts);
    std::vector<std::vector<double>> rows(static_cast<std::size_t>(work.n_columns()));
    std::vector<const double*> columns;
    for (std::size_t c = 0; c < rows.size(); ++c) {
        for (std::size_t i = 0; i < work.size(); ++i) rows[c].push_back(work.start(i)[c]);
        columns.push_back(rows[c].data());
    }
    columns.push_back(nullptr);
    const plain_loop loop = plain_loop_of(what.model);
    double sums[2] = {};
    const auto run = [&](plain_loop::function function) {
        return function(columns.data(), work.parameters().data(), work.size());
    };
    const auto seconds = alternate(
        {[&] { sums[0] = run(loop.in_double); }, [&] { sums[1] = run(loop.in_single); }}, n_rounds);
    const double scale = 1e9 / static_cast<double>(work.size());
    const double in_double = scale * median(seconds[0]);
    const double in_single = scale * median(seconds[1]);
    const double difference = std::abs(sums[1] - sums[0]) / std::abs(sums[0]);
    json_line("single_precision")
        .add("model", what.model)
        .add("ns_per_return_double", in_double)
        .add("ns_per_return_float32", in_single)
        .add("times_faster", in_double / in_single)
        .add("relative_difference_of_sums", difference)
        .print();
    fmt::print(
        "{:<16} double {:.1f} ns, float32 {:.1f} ns per return: {:.2f} times; sums differ by "
        "{:.1e}\n",
        what.model, in_double, in_single, in_double / in_single, difference);
}

}  // namespace
}  // namespace hopscotch::bench

int main() {
    using namespace hopscotch;
    const std::string reason = reason_against(backend::avx512);
    if (!reason.empty()) {
        fmt::print("single_precision: nothing is timed ({})\n", reason);
        return 77;
    }
    bench::stay_on_this_core();
    for (const bench::single_case& one : bench::cases) bench::measure(one);
}
