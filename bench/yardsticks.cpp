// How do Boost.odeint and SUNDIALS CVODE do the passive hopper's flights, and how much faster and
// more right are the kernels? Same starts, same core, same run, in turn; work against precision.
//
// Two jobs, each against the kernel that does the same: flights with contact in closed form by
// energy (kernel without times), and flights with contact integrated to lift-off (kernel with
// times). A result is wrong where the orbit gets stuck instead of lifting off (or the other way
// round), or where the number of impacts is not the true one: an event missed, doubled or invented.
#include "bench/hopper_returns.hpp"
#include "bench/report.hpp"
#include "host/run/backends.hpp"

#ifdef HOPSCOTCH_BENCH_ODEINT
#include "bench/yardstick_odeint.hpp"
#endif
#ifdef HOPSCOTCH_BENCH_CVODE
#include "bench/yardstick_cvode.hpp"
#endif

#include <memory>

#include <fmt/format.h>

namespace hopscotch::bench {
namespace {

constexpr std::size_t n_starts = 600;
constexpr int n_kernel_calls =
    20;  // per timing, so that the fast side is timed as long as a clock needs
constexpr int n_rounds = 5;

/// What one solver made of all starts.
struct work_precision {
    std::string name;
    double tolerance = 0.0;
    double us_closed = 0.0;      // per flight, contact by energy
    double us_integrated = 0.0;  // per flight, contact integrated
    double n_wrong = 0.0;
    std::vector<double> speed_errors;  // |f - truth| where the outcome is right
    std::vector<double> conditioned;   // the same over the larger of |f| and |f'| alpha
    std::vector<double> time_errors;   // of the whole return
};

struct answer {
    bool returns;
    double speed, time, impacts;
};

void book(work_precision& row, const answer& got, double start, const true_return& truth) {
    if (got.returns != truth.returns || got.impacts != truth.bounces + 1.0) {
        row.n_wrong += 1.0;
        return;
    }
    if (!truth.returns) return;
    const return_error error = error_of(got.speed, start, truth);
    row.speed_errors.push_back(error.absolute);
    row.conditioned.push_back(error.relative);
    row.time_errors.push_back(std::abs(got.time - truth.time));
}

void print(const work_precision& row, double mass) {
    const double wrong = row.n_wrong / static_cast<double>(n_starts);
    json_line("yardsticks")
        .add("solver", row.name)
        .add("mass_ratio", mass)
        .add("tolerance", row.tolerance)
        .add("starts", static_cast<double>(n_starts))
        .add("us_per_flight_contact_closed", row.us_closed)
        .add("us_per_flight_contact_timed", row.us_integrated)
        .add("wrong_share", wrong)
        .add("speed_error_median", median(row.speed_errors))
        .add("speed_error_99", quantile(row.speed_errors, 0.99))
        .add("speed_error_worst", quantile(row.speed_errors, 1.0))
        .add("speed_error_conditioned_worst", quantile(row.conditioned, 1.0))
        .add("time_error_median", median(row.time_errors))
        .add("time_error_99", quantile(row.time_errors, 0.99))
        .add("time_error_worst", quantile(row.time_errors, 1.0))
        .print();
    fmt::print(
        "M {:<3} {:<44} {:>7} {:9.3f} / {:9.3f} us per flight (contact closed / timed), "
        "wrong {:.2f} %, error of f median {:.1e} 99 % {:.1e}, of time {:.1e} {:.1e}\n",
        mass, row.name, row.tolerance > 0.0 ? fmt::format("{:.0e}", row.tolerance) : "exact",
        row.us_closed, row.us_integrated, 100.0 * wrong, median(row.speed_errors),
        quantile(row.speed_errors, 0.99), median(row.time_errors), quantile(row.time_errors, 0.99));
}

void print_ratio(const work_precision& theirs, const work_precision& ours, double mass,
                 bool is_shown) {
    json_line("yardsticks_ratio")
        .add("solver", theirs.name)
        .add("kernel", ours.name)
        .add("mass_ratio", mass)
        .add("tolerance", theirs.tolerance)
        .add("times_faster_contact_closed", theirs.us_closed / ours.us_closed)
        .add("times_faster_contact_timed", theirs.us_integrated / ours.us_integrated)
        .add("wrong_share_theirs", theirs.n_wrong / static_cast<double>(n_starts))
        .add("wrong_share_ours", ours.n_wrong / static_cast<double>(n_starts))
        .print();
    if (!is_shown) return;
    fmt::print("M {:<3} {} is {:.0f} times as fast as {} at {:.0e} (contact timed: {:.0f})\n", mass,
               ours.name, theirs.us_closed / ours.us_closed, theirs.name, theirs.tolerance,
               theirs.us_integrated / ours.us_integrated);
}

/// Everything that is measured at one mass ratio. Every piece of work runs once per round.
class comparison {
public:
    explicit comparison(double mass) : work_(mass, uniform_starts(n_starts)) {
        flights_ = work_.count_flights();
        for (const double alpha : work_.starts) truth_.push_back(truth_of(alpha, mass));
        for (const backend which : cpu_backends()) add_kernel(which);
#ifdef HOPSCOTCH_BENCH_ODEINT
        add_solvers<odeint_solver>();
#endif
#ifdef HOPSCOTCH_BENCH_CVODE
        add_solvers<cvode_solver>();
#endif
    }

    void run() {
        const auto seconds = alternate(pieces_, n_rounds);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const double calls = i < n_kernels_ ? n_kernel_calls : 1.0;
            rows_[i].us_closed = 1e6 * median(seconds[2 * i]) / (calls * flights_);
            rows_[i].us_integrated = 1e6 * median(seconds[2 * i + 1]) / (calls * flights_);
            print(rows_[i], work_.mass_ratio);
        }
        for (std::size_t i = n_kernels_; i < rows_.size(); ++i) {
            for (std::size_t k = 0; k < n_kernels_; ++k) {
                print_ratio(rows_[i], rows_[k], work_.mass_ratio, k == 0);
            }
        }
    }

private:
    void add_kernel(backend which) {
        work_precision row{.name = "hopscotch " + std::string(name_of(which))};
        for (const bool is_timed : {false, true}) {
            pieces_.emplace_back([this, which, is_timed] {
                for (int i = 0; i < n_kernel_calls; ++i) work_.compute(which, is_timed);
            });
        }
        work_.count_flights();
        work_.compute(which, true);
        for (std::size_t i = 0; i < n_starts; ++i) {
            const bool returns = work_.ends[i] == static_cast<std::uint8_t>(outcome::ok);
            book(row, {returns, work_.speeds[i], work_.times[i], work_.bounces[i] + 1.0},
                 work_.starts[i], truth_[i]);
        }
        rows_.push_back(row);
        n_kernels_ = rows_.size();
    }

    template <class Solver>
    void add_solvers() {
        for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
            auto solver = std::make_shared<Solver>(physical_hopper{work_.mass_ratio}, tolerance);
            work_precision row{.name = Solver::name, .tolerance = tolerance};
            for (const contact_rule rule : {contact_rule::by_energy, contact_rule::integrated}) {
                pieces_.emplace_back([this, solver, rule] {
                    for (const double alpha : work_.starts) {
                        sum_ += one_return(*solver, alpha, rule).speed;
                    }
                });
            }
            for (std::size_t i = 0; i < n_starts; ++i) {
                const physical_return got =
                    one_return(*solver, work_.starts[i], contact_rule::integrated);
                book(row,
                     {got.end == return_end::lifted, got.speed, got.time,
                      got.end == return_end::lost ? -1.0 : static_cast<double>(got.impacts)},
                     work_.starts[i], truth_[i]);
            }
            rows_.push_back(row);
        }
    }

    hopper_returns work_;
    double flights_ = 0.0;
    double sum_ = 0.0;  // keeps the solvers' work alive
    std::vector<true_return> truth_;
    std::vector<std::function<void()>> pieces_;  // two per row: contact closed, contact timed
    std::vector<work_precision> rows_;
    std::size_t n_kernels_ = 0;
};

}  // namespace
}  // namespace hopscotch::bench

int main() {
    hopscotch::bench::stay_on_this_core();
    for (const double mass : {1.0, 20.0}) hopscotch::bench::comparison(mass).run();
}
