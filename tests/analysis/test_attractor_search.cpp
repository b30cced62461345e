// Attractors that nobody named: how many there are, of which kind and period, where, and with which
// multipliers, against the model pages.
#include "analysis/labels/plan.hpp"
#include "host/run/audit.hpp"
#include "host/scene/scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

label_plan plan_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
    const std::string file = std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/" + name;
    return plan_labels(read_scene(file, overrides));
}

/// Names of the attractors found, those of the model's own certificate left out but for the first.
std::vector<std::string> names_of(const label_plan& plan) {
    std::vector<std::string> names;
    for (const attractor_row& row : plan.attractors) {
        if (row.label == 1 || !row.points.empty()) names.push_back(row.name);
    }
    return names;
}

double largest_modulus(const attractor_row& row) {
    double largest = 0.0;
    for (std::size_t i = 0; i < row.multipliers_real.size(); ++i) {
        largest =
            std::max(largest, std::hypot(row.multipliers_real[i], row.multipliers_imaginary[i]));
    }
    return largest;
}

const char* const open_loop = "cham2007_fig8_basins.toml";
constexpr double w = 30.0;

// models/openloop_hopper.md, section 7: three period-1 orbits at 0.26 s, the middle one a saddle
TEST(attractor_search, finds_the_two_stable_hops_and_the_saddle_at_260_ms) {
    const label_plan plan = plan_of(open_loop);
    ASSERT_EQ(names_of(plan), (std::vector<std::string>{"fixed point 1", "fixed point 2"}));
    EXPECT_NEAR(plan.attractors[0].points[0] * w * w, -2.448, 5e-4);  // the page's digits
    EXPECT_NEAR(plan.attractors[0].points[1] * w, -0.725, 5e-4);
    EXPECT_NEAR(plan.attractors[1].points[0] * w * w, -0.677, 5e-4);
    EXPECT_NEAR(plan.attractors[1].points[1] * w, 0.265, 5e-4);
    EXPECT_NEAR(largest_modulus(plan.attractors[0]), 0.53, 5e-3);
    EXPECT_NEAR(largest_modulus(plan.attractors[1]), 0.31, 5e-3);
    ASSERT_EQ(plan.unstable.size(), 1u);
    EXPECT_NEAR(plan.unstable[0].points[0] * w * w, -1.705, 5e-4);
    EXPECT_NEAR(plan.unstable[0].points[1] * w, 0.931, 5e-4);
    EXPECT_NEAR(largest_modulus(plan.unstable[0]), 1.536, 5e-4);
}

// page, section 8, "weak attraction": looks like period 2 if tested too early
TEST(attractor_search, a_multiplier_near_minus_one_does_not_pass_as_period_two) {
    const label_plan plan = plan_of(open_loop, {"model.parameters.thrust_time=0.1"});
    ASSERT_EQ(names_of(plan), (std::vector<std::string>{"fixed point 1", "fixed point 2"}));
    EXPECT_NEAR(plan.attractors[1].multipliers_real[0], -0.98, 5e-3);
}

// page, section 7: t_on = 0.1 s, tau 0.265-0.27 s
TEST(attractor_search, finds_period_one_beside_period_two) {
    const label_plan plan = plan_of(
        open_loop, {"model.parameters.thrust_time=0.1", "model.parameters.stride_period=0.267"});
    EXPECT_EQ(names_of(plan), (std::vector<std::string>{"fixed point", "period 2"}));
}

// page, section 7: t_on = 0.2 s, tau 0.24 s: regular period-1 and chaos, exponent about 3.6 per
// second
TEST(attractor_search, finds_chaos_beside_period_one_with_its_exponent) {
    const label_plan plan = plan_of(
        open_loop, {"model.parameters.thrust_time=0.2", "model.parameters.stride_period=0.24"});
    ASSERT_EQ(names_of(plan), (std::vector<std::string>{"fixed point", "chaotic"}));
    ASSERT_EQ(plan.chaotic.size(), 1u);
    const double exponent = plan.attractors[1].multipliers_real.at(0);
    EXPECT_NEAR(exponent / 0.24, 3.6, 0.25);  // "about"; the standard error is 0.07
}

// models/paddle_juggler.md, section 5: Gamma = 0.9, e = 0.8
TEST(attractor_search, finds_what_coexists_on_the_paddle) {
    const label_plan plan = plan_of("paddle_sticking.toml", {"model.parameters.amplitude=0.9",
                                                             "model.parameters.restitution=0.8"});
    EXPECT_EQ(names_of(plan),
              (std::vector<std::string>{"rest", "fixed point 1", "fixed point 2", "period 4"}));
    // multipliers of a p-cycle multiply to e^(2 p) (page, section 4)
    const attractor_row& cycle = plan.attractors.back();
    ASSERT_EQ(cycle.multipliers_real.size(), 2u);
    const double product = cycle.multipliers_real[0] * cycle.multipliers_real[1] -
                           cycle.multipliers_imaginary[0] * cycle.multipliers_imaginary[1];
    EXPECT_NEAR(product, std::pow(0.8, 8), 1e-9);
}

// models/slip.md: the speed is conserved, so every speed has attractors of its own; stable gaits
// begin at v = 4.2325
TEST(attractor_search, searches_every_speed_that_the_runner_conserves) {
    const label_plan plan =
        plan_of("ghigliazza2005_basins.toml",
                {"grid.axis.0.cells=40", "grid.axis.1.cells=3", "grid.axis.1.min=4.0",
                 "grid.axis.1.max=5.2"});  // 4.2, 4.6, 5.0
    EXPECT_EQ(plan.point_axes, std::vector<std::size_t>{1});
    ASSERT_EQ(plan.n_ellipsoids, 1);
    ASSERT_EQ(plan.ellipsoids.size(), 3u);
    EXPECT_EQ(plan.ellipsoids[0].label, 0);
    EXPECT_EQ(plan.ellipsoids[1].label, 1);
    EXPECT_EQ(plan.ellipsoids[2].label, 1);
}

// models/openloop_hopper.md, section 7: the fixed point flips at 123.5 and 156.0 ms. A period-2
// orbit of another family attracts on both sides of the flips, too.
TEST(attractor_search, the_fixed_point_attracts_outside_the_pages_flips_only) {
    for (const auto& [period, is_stable] :
         {std::pair{"0.1230", true}, std::pair{"0.1240", false}, std::pair{"0.1555", false},
          std::pair{"0.1565", true}}) {
        const label_plan plan =
            plan_of(open_loop, {"model.parameters.thrust=3.8", "model.parameters.thrust_time=0.02",
                                std::string("model.parameters.stride_period=") + period});
        EXPECT_EQ(plan.attractors.at(0).period == 1, is_stable) << period;
    }
}

TEST(attractor_search, one_label_stands_for_one_period_where_every_cell_is_a_point) {
    const std::string file =
        std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/cham2007_periods.toml";
    const scene scene = read_scene(
        file, std::vector<std::string>{"grid.axis.0.cells=1", "grid.axis.0.min=0.13",
                                       "grid.axis.0.max=0.15", "grid.axis.1.cells=1",
                                       "grid.axis.1.min=0.015", "grid.axis.1.max=0.025"});
    const label_plan plan = plan_labels(scene);
    ASSERT_TRUE(plan.of_cell);
    const label_plan here = plan.of_cell(std::vector<std::uint64_t>{0, 0});  // 140 ms
    ASSERT_EQ(here.n_ellipsoids, 2);  // one trap per point of the cycle
    for (const trap_ellipsoid& trap : here.ellipsoids) EXPECT_EQ(trap.label, 2);
    EXPECT_EQ(plan.attractors[1].name, "period 2");
}

// Transients are chaotic there: in double-double the orbit settles on another attractor than in
// double, a cycle of period 4 beside one of period 8, and a chaotic set of eight thin bands
// (exponent 0.045 per return) beside one of period 4.
TEST(attractor_search, a_point_of_a_period_map_knows_the_attractors_next_to_its_start) {
    for (const auto& [stride_period, thrust_time] :
         {std::pair{0.2178125, 0.033072916666666667}, std::pair{0.1696875, 0.052552083333333333}}) {
        const auto around = [](const char* axis, double x) {
            return std::vector<std::string>{fmt::format("grid.axis.{}.cells=1", axis),
                                            fmt::format("grid.axis.{}.min={}", axis, x - 0.001),
                                            fmt::format("grid.axis.{}.max={}", axis, x + 0.001)};
        };
        std::vector<std::string> overrides = around("0", stride_period);
        for (std::string& one : around("1", thrust_time)) overrides.push_back(std::move(one));
        const scene scene = read_scene(
            std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/cham2007_periods.toml", overrides);
        const label_plan plan = plan_labels(scene);
        EXPECT_NE(judge(scene, plan, 0, 0).computed, 0) << stride_period;
    }
}

// Energy is conserved, and no column of this section by itself: every orbit is one of a family, and
// tangents grow by shear. That is neither an attractor nor chaos.
TEST(attractor_search, a_family_of_neutral_orbits_is_not_called_chaos) {
    const label_plan plan =
        plan_of("ghigliazza2005_basins.toml",
                {"grid.section=apex", "grid.axis.0.name=apex_height", "grid.axis.0.min=1.43",
                 "grid.axis.0.max=1.6", "grid.axis.0.cells=20", "grid.axis.1.name=forward_speed",
                 "grid.axis.1.min=4.3", "grid.axis.1.max=5.0", "grid.axis.1.cells=20"});
    EXPECT_TRUE(plan.attractors.empty());
    ASSERT_FALSE(plan.unstable.empty());
    EXPECT_NEAR(largest_modulus(plan.unstable[0]), 1.0, 1e-6);
}

TEST(attractor_search, labels_do_not_depend_on_the_grid_that_starts_are_taken_from) {
    const label_plan one = plan_of(open_loop);
    const label_plan other = plan_of(open_loop, {"grid.axis.0.cells=77", "grid.axis.1.cells=131"});
    ASSERT_EQ(names_of(one), names_of(other));
    for (std::size_t i = 0; i < one.attractors.size(); ++i) {
        for (std::size_t c = 0; c < 2; ++c) {
            EXPECT_NEAR(one.attractors[i].points[c], other.attractors[i].points[c], 1e-14);
        }
    }
}

}  // namespace
}  // namespace hopscotch
