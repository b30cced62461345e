// Where cells are sampled: centres, edges, logarithmic spacing, and in which order.
#include "host/scene/grid.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace hopscotch;

namespace {

scene_axis axis_of(double lowest, double highest, std::uint64_t cells) {
    scene_axis axis;
    axis.lowest = lowest;
    axis.highest = highest;
    axis.cells = cells;
    return axis;
}

}  // namespace

TEST(grid, samples_cell_centres) {
    EXPECT_EQ(values_of(axis_of(0.0, 2.0, 4)), (std::vector<double>{0.25, 0.75, 1.25, 1.75}));
    EXPECT_EQ(values_of(axis_of(-1.0, 1.0, 1)), std::vector<double>{0.0});
}

TEST(grid, edges_samples_the_very_end_points) {
    scene_axis axis = axis_of(0.1, 0.7, 3);
    axis.edges = true;
    EXPECT_EQ(value_of(axis, 0), 0.1);
    EXPECT_EQ(value_of(axis, 2), 0.7);
    EXPECT_DOUBLE_EQ(value_of(axis, 1), 0.4);
}

TEST(grid, centres_are_the_nearest_doubles_to_the_exact_ones) {
    // 0.1 * (2 i + 1) / 20 in decimal, i = 0, 7, 9: written out, so correctly rounded by the
    // compiler
    const scene_axis axis = axis_of(0.0, 0.1, 10);
    EXPECT_EQ(value_of(axis, 0), 0.005);
    EXPECT_EQ(value_of(axis, 9), 0.095);
}

TEST(grid, log_axes_step_by_a_constant_factor) {
    scene_axis axis = axis_of(1e-3, 1e3, 3);
    axis.scale = axis_scale::log;
    EXPECT_NEAR(value_of(axis, 0), 1e-2, 1e-17);  // half an ulp of 1e-2 is 9e-19
    EXPECT_NEAR(value_of(axis, 1), 1.0, 1e-15);
    axis.edges = true;
    EXPECT_EQ(value_of(axis, 0), 1e-3);
    EXPECT_EQ(value_of(axis, 2), 1e3);
}

TEST(grid, values_grow_strictly_even_at_a_large_offset) {
    const scene_axis axis = axis_of(1e6, 1e6 + 1e-6, 512);
    const std::vector<double> values = values_of(axis);
    for (std::size_t i = 1; i < values.size(); ++i) EXPECT_LT(values[i - 1], values[i]);
}

TEST(grid, the_first_axis_is_the_slowest) {
    const scene scene = parse_scene(R"([model]
name = "fake_bouncer"
[[grid.axis]]
name = "offset"
min = 0
max = 2
cells = 2
[[grid.axis]]
name = "height"
min = 0
max = 3
cells = 3
[start]
speed = 7
[question]
kind = "return_map"
)",
                                    "s.toml", {}, fake::models());
    EXPECT_EQ(coordinates_of(scene, 4), (std::vector<std::uint64_t>{1, 1}));
    const cell_start start = start_of(scene, coordinates_of(scene, 5));
    EXPECT_EQ(start.columns, (std::vector<double>{2.5, 7.0}));
    EXPECT_EQ(start.parameters, (std::vector<double>{0.5, 1.5, 1.0}));
    const parameter_extremes extremes = extremes_of(scene);
    EXPECT_EQ(extremes.lowest[1], 0.5);
    EXPECT_EQ(extremes.highest[1], 1.5);
}
