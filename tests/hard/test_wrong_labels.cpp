// Every wrong label carries the flag `uncertain`: cells one ulp apart around basin boundaries of
// all models, against double-double and, where that disagrees, 50 digits. A million cells per model
// are looked at by `./hopscotch bench uncertain`.
#include "host/run/truth_orbits.hpp"
#include "tests/hard/uncertain_cases.hpp"

#include <gtest/gtest.h>

#include <string>

#include <fmt/format.h>

using namespace hopscotch;
using hard::boundary_case;
using hard::tally;

namespace {

/// Looks along up to `n_lines` lines until `n_wanted` cells are seen.
tally look_around(const boundary_case& which, int n_lines, std::size_t most_changes,
                  std::uint64_t n_wanted) {
    const scene whole = hard::scene_of(which, HOPSCOTCH_SOURCE);
    tally found;
    for (int i = 0; i < n_lines && found.cells < n_wanted; ++i) {
        const scene line = hard::line_through(whole, hard::place_of_line(i));
        const label_plan plan = plan_labels(line);
        const kernel_choice kernel = kernel_of(line, "auto");
        for (const double at : hard::changes_on(line, plan, kernel, which.n_cells, most_changes)) {
            const auto complain = [&](std::size_t cell, const cell_verdict& verdict) {
                ADD_FAILURE() << line.name << ": " << static_cast<int>(cell) - hard::reach
                              << " ulp from " << at << ": " << verdict.stored << " instead of "
                              << verdict.computed;
            };
            found += hard::judge_around(line, plan, kernel, at, hard::ulp_of(at), complain);
        }
    }
    return found;
}

class around_the_boundaries : public ::testing::TestWithParam<boundary_case> {};

}  // namespace

TEST_P(around_the_boundaries, every_wrong_label_is_flagged_uncertain) {
    const tally found = look_around(GetParam(), GetParam().n_lines, 1, 1000);
    EXPECT_GT(found.cells, 0u) << "no boundary was found";
    EXPECT_EQ(found.wrong_unflagged, 0u);
    RecordProperty("cells", std::to_string(found.cells));
    RecordProperty("flagged", std::to_string(found.flagged));
    RecordProperty("wrong", std::to_string(found.wrong));
}

/// The layer looks again at few cells; a second look at each must find the same.
TEST_P(around_the_boundaries, flags_are_those_of_a_second_look_at_every_cell_of_a_map) {
    std::vector<std::string> overrides = GetParam().overrides;
    const scene whole = hard::scene_of(GetParam(), HOPSCOTCH_SOURCE);
    for (std::size_t axis = 0; axis < whole.axes.size(); ++axis) {
        const int cells = whole.axes[axis].kind == axis_kind::column ? 48 : 6;
        overrides.push_back(fmt::format("grid.axis.{}.cells={}", axis, cells));
    }
    boundary_case small = GetParam();
    small.overrides = overrides;
    const scene map = hard::scene_of(small, HOPSCOTCH_SOURCE);
    const label_plan plan = plan_labels(map);
    const kernel_choice kernel = kernel_of(map, "auto");
    const std::vector<std::uint64_t> cells = hard::all_cells_of(map);
    EXPECT_EQ(certainty_of(map, plan, kernel.run, cells),
              second_look(map, plan, kernel.run, cells));
}

/// Rest is decided to each arithmetic's own rounding; double-double needs twice the returns, which
/// the scene does not give it.
TEST(the_truth_of_a_cell, is_rest_too_where_more_digits_take_longer_to_come_to_it) {
    const boundary_case valve{
        "relief_valve",
        "relief_valve_basins",
        {"grid.axis.0.min=9.3", "grid.axis.0.max=9.475", "grid.axis.0.cells=1",
         "grid.axis.1.min=0.5", "grid.axis.1.max=0.625", "grid.axis.1.cells=1",
         "question.samples=4"},
        0,
        0};
    const scene one = hard::scene_of(valve, HOPSCOTCH_SOURCE);
    const label_plan plan = plan_labels(one);
    ASSERT_GT(plan.died_label, 0);
    const kernel_choice kernel = kernel_of(one, "auto");
    ASSERT_EQ(hard::answers_of(one, plan, kernel, {0}), std::vector<int>{plan.died_label});
    EXPECT_TRUE(judge(one, plan, 0, plan.died_label).agrees());
    const owned_row row = row_of(one, plan, std::vector<std::uint64_t>{0, 0});
    EXPECT_EQ(run_orbit(*one.model, precision::dd, row.row).end, outcome::budget);
}

TEST(around_the_boundaries_of_the_open_loop_hopper, cells_one_ulp_apart_really_have_wrong_labels) {
    // the claims above would be empty if the arithmetic made no mistakes there
    const tally found = look_around(
        {"openloop_hopper", "cham2007_fig8_basins", {"question.returns=300"}, 1, 50}, 1, 1, 1000);
    EXPECT_GT(found.wrong, 0u);
    EXPECT_EQ(found.wrong_unflagged, 0u);
}

INSTANTIATE_TEST_SUITE_P(of, around_the_boundaries, ::testing::ValuesIn(hard::quick_cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });
