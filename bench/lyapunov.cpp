// What do Lyapunov exponents cost? A 1000 x 1000 map of the pneumatic map alpha E exp(-E) over
// thrust and stiffness, 1e4 returns per cell: the tangent ensemble against the bare iteration of
// the same cells, in one run on one core. Usage: lyapunov [CELLS], a random part of the map (9600)
#include "bench/report.hpp"
#include "host/run/estimate.hpp"
#include "host/run/requests.hpp"
#include "host/scene/grid.hpp"

#include <cstdlib>
#include <string>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::uint32_t n_returns = 10000;
constexpr int n_rounds = 5;

constexpr const char* chaos_map = R"([scene]
title = "Pneumatic map"
[model]
name = "raibert_pneumatic_simple"
[[grid.axis]]
name = "thrust"
min = 15.0
max = 90.0
cells = 1000
[[grid.axis]]
name = "stiffness"
min = 0.8
max = 8.0
cells = 1000
[grid]
section = "energy"
[start]
energy = 1.0
[question]
kind = "lyapunov"
returns = 9000
)";

/// The map's cells under another question.
cell_request cells_of(const scene& scene, const std::vector<std::uint64_t>& cells,
                      std::vector<std::uint8_t>& ends) {
    cell_request request = request_of(scene, {}, cells);
    request.request.outcome = ends.data();
    return request;
}

void measure(std::string_view backend_name, std::uint64_t n_cells) {
    const scene chaos = parse_scene(chaos_map, "lyapunov");
    const std::vector<std::string> bare{"question.kind=\"return_map\"",
                                        "question.returns=" + std::to_string(n_returns)};
    const scene plain = parse_scene(chaos_map, "return_map", bare);
    const std::vector<std::uint64_t> cells = sample_cells(chaos.n_cells(), n_cells, 1);
    std::vector<std::uint8_t> ends(n_cells);
    std::vector<double> energies(n_cells), exponents(n_cells), errors(n_cells);
    std::vector<std::uint8_t> motions(n_cells);
    cell_request with = cells_of(chaos, cells, ends);
    with.request.exponents.exponents[0] = exponents.data();
    with.request.exponents.standard_error = errors.data();
    with.request.exponents.motion = motions.data();
    cell_request without = cells_of(plain, cells, ends);
    without.request.state[0] = energies.data();
    const kernel_choice tangent = kernel_of(chaos, backend_name);
    const kernel_choice map = kernel_of(plain, backend_name);

    const auto seconds = alternate(
        {[&] { map.run(without.request); }, [&] { tangent.run(with.request); }}, n_rounds);
    const auto returns = static_cast<double>(n_cells) * n_returns;
    const double bare_ns = 1e9 * quantile(seconds[0], 0.0) / returns;
    const double exponent_ns = 1e9 * quantile(seconds[1], 0.0) / returns;
    json_line("lyapunov")
        .add("backend", backend_name)
        .add("cells", static_cast<double>(n_cells))
        .add("returns_per_cell", static_cast<double>(n_returns))
        .add("ns_per_return_bare", 1e9 * median(seconds[0]) / returns)
        .add("ns_per_return_bare_fastest", bare_ns)
        .add("ns_per_return", 1e9 * median(seconds[1]) / returns)
        .add("ns_per_return_fastest", exponent_ns)
        .add("share_of_bare_rate", median(seconds[0]) / median(seconds[1]))
        .add("share_of_bare_rate_fastest", bare_ns / exponent_ns)
        .print();
    fmt::print(
        "{:<7} {:.2f} ns per return with exponents, {:.2f} bare: {:.0f} % of the bare rate "
        "(fastest rounds {:.0f} %)\n",
        backend_name, 1e9 * median(seconds[1]) / returns, 1e9 * median(seconds[0]) / returns,
        100.0 * median(seconds[0]) / median(seconds[1]), 100.0 * bare_ns / exponent_ns);
}

}  // namespace
}  // namespace hopscotch::bench

int main(int argc, char** argv) {
    using namespace hopscotch;
    const std::uint64_t n_cells = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 9600;
    bench::stay_on_this_core();
    for (const backend which : {backend::avx512, backend::avx2, backend::scalar}) {
        if (reason_against(which).empty()) bench::measure(name_of(which), n_cells);
    }
}
