// Every wrong label carries the flag `uncertain`: cells one ulp apart around basin boundaries of
// all models, against double-double and, where that disagrees, 50 digits. A million cells per model
// are looked at by `./hopscotch bench uncertain`.
#include "host/run/truth_orbits.hpp"
#include "tests/hard/uncertain_cases.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include <fmt/format.h>

using namespace hopscotch;
using hard::boundary_case;
using hard::tally;

namespace {

/// Cells one ulp apart around one boundary per line: 500 of them, and on until a wrong label
/// has been seen, on at most `n_lines` lines.
tally look_around(const boundary_case& which, std::size_t most_flagged) {
    constexpr int reach = 64;
    const scene whole = hard::scene_of(which, HOPSCOTCH_SOURCE);
    hard::line_check how{32, most_flagged, 100};
    tally found;
    for (int i = 0; i < which.n_lines && (found.cells < 500 || found.wrong == 0); ++i) {
        const scene line = hard::line_through(whole, hard::place_of_line(i));
        const label_plan plan = plan_labels(line);
        const kernel_choice kernel = kernel_of(line, "auto");
        for (const double at : hard::changes_on(line, plan, kernel, which.n_cells, 1)) {
            const double ulp = hard::ulp_of(at);
            const auto complain = [&](std::size_t cell, const cell_verdict& verdict) {
                ADD_FAILURE() << line.name << ": " << static_cast<int>(cell) - reach << " ulp from "
                              << at << ": " << verdict.stored << " instead of " << verdict.computed;
            };
            found += hard::judge_line(
                hard::part_of(line, at - reach * ulp, at + reach * ulp, 2 * reach + 1), plan,
                kernel, how, complain);
        }
    }
    return found;
}

void expect_flags_at_wrong_labels(const boundary_case& which, std::size_t most_flagged = 12) {
    const tally found = look_around(which, most_flagged);
    EXPECT_GT(found.wrong, 0u) << "the claim is empty: no label is wrong among " << found.cells;
    EXPECT_EQ(found.wrong_unflagged, 0u);
    for (const auto& [name, count] : {std::pair{"cells", found.cells},
                                      {"flagged", found.flagged},
                                      {"wrong", found.wrong},
                                      {"evaluated", found.evaluated}}) {
        ::testing::Test::RecordProperty(name, std::to_string(count));
    }
}

class around_the_boundaries : public ::testing::TestWithParam<boundary_case> {};

}  // namespace

TEST_P(around_the_boundaries, every_wrong_label_is_flagged_uncertain) {
    expect_flags_at_wrong_labels(GetParam());
}

TEST(around_the_boundaries_of_the_relief_valve, slow_every_wrong_label_is_flagged_uncertain) {
    expect_flags_at_wrong_labels(hard::relief_valve_case());
}

/// The same at a tenth of the returns, where its truth takes less than a second a cell.
TEST(around_the_boundaries_of_the_relief_valve, every_wrong_label_is_flagged_uncertain) {
    boundary_case quick = hard::relief_valve_case();
    quick.overrides = {"grid.axis.0.cells=8", "question.samples=8", "question.returns=30"};
    quick.n_lines = 3;
    expect_flags_at_wrong_labels(quick, 3);
}

/// Twelve neighbours whose orbit is 2.0e-11 outside of a trap at its 38th return and truly 0.1e-11
/// inside (|A (x - centre)|^2 - 1). 16 ulp of velocity, amplitude and restitution move that by
/// -1.0e-10, -2.6e-10 and -1.7e-10, but by 0.1e-10 when they are moved together, the second down.
TEST(around_the_boundaries_of_the_paddle, labels_are_flagged_where_numbers_moved_together_cancel) {
    const boundary_case paddle{"paddle_juggler", "paddle_sticking", {"question.returns=40"}, 0, 0};
    const scene whole = hard::scene_of(paddle, HOPSCOTCH_SOURCE);
    const scene line = hard::line_through(whole, hard::place_of_line(3));
    const label_plan plan = plan_labels(line);
    const double at = 0.12832030375248371;
    const scene window = hard::part_of(line, at, at + 11.0 * hard::ulp_of(at), 12);
    const tally found = hard::judge_cells(window, plan, kernel_of(line, "auto"),
                                          hard::all_cells_of(window), [](auto, const auto&) {});
    EXPECT_EQ(found.wrong, 12u);
    EXPECT_EQ(found.wrong_unflagged, 0u);
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

INSTANTIATE_TEST_SUITE_P(of, around_the_boundaries, ::testing::ValuesIn(hard::quick_cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });
