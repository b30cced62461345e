// Draws starts, knows their returns, measures errors.
#include "bench/known_returns.hpp"

#include "analysis/truth/decimal.hpp"
#include "bench/report.hpp"

#include <algorithm>

namespace hopscotch::bench {

std::vector<yardstick_case>& all_cases() {
    static std::vector<yardstick_case> cases;
    return cases;
}

double accuracy::middle() const { return errors.empty() ? HUGE_VAL : median(errors); }

known_returns::known_returns(const yardstick_case& what, bool wants_time)
    : wants_time_(wants_time),
      invariant_(what.invariant),
      work_(what.model, what.section, what.parameters, what.options, wants_time) {
    work_.set_starts(uniform_rows(8 * n_starts, what.starts));
    if (what.settled_after > 0) work_.settle(what.settled_after);
    work_.keep_returning(n_starts);
    n_ = work_.size();
    truth_.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) {
        truth_[i].returns = work_.truth(i, truth_[i].columns, &truth_[i].time);
    }
    for (int c = 0; c < work_.n_columns(); ++c) {
        std::vector<double> sizes;
        for (const true_state& state : truth_) {
            if (state.returns) sizes.push_back(std::abs(state.columns[c]));
        }
        scale_.push_back(median(sizes));
    }
    std::vector<double> tiled;
    for (std::size_t copy = 0; copy < n_copies; ++copy) {
        tiled.insert(tiled.end(), work_.start(0), work_.start(0) + n_ * scale_.size());
    }
    work_.set_starts(tiled);
}

void known_returns::book(accuracy& result, std::size_t i, bool returned, const double* columns,
                         double time, double loss) const {
    result.n_starts += 1.0;
    if (returned != truth_[i].returns) {
        result.n_wrong += 1.0;
        return;
    }
    if (!returned) return;
    double worst = 0.0;
    for (std::size_t c = 0; c < scale_.size(); ++c) {
        double difference = std::abs(columns[c] - truth_[i].columns[c]);
        const double turn = work_.turn(static_cast<int>(c));
        if (turn > 0.0) difference = std::min(difference, std::abs(turn - difference));
        worst = std::fmax(worst, difference / std::fmax(std::abs(truth_[i].columns[c]), scale_[c]));
    }
    result.errors.push_back(worst);
    if (invariant_) {
        const double* parameters = work_.parameters().data();
        const double before = invariant_(work_.start(i), parameters);
        const double after = invariant_(columns, parameters) + loss;
        result.drifts.push_back(std::abs(after - before) / std::abs(before));
    }
    if (wants_time_ && truth_[i].time > 0.0 && std::isfinite(time)) {
        result.time_errors.push_back(std::abs(time - truth_[i].time) / truth_[i].time);
    }
}

accuracy known_returns::of_kernel(double tolerance) {
    work_.compute(work_.backends().front(), tolerance);
    accuracy result;
    for (std::size_t i = 0; i < n_; ++i) {
        double columns[most_columns];
        for (int c = 0; c < work_.n_columns(); ++c) columns[c] = work_.state(i, c);
        book(result, i, work_.is_ok(i), columns, work_.time(i), work_.loss(i));
    }
    return result;
}

accuracy known_returns::of_solver(const yardstick& solver) const {
    accuracy result;
    for (std::size_t i = 0; i < n_; ++i) {
        const yardstick_return got = solver(work_.start(i));
        book(result, i, got.returned, got.columns.data(), got.time, got.loss);
    }
    return result;
}

accuracy known_returns::of_double_double(std::size_t n) const {
    accuracy result;
    for (std::size_t i = 0; i < std::min(n, n_); ++i) {
        const orbit_answer wide = work_.precise(i, model_returns::digits::thirty_two);
        const orbit_answer truth = work_.precise(i, model_returns::digits::fifty);
        result.n_starts += 1.0;
        if (wide.end != truth.end) result.n_wrong += 1.0;
        if (wide.end != truth.end || truth.end != outcome::ok) continue;
        double worst = 0.0;
        for (std::size_t c = 0; c < scale_.size(); ++c) {
            const real50 there = parse_real<real50>(truth.columns[c]);
            const double error = to_double(parse_real<real50>(wide.columns[c]) - there);
            worst = std::fmax(worst,
                              std::abs(error) / std::fmax(std::abs(to_double(there)), scale_[c]));
        }
        result.errors.push_back(worst);
    }
    return result;
}

}  // namespace hopscotch::bench
