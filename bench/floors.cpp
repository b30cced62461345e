// How near does a return come to what its operations cost? Per model: elementary functions,
// divisions, square roots and all other operations of a return, counted by its kernel over counting
// doubles; the time that they take at their measured throughput, costly ones alone and all of them
// one after the other; and the return's own time, on every target: of orbits of one return, with
// everything that a start costs, and of up to 16.
#include "bench/elementary.hpp"
#include "bench/model_returns.hpp"
#include "bench/operation_times.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_starts = 4800;
constexpr std::size_t n_counted = 600;
constexpr int n_rounds = 9;
constexpr std::uint32_t n_long_returns = 16;
constexpr double tolerance = 1e-10;  // the default of scenes

struct floor_case {
    std::string_view name;
    std::string_view model;
    std::string_view section;
    std::vector<std::pair<double, double>> starts;
    named_numbers parameters = {};
    named_words options = {};
    std::uint32_t settled_after = 0;  // returns before the measurement
};

constexpr double hopper_frequency = 30.0;

const floor_case cases[] = {
    {"passive_hopper, M = 1", "passive_hopper", "liftoff", {{0.0, 15.0}}, {{"mass_ratio", 1.0}}},
    {"passive_hopper, M = 20", "passive_hopper", "liftoff", {{0.0, 15.0}}, {{"mass_ratio", 20.0}}},
    {"passive_juggler", "passive_juggler", "liftoff", {{0.0, 15.0}}, {{"mass_ratio", 1.0}}},
    {"raibert_pneumatic, friction", "raibert_pneumatic", "touchdown", {{0.8, 4.0}}},
    {"raibert_pneumatic, frictionless",
     "raibert_pneumatic",
     "touchdown",
     {{0.8, 4.0}},
     {{"friction", 0.0}}},
    {"raibert_pneumatic_simple",
     "raibert_pneumatic_simple",
     "energy",
     {{0.1, 3.0}},
     {{"gain", 2.0}}},
    {"raibert_linear",
     "raibert_linear",
     "touchdown",
     {{1.0, 6.0}},
     {{"stiffness", 200.0}, {"rest_height", 0.55}}},
    {"raibert_linear_simple", "raibert_linear_simple", "touchdown", {{0.5, 3.0}}},
    {"openloop_hopper",
     "openloop_hopper",
     "strobe",
     {{-4.0 / (hopper_frequency * hopper_frequency), 2.0 / (hopper_frequency * hopper_frequency)},
      {-3.0 / hopper_frequency, 3.0 / hopper_frequency}},
     {{"natural_frequency", hopper_frequency},
      {"damping_ratio", 0.2},
      {"thrust", 1.55},
      {"thrust_time", 0.08},
      {"stride_period", 0.26}}},
    {"slip",
     "slip",
     "touchdown",
     {{4.0, 8.0}, {0.05, 0.6}},
     {{"leg_length", 1.5}, {"stiffness", 100.0}, {"touchdown_angle", 1.25}},
     {{"stance_gravity", "off"}}},
    {"slip, gravity in stance",
     "slip",
     "touchdown",
     {{8.0, 12.0}, {0.05, 0.6}},
     {{"leg_length", 1.5}, {"stiffness", 100.0}, {"touchdown_angle", 1.0}}},
    {"slip_pitching",
     "slip_pitching",
     "touchdown",
     {{8.0, 8.5}, {0.1, 0.15}, {-0.4, -0.2}, {-4.0, -2.0}},
     {{"leg_length", 1.5},
      {"stiffness", 100.0},
      {"touchdown_angle", 1.0},
      {"hip_offset", 0.15},
      {"inertia", 0.000225}}},
    {"mirror_line", "mirror_line", "apex", {{0.2, 0.8}}},
    {"mirror_planar, solvable law",
     "mirror_planar",
     "apex",
     {{0.35, 0.65}, {0.35, 0.65}, {-0.3, 0.3}},
     {},
     {{"law", "solvable"}}},
    {"mirror_spatial, solvable law",
     "mirror_spatial",
     "apex",
     {{0.35, 0.65}, {-0.1, 0.1}, {0.35, 0.65}, {-0.3, 0.3}, {-0.3, 0.3}},
     {},
     {{"law", "solvable"}}},
    {"paddle_juggler",
     "paddle_juggler",
     "impact",
     {{0.0, 6.28}, {2.0, 12.0}},
     {{"amplitude", 4.0}, {"restitution", 0.8}}},
    {"relief_valve", "relief_valve", "maximum", {{0.2, 6.0}, {0.0, 20.0}}, {}, {}, 32},
};

void put(const floor_case& what, std::uint32_t returns, const counted_work& each, backend which,
         const operation_times& times, double ns, double efficiency) {
    const double costly = times.costly_floor(each);
    const double whole = times.whole_floor(each);
    json_line line("floors");
    line.add("case", what.name)
        .add("model", what.model)
        .add("kernel", name_of(which))
        .add("returns_per_start", static_cast<double>(returns));
    for (std::size_t i = 0; i < n_counted_functions; ++i) {
        line.add(elementary_names[i], each.functions[i]);
    }
    line.add("divisions", each.outside_divisions)
        .add("square_roots", each.outside_square_roots)
        .add("fma", each.outside_fused)
        .add("sums_and_products", each.outside_sums)
        .add("comparisons", each.outside_comparisons)
        .add("selections", each.outside_selections)
        .add("roundings", each.outside_roundings)
        .add("costly_floor_ns", costly)
        .add("floor_ns", whole)
        .add("ns_per_return", ns)
        .add("times_costly_floor", ns / costly)
        .add("times_floor", ns / whole)
        .add("lane_efficiency", efficiency)
        .print();
    fmt::print(
        "{:<32} {:>2} returns {:<7} {:9.2f} ns, floor {:8.2f} (costly alone {:8.2f}): {:.2f} "
        "times\n",
        what.name, returns, name_of(which), ns, whole, costly, ns / whole);
    std::fflush(stdout);
}

void put(backend which, const operation_times& times) {
    json_line line("floors");
    line.add("kernel", name_of(which))
        .add("fma_ns", times.fused)
        .add("sum_or_product_ns", times.plain)
        .add("comparison_and_selection_ns", times.comparison_and_selection)
        .add("rounding_ns", times.rounding)
        .add("division_ns", times.division)
        .add("square_root_ns", times.square_root);
    for (std::size_t i = 0; i < n_counted_functions; ++i) {
        line.add(fmt::format("{}_ns", elementary_names[i]), times.functions[i]);
    }
    line.print();
    fmt::print(
        "{:<7} ns per element: fma {:.3f}, sum or product {:.3f}, comparison and selection {:.3f}, "
        "division {:.3f}, square root {:.3f}, sin_cos {:.3f}\n",
        name_of(which), times.fused, times.plain, times.comparison_and_selection, times.division,
        times.square_root, times.functions[0]);
}

/// Runs a request on one kernel and knows how many returns it has made.
class timed_work {
public:
    timed_work(const model_entry& model, model_returns& of, std::uint32_t returns)
        : model_(model),
          variant_(of.variant()),
          request_(of.request(tolerance, returns)),
          returns_(of.size()) {
        request_.returns = returns_.data();
    }
    lane_statistics run(backend which) { return model_.kernel(which, variant_)(request_); }
    counted_work count() {
        const counted_work all = count_work(model_.info->name, variant_, request_);
        return all.per(n_returns());
    }
    double n_returns() const { return std::accumulate(returns_.begin(), returns_.end(), 0.0); }

private:
    const model_entry& model_;
    int variant_;
    ensemble_request request_;
    std::vector<std::uint32_t> returns_;
};

/// One row per model, length of orbit and target; a target's operations are timed next to its
/// kernel.
void measure(const floor_case& what) {
    const model_entry& model = *find_model(what.model);
    model_returns few(what.model, what.section, what.parameters, what.options);
    few.set_starts(uniform_rows(4 * n_starts, what.starts));
    if (what.settled_after > 0) few.settle(what.settled_after);
    model_returns many = few;
    few.keep_returning(n_counted);
    many.keep_returning(n_starts);
    for (const std::uint32_t returns : {1u, n_long_returns}) {
        const counted_work each = timed_work(model, few, returns).count();
        timed_work work(model, many, returns);
        for (const backend which : many.backends()) {
            const operation_times times = measure_operations(which);
            lane_statistics lanes;
            const auto seconds = alternate({[&] { lanes = work.run(which); }}, n_rounds);
            put(what, returns, each, which, times,
                1e9 * quantile(seconds[0], 0.0) / work.n_returns(), lanes.efficiency());
        }
    }
}

}  // namespace
}  // namespace hopscotch::bench

/// Names of cases, or beginnings of them, limit the run to these.
int main(int argc, char** argv) {
    using namespace hopscotch::bench;
    stay_on_this_core();
    for (const hopscotch::backend which : model_returns("mirror_line", "apex", {}).backends()) {
        put(which, measure_operations(which));
    }
    for (const floor_case& one : cases) {
        const auto is_named = [&](const char* word) { return one.name.starts_with(word); };
        if (argc < 2 || std::any_of(argv + 1, argv + argc, is_named)) measure(one);
    }
}
