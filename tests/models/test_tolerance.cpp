// What accuracy.tolerance promises, for every integrated model: the error of a return follows it,
// steps grow with it, all backends agree at it, and at the default an orbit is decided wrongly only
// within 1e-8 of a boundary. Truth: 50 digits, which keep their own tolerance.
#include "analysis/orbit/orbit_functions.hpp"
#include "kernels/contract/entry.hpp"
#include "tests/models/passive_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

constexpr double standard = 1e-10;  // the default of scenes and of eval

/// An integrated model with a box of starts.
struct integrated {
    const char* name;
    const char* model;
    std::vector<int> options;
    std::vector<std::pair<const char*, double>> set;
    std::vector<std::pair<double, double>> starts;  // of each column
};

void PrintTo(const integrated& which, std::ostream* to) { *to << which.name; }

const std::vector<integrated>& all_integrated() {
    static const std::vector<integrated> all{
        {"slip_linear", "slip", {0, 0}, {}, {{2, 8}, {0.1, 0.9}}},
        {"slip_air", "slip", {1, 0}, {{"stiffness", 80.0}}, {{2, 8}, {0.1, 0.9}}},
        {"slip_pitching_linear",
         "slip_pitching",
         {0, 0},
         {},
         {{2, 8}, {0.1, 0.9}, {-0.2, 0.2}, {-1, 1}}},
        {"slip_pitching_air",
         "slip_pitching",
         {1, 0},
         {{"stiffness", 80.0}},
         {{2, 8}, {0.1, 0.9}, {-0.2, 0.2}, {-1, 1}}},
        {"raibert_pneumatic", "raibert_pneumatic", {}, {}, {{0.05, 6}}},
        {"relief_valve", "relief_valve", {}, {}, {{0.2, 12}, {0, 20}}},
    };
    return all;
}

struct computed {
    std::vector<outcome> end;
    std::vector<std::vector<double>> state;  // [column][row]
    std::vector<double> events;
    double steps = 0.0;  // per row
};

/// Rows of one model, in its section 0.
class rows_of {
public:
    explicit rows_of(const integrated& which) : model_(*find_model(which.model)) {
        for (const parameter_info& parameter : model_.info->parameters) {
            parameters_.push_back(parameter.standard);
            for (const auto& [name, value] : which.set) {
                if (parameter.name == name) parameters_.back() = value;
            }
        }
        options_.assign(most_options, 0);
        std::copy(which.options.begin(), which.options.end(), options_.begin());
        variant_ = model_.variant({parameters_.data(), parameters_.data(), options_.data()});
        columns_.resize(which.starts.size());
    }

    void add(const std::vector<double>& start) {
        for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].push_back(start[c]);
    }
    std::size_t size() const { return columns_[0].size(); }
    const model_entry& model() const { return model_; }

    computed run(double tolerance, backend which = backend::scalar,
                 std::uint32_t returns = 1) const {
        ensemble_request request;
        const std::size_t n = size();
        request.n_cells = n;
        computed result;
        std::vector<std::uint8_t> end(n);
        std::vector<std::uint32_t> events(n);
        result.state.assign(columns_.size(), std::vector<double>(n));
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            request.columns[c] = {columns_[c].data(), 1, n};
            request.state[c] = result.state[c].data();
        }
        for (std::size_t p = 0; p < parameters_.size(); ++p)
            request.parameters[p].values = &parameters_[p];
        std::copy(options_.begin(), options_.end(), request.options);
        request.max_returns = returns;
        request.tolerance = tolerance;
        request.outcome = end.data();
        request.events = events.data();
        const lane_statistics lanes = model_.kernel(which, variant_)(request);
        for (const std::uint8_t code : end) result.end.push_back(static_cast<outcome>(code));
        result.events.assign(events.begin(), events.end());
        result.steps = static_cast<double>(lanes.useful) / static_cast<double>(n);
        return result;
    }

    orbit_answer orbit(std::size_t i, orbit_answer (*in)(const orbit_row&), double tolerance,
                       std::uint32_t returns = 1) const {
        std::vector<std::string> columns;
        std::vector<std::string> parameters;
        for (const auto& column : columns_) columns.push_back(fmt::format("{:.17g}", column[i]));
        for (const double p : parameters_) parameters.push_back(fmt::format("{:.17g}", p));
        orbit_row row;
        row.options = options_.data();
        row.variant = variant_;
        row.columns = columns;
        row.parameters = parameters;
        row.returns = returns;
        row.tolerance = tolerance;
        return in(row);
    }

private:
    const model_entry& model_;
    std::vector<double> parameters_;
    std::vector<int> options_;
    int variant_ = 0;
    std::vector<std::vector<double>> columns_;
};

rows_of sampled(const integrated& which, int n, unsigned seed) {
    rows_of rows(which);
    std::mt19937_64 random(seed);
    for (int i = 0; i < n; ++i) {
        std::vector<double> start;
        for (const auto& [low, high] : which.starts)
            start.push_back(std::uniform_real_distribution<>(low, high)(random));
        rows.add(start);
    }
    return rows;
}

class tolerance : public ::testing::TestWithParam<integrated> {};

TEST_P(tolerance, the_error_of_a_return_follows_it) {
    constexpr int n = 24;
    const rows_of rows = sampled(GetParam(), n, 11);
    std::vector<orbit_answer> truth;
    for (std::size_t i = 0; i < n; ++i)
        truth.push_back(rows.orbit(i, rows.model().orbits().run_mp50, standard));
    double steps_before = 1e9;
    for (const double asked : {1e-12, 1e-10, 1e-8, 1e-6}) {
        const computed got = rows.run(asked);
        std::vector<double> errors;
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(got.end[i], truth[i].end) << asked << " row " << i;
            if (truth[i].end != outcome::ok) continue;
            double error = 0.0;
            for (std::size_t c = 0; c < got.state.size(); ++c) {
                const double exact = std::stod(truth[i].columns[c]);
                error =
                    std::max(error, std::fabs(got.state[c][i] - exact) / (0.25 + std::fabs(exact)));
            }
            errors.push_back(error);
        }
        ASSERT_GE(errors.size(), 8u);
        std::sort(errors.begin(), errors.end());
        // taylor.hpp: median 0.04 to 0.7, worst 13 tolerances in 200 starts
        EXPECT_LT(errors.back(), 20.0 * asked);
        EXPECT_LT(errors[errors.size() / 2], asked);
        EXPECT_GT(errors[errors.size() / 2], 0.01 * asked) << "steps could be longer";
        EXPECT_LT(got.steps, 0.95 * steps_before);
        steps_before = got.steps;
    }
}

TEST_P(tolerance, every_backend_and_single_orbits_agree_bit_for_bit_at_it) {
    const rows_of rows = sampled(GetParam(), 200, 12);
    constexpr double asked = 1e-7;
    const computed scalar = rows.run(asked, backend::scalar, 2);
    for (const backend which : {backend::avx2, backend::avx512}) {
        if (!passive_rows::can_run(which)) continue;
        const computed wide = rows.run(asked, which, 2);
        EXPECT_EQ(wide.end, scalar.end);
        EXPECT_EQ(wide.state, scalar.state);
        EXPECT_EQ(wide.events, scalar.events);
    }
    for (std::size_t i = 0; i < 20; ++i) {
        const orbit_answer one = rows.orbit(i, rows.model().orbits().run_double, asked, 2);
        ASSERT_EQ(one.end, scalar.end[i]);
        if (one.end != outcome::ok) continue;
        for (std::size_t c = 0; c < scalar.state.size(); ++c)
            EXPECT_EQ(std::stod(one.columns[c]), scalar.state[c][i]);
    }
}

TEST_P(tolerance, wider_arithmetics_keep_their_own) {
    const rows_of rows = sampled(GetParam(), 1, 13);
    const orbit_functions& orbits = rows.model().orbits();
    for (auto* const run : {orbits.run_dd, orbits.run_mp50}) {
        EXPECT_EQ(rows.orbit(0, run, 1e-3).columns, rows.orbit(0, run, 0.0).columns);
    }
}

/// Along the first column, the others in the middle of their box: neighbouring starts of different
/// fate (outcome or number of events), narrowed at full precision to 1e-9 and confirmed in 50
/// digits; then starts 1e-8 to both sides.
TEST_P(tolerance, at_the_default_starts_1e8th_from_a_boundary_are_decided_as_in_50_digits) {
    constexpr std::uint32_t returns = 3;
    const integrated& which = GetParam();
    const auto start_at = [&](double x) {
        std::vector<double> start{x};
        for (std::size_t c = 1; c < which.starts.size(); ++c)
            start.push_back(0.4 * which.starts[c].first + 0.6 * which.starts[c].second);
        return start;
    };
    rows_of scan(which);
    constexpr int n = 400;
    const auto [lowest, highest] = which.starts[0];
    std::vector<double> x;
    for (int i = 0; i < n; ++i) {
        x.push_back(lowest + (highest - lowest) * i / n);
        scan.add(start_at(x.back()));
    }
    const computed rough = scan.run(standard, backend::scalar, returns);
    const auto exact = [&](double at) {
        rows_of one(which);
        one.add(start_at(at));
        const orbit_answer answer = one.orbit(0, one.model().orbits().run_mp50, standard, returns);
        return std::pair(answer.end, static_cast<double>(answer.events));
    };
    const auto close = [&](double at) {  // at full precision
        rows_of one(which);
        one.add(start_at(at));
        const computed got = one.run(0.0, backend::scalar, returns);
        return std::pair(got.end[0], got.events[0]);
    };
    int boundaries = 0;
    for (std::size_t i = 0; i + 1 < n && boundaries < 2; ++i) {
        if (rough.end[i] == rough.end[i + 1] && rough.events[i] == rough.events[i + 1]) continue;
        double low = x[i];
        double high = x[i + 1];
        const auto below = close(low);
        while (high - low > 1e-9) {
            const double middle = 0.5 * (low + high);
            (close(middle) == below ? low : high) = middle;
        }
        ++boundaries;
        EXPECT_NE(exact(low), exact(high)) << "no boundary at " << low;
        rows_of both(which);
        both.add(start_at(low - 1e-8));
        both.add(start_at(high + 1e-8));
        const computed got = both.run(standard, backend::scalar, returns);
        EXPECT_EQ(std::pair(got.end[0], got.events[0]), exact(low - 1e-8)) << low;
        EXPECT_EQ(std::pair(got.end[1], got.events[1]), exact(high + 1e-8)) << high;
    }
    EXPECT_GT(boundaries, 0) << "the box shows no boundary";
}

INSTANTIATE_TEST_SUITE_P(of, tolerance, ::testing::ValuesIn(all_integrated()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(tolerance_of_a_step, does_not_let_a_number_that_is_not_finite_pass) {
    for (const double asked : {0x1p-47, 1e-10, 1e-2}) {
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
            rows_of rows(all_integrated().back());
            rows.add({bad == bad ? 1e200 : 1e170, 1e300});  // products overflow
            EXPECT_EQ(rows.run(asked).end[0], outcome::not_finite);
        }
    }
}

}  // namespace
}  // namespace hopscotch
