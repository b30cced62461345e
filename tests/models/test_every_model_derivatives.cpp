// For every model, section and choice of options: the derivatives of the return map that dual
// numbers carry through flows and events are those of 50-digit central differences.
#include "tests/models/every_model.hpp"

#include "analysis/orbit/orbit_functions.hpp"
#include "analysis/truth/decimal.hpp"
#include "host/run/truth_orbits.hpp"

#include <gtest/gtest.h>

namespace hopscotch {
namespace {

using namespace every_model;

/// Rows that complete two returns by more than a few events of room for a shift of the start.
constexpr int rows_per_choice = 2;
constexpr std::size_t n_candidates = 400;

struct single_row {
    const rows& of;
    std::size_t i;
    int variant;

    orbit_answer run(const std::vector<std::string>& columns, bool derivative, bool exact) const {
        std::vector<std::string> parameters;
        for (const auto& values : of.parameters) parameters.push_back(exact_decimal(values[i]));
        const orbit_row row{.section = of.section,
                            .options = of.options.data(),
                            .variant = variant,
                            .columns = columns,
                            .parameters = parameters,
                            .returns = 1,
                            .derivative = derivative};
        const orbit_functions& orbits = of.model->orbits();
        return exact ? orbits.run_mp50(row) : orbits.run_double(row);
    }
};

class every_model_derivatives : public testing::TestWithParam<const model_entry*> {};

TEST_P(every_model_derivatives, are_those_of_50_digit_differences_through_events) {
    const model_entry& model = *GetParam();
    const real50 step("1e-18");  // truncation 1e-36, rounding 1e-48 / 1e-18
    for (int section = 0; section < static_cast<int>(model.info->sections.size()); ++section) {
        std::uint64_t seed = 500;
        for (const std::vector<int>& options : all_options(*model.info)) {
            rows of = random_rows(model, section, options, n_candidates, ++seed);
            of.returns = 1;
            const answers ends = every_model::run(of, backend::scalar, variant_of(of));
            int compared = 0;
            for (std::size_t i = 0; i < of.size() && compared < rows_per_choice; ++i) {
                if (ends.ended(i) != outcome::ok || ends.returns[i] == 0) continue;
                const single_row row{of, i, variant_of(picked(of, {i}))};
                std::vector<std::string> start;
                for (const auto& values : of.columns) start.push_back(exact_decimal(values[i]));
                const orbit_answer got = row.run(start, true, false);
                ASSERT_EQ(got.end, outcome::ok) << describe(of, i);
                const std::size_t n = start.size();
                bool is_smooth = true;
                for (std::size_t c = 0; c < n && is_smooth; ++c) {
                    std::vector<std::string> above = start;
                    std::vector<std::string> below = start;
                    const real50 x = parse_real<real50>(start[c]);
                    above[c] = print_real(x + step);
                    below[c] = print_real(x - step);
                    const orbit_answer high = row.run(above, false, true);
                    const orbit_answer low = row.run(below, false, true);
                    is_smooth = high.end == outcome::ok && low.end == outcome::ok &&
                                high.events == low.events && high.events == got.events;
                    for (std::size_t r = 0; r < got.columns.size() && is_smooth; ++r) {
                        const double slope = to_double((parse_real<real50>(high.columns[r]) -
                                                        parse_real<real50>(low.columns[r])) /
                                                       (step + step));
                        const double derived = parse_real<double>(got.derivative[r * n + c]);
                        // double runs the map with some rounding errors, which a derivative
                        // amplifies by the size of the second one: some 1e4 of them at most here,
                        // in units of the state over the start
                        const double unit = std::abs(parse_real<double>(got.columns[r])) /
                                            (1e-3 + std::abs(parse_real<double>(start[c])));
                        EXPECT_NEAR(derived, slope, 1e-9 * (1.0 + unit + std::abs(slope)))
                            << describe(of, i) << ": column " << r << " by " << c;
                    }
                }
                compared += is_smooth ? 1 : 0;
            }
            EXPECT_GT(compared, 0) << of.name();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(all, every_model_derivatives, testing::ValuesIn(models()),
                         [](const auto& of) { return std::string(of.param->info->name); });

}  // namespace
}  // namespace hopscotch
