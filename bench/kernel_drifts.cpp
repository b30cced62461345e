// One return of many starts; no truth is needed.
#include "bench/kernel_drifts.hpp"

#include "bench/model_returns.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_starts = 2400;
constexpr int n_rounds = 5;

struct drift_case {
    std::string_view name;
    std::string_view model;
    std::string_view section;
    std::vector<std::pair<double, double>> starts;
    named_numbers parameters;
    bool is_integrated;
    double (*invariant)(const double* columns, const double* parameters);  // but for `loss`
};

/// Twice the lift-off's energy over the mass.
double square_of_speed(const double* columns, const double*) { return columns[0] * columns[0]; }

/// Energy over mass at touchdown, leg placed inertially: the hip is then leg_length
/// sin(touchdown_angle) high. Source: models/slip.md, section 6.
double energy_of_runner(const double* columns, const double* p) {
    const double speed = columns[0];
    const double pitch = columns[2];
    const double rate = columns[3];
    const double height = p[1] * std::sin(p[4]) - p[5] * std::cos(pitch);
    return 0.5 * speed * speed + p[3] * height + 0.5 * p[6] / p[0] * rate * rate;
}

const drift_case cases[] = {
    {"passive_juggler",
     "passive_juggler",
     "liftoff",
     {{0.0, 15.0}},
     {{"mass_ratio", 1.0}},
     false,
     square_of_speed},
    {"slip_pitching",
     "slip_pitching",
     "touchdown",
     {{8.0, 8.5}, {0.1, 0.15}, {-0.4, -0.2}, {-4.0, -2.0}},
     {{"leg_length", 1.5},
      {"stiffness", 100.0},
      {"touchdown_angle", 1.0},
      {"hip_offset", 0.15},
      {"inertia", 0.000225}},
     true,
     energy_of_runner},
};

std::vector<double> drifts_of(const drift_case& what, model_returns& work) {
    std::vector<double> drifts;
    const double* parameters = work.parameters().data();
    for (std::size_t i = 0; i < work.size(); ++i) {
        if (!work.is_ok(i)) continue;
        double columns[most_columns];
        for (int c = 0; c < work.n_columns(); ++c) columns[c] = work.state(i, c);
        const double before = what.invariant(work.start(i), parameters);
        const double after = what.invariant(columns, parameters) + work.loss(i);
        drifts.push_back(std::abs(after - before) / std::abs(before));
    }
    return drifts;
}

void put(const drift_case& what, model_returns& work, double tolerance) {
    for (const backend which : work.backends()) {
        const auto seconds = alternate({[&] { work.compute(which, tolerance); }}, n_rounds);
        const double us = 1e6 * median(seconds[0]) / static_cast<double>(work.size());
        const std::vector<double> drifts = drifts_of(what, work);
        json_line("work_precision")
            .add("case", what.name)
            .add("model", what.model)
            .add("method", name_of(which))
            .add("tolerance", tolerance)
            .add("us_per_return", us)
            .add("drift_median", median(drifts))
            .add("drift_worst", quantile(drifts, 1.0))
            .print();
        fmt::print("{:<26} {:<20} {:>8.0e} {:>12.4f} us  drift {:.1e} worst {:.1e}\n", what.name,
                   name_of(which), tolerance, us, median(drifts), quantile(drifts, 1.0));
        std::fflush(stdout);
    }
}

}  // namespace

void put_kernel_drifts(const std::function<bool(std::string_view)>& is_wanted) {
    for (const drift_case& one : cases) {
        if (!is_wanted(one.name)) continue;
        model_returns work(one.model, one.section, one.parameters);
        work.set_starts(uniform_rows(4 * n_starts, one.starts));
        work.keep_returning(n_starts);
        put(one, work, 0.0);
        for (int decade = 4; decade <= 13 && one.is_integrated; ++decade) {
            put(one, work, std::pow(10.0, -decade));
        }
    }
}

}  // namespace hopscotch::bench
