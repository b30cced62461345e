// From map files to classes and to the whole analysis: labels and outcomes, missing tiles, axes.
#include "analysis/metrics/analysis.hpp"
#include "tests/host/sample_map.hpp"

#include <gtest/gtest.h>

namespace hopscotch::test {
namespace {

using metrics::class_grid;
using metrics::fall_rule;
using metrics::read_classes;

constexpr int attracted = 1;
constexpr int ground = 5;
constexpr int fell = 9;
constexpr int budget = 22;
constexpr int invalid_start = 25;

struct cell_state {
    int label = 0;
    int outcome = attracted;
};

/// Writes a map with labels and outcomes that a function of the cell's indices gives.
template <class State>
void write_states(const std::filesystem::path& file, const map_layout& layout, State&& state_of,
                  std::uint64_t n_missing = 0) {
    map_run run(layout, sample_options(file, if_exists::replace));
    for (const std::uint64_t index : run.missing_tiles()) {
        if (index < n_missing) continue;
        tile_data tile = sample_tile(layout, index);
        std::uint64_t at = 0;
        for_each_row(tile.box.extent, [&](std::vector<std::uint64_t> position) {
            for (std::size_t i = 0; i < position.size(); ++i) position[i] += tile.box.origin[i];
            for (std::uint64_t k = 0; k < tile.box.extent.back(); ++k, ++at, ++position.back()) {
                const cell_state state = state_of(position);
                fill_numbers(number_type::int16, tile.layers[0].data(), at, 1, state.label);
                fill_numbers(number_type::int8, tile.layers[1].data(), at, 1, state.outcome);
            }
        });
        run.put(compress(layout, tile, 4));
    }
    if (n_missing == 0) run.finish(sample_summary());
}

/// Columns 0-9 label 1, 10-14 the ground, 15-17 fell, 18 budget, 19 outside the domain.
cell_state striped(const std::vector<std::uint64_t>& at) {
    const std::uint64_t j = at.back();
    if (j < 10) return {1, attracted};
    return {0, j < 15 ? ground : j < 18 ? fell : j < 19 ? budget : invalid_start};
}

class metrics_maps : public testing::Test {
protected:
    scratch_folder folder;
    std::filesystem::path file = folder / "map.h5";
};

TEST_F(metrics_maps, cells_without_a_label_are_told_apart_by_their_outcome) {
    write_states(file, sample_layout({16, 20}, {8, 8}), striped);
    const class_grid grid = read_classes(map_reader(file));
    ASSERT_EQ(grid.classes.size(), 3U);
    EXPECT_EQ(grid.classes[0].name, "fixed point 1");
    EXPECT_FALSE(grid.classes[0].is_fall);
    EXPECT_EQ(grid.classes[1].name, "ground");
    EXPECT_EQ(grid.classes[2].name, "fell");
    EXPECT_TRUE(grid.classes[1].is_fall && grid.classes[2].is_fall);
    EXPECT_EQ(grid.classes[0].n_cells, 160U);
    EXPECT_EQ(grid.classes[1].n_cells, 80U);
    EXPECT_EQ(grid.classes[2].n_cells, 48U);
    EXPECT_EQ(grid.n_undecided, 16U);
    EXPECT_EQ(grid.n_outside, 16U);
    EXPECT_EQ(grid.n_not_computed, 0U);
    EXPECT_EQ(grid.n_decided(), 288U);
    EXPECT_EQ(grid.row(0, 3)[12], 1) << "second of the outcomes' classes, in its place";
}

TEST_F(metrics_maps, failures_can_be_one_class_or_be_left_out) {
    write_states(file, sample_layout({16, 20}, {8, 8}), striped);
    const class_grid together = read_classes(map_reader(file), {"", fall_rule::together});
    ASSERT_EQ(together.classes.size(), 2U);
    EXPECT_EQ(together.classes[1].name, "failure");
    EXPECT_EQ(together.classes[1].n_cells, 128U);
    const class_grid left_out = read_classes(map_reader(file), {"", fall_rule::left_out});
    ASSERT_EQ(left_out.classes.size(), 1U);
    EXPECT_EQ(left_out.n_undecided, 144U);
}

TEST_F(metrics_maps, outcomes_are_the_classes_of_a_map_without_labels) {
    map_layout layout = sample_layout({16, 20}, {8, 8});
    write_states(file, layout, striped);
    const class_grid grid = read_classes(map_reader(file), {"outcome", fall_rule::separate});
    ASSERT_EQ(grid.classes.size(), 3U);
    EXPECT_EQ(grid.classes[0].name, "attracted");
    EXPECT_TRUE(grid.classes[0].is_outcome);
    EXPECT_EQ(grid.n_undecided, 16U);
    EXPECT_EQ(grid.n_outside, 16U);
}

TEST_F(metrics_maps, missing_tiles_are_not_computed_and_listed_nowhere_as_data) {
    write_states(file, sample_layout({16, 16}, {8, 8}), striped, 1);
    const map_reader map(file);
    const class_grid grid = read_classes(map);
    EXPECT_EQ(grid.n_not_computed, 64U);
    EXPECT_EQ(map.problems().size(), 1U);
}

TEST_F(metrics_maps, tiles_of_any_shape_give_the_same_classes) {
    write_states(file, sample_layout({16, 20}, {5, 7}), striped);
    const class_grid odd = read_classes(map_reader(file));
    write_states(file, sample_layout({16, 20}, {16, 20}), striped);
    EXPECT_EQ(read_classes(map_reader(file)).cells, odd.cells);
}

TEST_F(metrics_maps, axes_of_one_cell_are_left_out_and_more_than_three_are_refused) {
    write_states(file, sample_layout({1, 6, 1, 20}, {1, 6, 1, 20}), striped);
    const class_grid grid = read_classes(map_reader(file));
    ASSERT_EQ(grid.rank(), 2U);
    EXPECT_EQ(grid.axes[0].name, "mass_ratio");
    write_states(file, sample_layout({2, 3, 2, 20}, {2, 3, 2, 20}), striped);
    try {
        read_classes(map_reader(file));
        FAIL();
    } catch (const store_error& error) {
        EXPECT_STREQ(error.what(),
                     "map (it has 4 axes; metrics are defined for one to three); a map with cells "
                     "= 1 along the others?");
    }
}

TEST_F(metrics_maps, a_layer_of_real_numbers_is_refused_with_those_that_are_classes) {
    write_states(file, sample_layout({16, 20}, {8, 8}), striped);
    try {
        read_classes(map_reader(file), {"time", fall_rule::separate});
        FAIL();
    } catch (const store_error& error) {
        EXPECT_STREQ(error.what(),
                     "layer time (its values are no classes); one of label, outcome?");
    }
}

TEST_F(metrics_maps, more_classes_than_a_set_holds_are_counted_together_and_said) {
    // labels 1 to 80; label k has 80 + k cells of 80 x 121
    const map_layout layout = sample_layout({80, 121}, {80, 121});
    write_states(file, layout, [](const std::vector<std::uint64_t>& at) {
        const int label = static_cast<int>(at[0]) + 1;
        const bool is_own = at[1] < 40 + static_cast<std::uint64_t>(label);
        return cell_state{is_own ? label : 80, attracted};
    });
    const class_grid grid = read_classes(map_reader(file));
    ASSERT_EQ(grid.classes.size(), metrics::most_classes);
    EXPECT_EQ(grid.n_lumped, 80U - 62U);
    EXPECT_EQ(grid.classes.back().name, "the 18 rarest");
    std::uint64_t n = 0;
    for (const metrics::basin_class& each : grid.classes) n += each.n_cells;
    EXPECT_EQ(n, 80U * 121U);
    EXPECT_EQ(grid.classes.back().n_cells, 18U * 40U + 18U * 19U / 2U) << "labels 1 to 18";
    EXPECT_FALSE(wada_of(grid).is_defined);
}

TEST_F(metrics_maps, the_whole_analysis_of_one_to_three_axes_is_complete) {
    for (const std::vector<std::uint64_t>& sizes :
         {std::vector<std::uint64_t>{400}, {60, 70}, {34, 36, 40}}) {
        write_states(file, sample_layout(sizes, sizes), [&](const std::vector<std::uint64_t>& at) {
            const std::uint64_t third = sizes.back() / 3;
            const std::uint64_t j = at.back();
            return j < third ? cell_state{1} : j < 2 * third ? cell_state{2} : cell_state{0, fell};
        });
        const metrics::map_analysis result = metrics::analyse_map(map_reader(file));
        ASSERT_EQ(result.grid.classes.size(), 3U);
        EXPECT_NEAR(result.uncertainty.whole.exponent, 1.0, 1e-9) << sizes.size() << " axes";
        EXPECT_NEAR(metrics::dimension_of(result.grid, result.box_counts.whole),
                    static_cast<double>(sizes.size()) - 1.0, 0.01);
        EXPECT_EQ(result.components[0].n, 1U);
        EXPECT_DOUBLE_EQ(result.falls_in_cells.classes[1].shortest, 1.0);
        EXPECT_DOUBLE_EQ(result.falls_in_cells.classes[0].shortest,
                         static_cast<double>(sizes.back() / 3) + 1.0);
        EXPECT_EQ(result.shocks.size(), 3U) << "one per row of the attractor table";
        EXPECT_EQ(result.wada.radius(), static_cast<double>(sizes.back() / 3));
    }
}

TEST_F(metrics_maps, a_reference_box_along_an_unknown_axis_is_refused) {
    write_states(file, sample_layout({16, 20}, {8, 8}), striped);
    metrics::analysis_wish wish;
    wish.reference_box["speed"] = {0.0, 1.0};
    EXPECT_THROW(metrics::analyse_map(map_reader(file), wish), store_error);
}

}  // namespace
}  // namespace hopscotch::test
