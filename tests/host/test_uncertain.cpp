// The layer `uncertain` on a model whose boundary is known to the last bit.
#include "host/run/run_map.hpp"
#include "host/run/uncertain.hpp"
#include "host/scene/grid.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <unistd.h>

#include <fmt/format.h>

using namespace hopscotch;

namespace {

constexpr double ulp_of_three = 0x1p-51;

/// height -> height / 2, and up to 1.5 belongs to label 1: the boundary lies at 3, which belongs
/// to it. Cells k = -n ... n stand `step` apart around it.
scene around_three(int n, double step, std::string_view law, double gain = 0.5, double offset = 0.0,
                   int tile = 10) {
    const std::string text =
        fmt::format(R"([model]
name = "fake_bouncer"
[model.options]
law = "{}"
[model.parameters]
gain = {:.17g}
offset = {:.17g}
[[grid.axis]]
name = "height"
min = {:.17g}
max = {:.17g}
cells = {}
edges = true
[start]
speed = 0
[question]
kind = "basins"
returns = 1
[output]
layers = ["label", "uncertain"]
tile = [{}]
)",
                    law, gain, offset, 3.0 - n * step, 3.0 + n * step, 2 * n + 1, tile);
    return parse_scene(text, "boundary.toml", {}, fake::models());
}

label_plan plan_of(const scene&, std::span<const std::uint64_t> = {}) {
    label_plan plan;
    plan.decided_by = decision::intervals;
    plan.n_traps = 1;
    plan.traps = {{0.0, 1.5, 1}};
    return plan;
}

std::vector<double> computed_layer(const scene& scene, std::string_view layer) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("hopscotch_uncertain" + std::to_string(getpid()) + ".h5");
    run_choices choices;
    choices.file = file;
    choices.is_quiet = true;
    choices.existing = if_exists::replace;
    run_map(scene, choices, {plan_of, {}});
    const std::vector<double> values = map_reader(file).read_all(layer);
    std::filesystem::remove(file);
    return values;
}

}  // namespace

TEST(uncertain_cells, are_those_whose_label_a_few_roundings_change) {
    // the start moves by 16 ulp: k + 16 > 0 and k - 16 <= 0. The gain moves by 16 ulp of 1/2, which
    // moves the boundary by 3 * 2^-48, 24 ulp of the start: k + 24 > 0 and k - 24 <= 0.
    const int n = 40;
    const scene scene = around_three(n, ulp_of_three, "steep");
    const std::vector<double> label = computed_layer(scene, "label");
    const std::vector<double> uncertain = computed_layer(scene, "uncertain");
    for (int k = -n; k <= n; ++k) {
        const auto cell = static_cast<std::size_t>(k + n);
        EXPECT_EQ(label[cell], k <= 0 ? 1.0 : 0.0) << k;
        EXPECT_EQ(uncertain[cell], k > -24 && k <= 24 ? 1.0 : 0.0) << k;
    }
}

TEST(uncertain_cells, are_found_by_each_fixed_number_alone_where_together_they_cancel) {
    // height -> height / 4 + 3/4, cells 4 ulp apart. By itself the gain moves the boundary by 16
    // ulp of 1/4, times 3 over 1/4, which is 6 cells; the offset moves it by 4 and the start by 4.
    // Gain and offset together, one up and one down, would move it by 2.
    const int n = 20;
    const std::vector<double> uncertain =
        computed_layer(around_three(n, 4.0 * ulp_of_three, "steep", 0.25, 0.75), "uncertain");
    for (int k = -n; k <= n; ++k) {
        const auto cell = static_cast<std::size_t>(k + n);
        EXPECT_EQ(uncertain[cell], k > -6 && k <= 6 ? 1.0 : 0.0) << k;
    }
}

TEST(uncertain_cells, reach_further_where_a_flow_is_integrated_to_a_tolerance) {
    // the law "plain" counts as integrated; the default tolerance is 1e-10: the gain moves by
    // 1e-8 * 1/2, the boundary by 6 times that, the start itself by 1e-8 * (1/4 + 3)
    const int n = 40;
    const double step = 4e-9;
    const double reach = std::max(6.0 * 0.5e-8, 3.25e-8);
    const scene scene = around_three(n, step, "plain");
    const std::vector<double> uncertain = computed_layer(scene, "uncertain");
    for (int k = -n; k <= n; ++k) {
        const double distance = std::abs(k * step);
        if (std::abs(distance - reach) < step) continue;  // within a cell of the reach
        EXPECT_EQ(uncertain[static_cast<std::size_t>(k + n)], distance < reach ? 1.0 : 0.0) << k;
    }
}

TEST(uncertain_cells, can_be_asked_for_one_by_one) {
    const int n = 32;
    const scene scene = around_three(n, ulp_of_three, "steep");
    const label_plan plan = plan_of(scene);
    const std::vector<std::uint64_t> cells{0, n - 24, n - 23, n, n + 24, n + 25};
    EXPECT_EQ(certainty_of(scene, plan, fake::run, cells),
              (std::vector<std::uint8_t>{0, 0, 1, 1, 1, 0}));
}

TEST(uncertain_cells, move_by_roundings_or_by_the_tolerance) {
    EXPECT_EQ(displacement_of(axis_kind::column, 3.0, 0.0, 0.0), 16.0 * ulp_of_three);
    EXPECT_EQ(displacement_of(axis_kind::parameter, -3.0, 0.0, 0.0), 16.0 * ulp_of_three);
    EXPECT_EQ(displacement_of(axis_kind::column, 1e-9, 3.0, 0.0),
              16.0 * ulp_of_three);  // of the axis
    EXPECT_DOUBLE_EQ(displacement_of(axis_kind::column, 0.75, 0.0, 1e-9), 1e-7);
    EXPECT_DOUBLE_EQ(displacement_of(axis_kind::parameter, 2e-4, 0.0, 1e-9), 2e-11);
}

TEST(uncertain_cells, are_found_where_neighbours_are_far_apart) {
    // cells 1/16 apart; the middle one stands on the boundary
    const int n = 40;
    const std::vector<double> uncertain =
        computed_layer(around_three(n, 0x1p-4, "steep"), "uncertain");
    for (int k = -n; k <= n; ++k) {
        EXPECT_EQ(uncertain[static_cast<std::size_t>(k + n)], k == 0 ? 1.0 : 0.0) << k;
    }
}

TEST(uncertain_cells, do_not_depend_on_tiles) {
    const int n = 40;
    const scene small = around_three(n, 0x1p-4, "steep", 0.5, 0.0, 1);
    const scene large = around_three(n, 0x1p-4, "steep", 0.5, 0.0, 100);
    EXPECT_EQ(computed_layer(small, "uncertain"), computed_layer(large, "uncertain"));
}

TEST(uncertain_cells, are_all_where_a_fixed_number_alone_decides) {
    // height -> 2^-80 height + 1.5: every cell ends on the trap's edge, and no neighbour differs
    const scene scene = around_three(40, 0x1p-4, "steep", 0x1p-80, 1.5);
    for (const double flag : computed_layer(scene, "uncertain")) EXPECT_EQ(flag, 1.0);
}

TEST(uncertain_cells, cost_few_further_runs_where_neighbours_agree) {
    const scene scene = around_three(400, 0x1p-4, "steep");
    label_plan plan = plan_of(scene);
    plan.n_traps = 2;
    plan.traps.push_back({std::nextafter(1.5, 2.0), 1000.0, 2});
    std::vector<std::uint64_t> cells(scene.n_cells());
    std::iota(cells.begin(), cells.end(), std::uint64_t{0});
    std::uint64_t n_run = 0;
    const auto counted = [&](const ensemble_request& request) {
        n_run += request.n_cells;
        return fake::run(request);
    };
    certainty_of(scene, plan, counted, cells);
    // once each, every 64th cell twice more for each of two fixed numbers, and a few around two
    // boundaries (3, and 0 below which no start is valid) and the two ends
    EXPECT_LE(n_run, scene.n_cells() * 17 / 16 + 60);
    EXPECT_EQ(second_look(scene, plan, fake::run, cells),
              certainty_of(scene, plan, fake::run, cells));
}
