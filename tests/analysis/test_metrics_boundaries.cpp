// Entropy, uncertainty exponent, box dimension and the Wada test on boundaries that are known: a
// straight line, a checkerboard, Cantor sets, stripes.
#include "analysis/metrics/box_dimension.hpp"
#include "analysis/metrics/entropy.hpp"
#include "analysis/metrics/wada.hpp"
#include "host/store/store_error.hpp"
#include "tests/analysis/metric_maps.hpp"

#include <gtest/gtest.h>

namespace hopscotch::test {
namespace {

using metrics::class_grid;
using metrics::power_law;

const double cantor_dimension = std::log(2.0) / std::log(3.0);

class_grid plane(std::uint64_t n0, std::uint64_t n1, int n_labels, auto&& label_of) {
    return metric_map({metric_axis("x", 0.0, 1.0, n0), metric_axis("y", 0.0, 1.0, n1)}, n_labels,
                      label_of);
}

TEST(metrics_entropy, of_a_straight_boundary_is_the_closed_form) {
    // 100 x 100 cells in boxes of 10; the boundary cuts one column of boxes 3 : 7
    const class_grid grid =
        plane(100, 100, 2, [](const std::vector<double>& x) { return x[0] < 0.43 ? 1 : 2; });
    const metrics::basin_entropy entropy = entropy_of(grid, 10);
    const double cut = -0.3 * std::log(0.3) - 0.7 * std::log(0.7);
    EXPECT_EQ(entropy.n_boxes, 100U);
    EXPECT_EQ(entropy.n_boundary_boxes, 10U);
    EXPECT_NEAR(entropy.boundary, cut, 1e-15);
    EXPECT_NEAR(entropy.whole, cut / 10.0, 1e-15);
    EXPECT_FALSE(entropy.is_above_ln2());
    EXPECT_NEAR(entropy.boundary_error, 0.0, 1e-15) << "every boundary box is the same";
}

TEST(metrics_entropy, of_a_checkerboard_is_ln_2_and_of_three_colours_ln_3) {
    const auto colours = [](int n) {
        return plane(36, 36, n, [n](const std::vector<double>& x) {
            return 1 + (static_cast<int>(x[0] * 36.0) + static_cast<int>(x[1] * 36.0)) % n;
        });
    };
    const metrics::basin_entropy two = entropy_of(colours(2), 6);
    EXPECT_NEAR(two.whole, std::log(2.0), 1e-15);
    EXPECT_NEAR(two.boundary, std::log(2.0), 1e-15);
    const metrics::basin_entropy three = entropy_of(colours(3), 6);
    EXPECT_NEAR(three.boundary, std::log(3.0), 1e-15);
    EXPECT_TRUE(three.is_above_ln2());
}

TEST(metrics_entropy, cells_without_a_class_do_not_count_in_their_box) {
    const class_grid grid = plane(12, 12, 2, [](const std::vector<double>& x) {
        return x[0] < 0.5 ? 0 : x[1] < 0.5 ? 1 : 2;
    });
    const metrics::basin_entropy entropy = entropy_of(grid, 12);  // quarter, quarter, half unknown
    EXPECT_NEAR(entropy.whole, std::log(2.0), 1e-15);
    EXPECT_EQ(entropy_of(grid, 6).n_boxes, 2U);
    EXPECT_EQ(entropy_of(grid, 6).boundary, 0.0);
}

TEST(metrics_entropy, a_box_that_does_not_fit_is_refused) {
    const class_grid grid = plane(12, 8, 1, [](const std::vector<double>&) { return 1; });
    EXPECT_THROW(entropy_of(grid, 9), store_error);
    EXPECT_THROW(entropy_of(grid, 1), store_error);
    EXPECT_THROW(entropy_of(grid, 0), store_error);
}

TEST(metrics_exponents, a_straight_boundary_has_exponent_one_and_dimension_one) {
    for (const double slope : {0.0, 0.37}) {
        const class_grid grid = plane(512, 512, 2, [slope](const std::vector<double>& x) {
            return x[0] + slope * x[1] < 0.6123 ? 1 : 2;
        });
        const power_law uncertainty = uncertainty_of(grid).whole;
        ASSERT_TRUE(uncertainty.is_defined);
        // 2 s cells of every row are uncertain at s; the end of a slanted line is cut off
        EXPECT_NEAR(uncertainty.exponent, 1.0, slope == 0.0 ? 1e-12 : 2e-3);
        const power_law boxes = box_counts_of(grid).whole;
        EXPECT_NEAR(dimension_of(grid, boxes), 1.0, slope == 0.0 ? 1e-12 : 0.02);
        EXPECT_LE(std::abs(dimension_of(grid, boxes) - 1.0), boxes.error() + 1e-12);
    }
}

TEST(metrics_exponents, the_uncertain_fraction_of_a_half_plane_is_twice_the_step) {
    const class_grid grid =
        plane(320, 320, 2, [](const std::vector<double>& x) { return x[0] < 0.5 ? 1 : 2; });
    const power_law law = uncertainty_of(grid).whole;
    ASSERT_EQ(law.scales, (std::vector<double>{1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0}));
    for (std::size_t i = 0; i < law.scales.size(); ++i) {
        EXPECT_DOUBLE_EQ(law.fractions[i],
                         2.0 * law.scales[i] / 288.0);  // 320 less 16 twice
    }
}

TEST(metrics_exponents, a_surface_in_space_has_exponent_one_and_dimension_two) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 64), metric_axis("y", 0.0, 1.0, 72),
                    metric_axis("z", 0.0, 1.0, 80)},
                   2, [](const std::vector<double>& x) { return x[1] < 0.49 ? 1 : 2; });
    EXPECT_NEAR(uncertainty_of(grid).whole.exponent, 1.0, 1e-12);
    EXPECT_NEAR(dimension_of(grid, box_counts_of(grid).whole), 2.0, 1e-12);
}

TEST(metrics_exponents, a_point_on_a_line_has_exponent_one_and_dimension_zero) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 2048)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.49 ? 1 : 2; });
    const power_law law = uncertainty_of(grid).whole;
    EXPECT_NEAR(law.exponent, 1.0, 1e-12);
    EXPECT_NEAR(dimension_of(grid, box_counts_of(grid).whole), 0.0, 1e-12);
    EXPECT_TRUE(std::isnan(law.sampling_error)) << "one part of the map holds all there is";
}

TEST(metrics_exponents, of_a_cantor_set_on_a_line_are_those_of_ln_2_over_ln_3) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 200000)}, 2,
                   [](const std::vector<double>& x) { return cantor_label(x[0]); });
    const power_law law = uncertainty_of(grid).whole;
    // the fraction oscillates with the period ln 3 in ln s around its power law
    EXPECT_NEAR(law.exponent, 1.0 - cantor_dimension, 0.01);
    EXPECT_LE(std::abs(law.exponent - 1.0 + cantor_dimension), 2.0 * law.error());
    const power_law boxes = box_counts_of(grid).whole;
    EXPECT_NEAR(dimension_of(grid, boxes), cantor_dimension, 0.02);
    EXPECT_LE(std::abs(dimension_of(grid, boxes) - cantor_dimension), 2.0 * boxes.error());
    EXPECT_LT(boxes.error(), 0.03);
}

TEST(metrics_exponents, a_cantor_set_times_a_line_has_one_dimension_more) {
    const class_grid grid =
        plane(3000, 1500, 2, [](const std::vector<double>& x) { return cantor_label(x[0]); });
    const power_law law = uncertainty_of(grid).whole;
    EXPECT_NEAR(law.exponent, 1.0 - cantor_dimension, 0.02);
    EXPECT_LE(std::abs(law.exponent - 1.0 + cantor_dimension), 2.0 * law.error());
    const power_law boxes = box_counts_of(grid).whole;
    EXPECT_NEAR(dimension_of(grid, boxes), 1.0 + cantor_dimension, 0.03);
    EXPECT_LE(std::abs(dimension_of(grid, boxes) - 1.0 - cantor_dimension), 2.0 * boxes.error());
}

TEST(metrics_exponents, maps_without_a_boundary_or_too_small_say_so) {
    const class_grid uniform = plane(64, 64, 1, [](const std::vector<double>&) { return 1; });
    EXPECT_FALSE(uncertainty_of(uniform).whole.is_defined);
    EXPECT_EQ(uncertainty_of(uniform).whole.why, "there is no boundary");
    EXPECT_EQ(box_counts_of(uniform).whole.why, "there is no boundary");
    const class_grid small =
        plane(8, 8, 2, [](const std::vector<double>& x) { return x[0] < 0.5 ? 1 : 2; });
    EXPECT_EQ(uncertainty_of(small).whole.why, "the map is too small for three scales");
    EXPECT_EQ(box_counts_of(small).whole.why, "the map is too small for three scales");
}

TEST(metrics_exponents, basins_narrower_than_the_scales_make_no_power_law) {
    // an interval of 4 cells: the uncertain fraction grows up to 4 steps and stays from there on
    const class_grid grid = metric_map(
        {metric_axis("x", 0.0, 1.0, 4000)}, 2,
        [](const std::vector<double>& x) { return std::abs(x[0] - 0.4) < 0.5e-3 ? 1 : 2; });
    EXPECT_EQ(grid.classes[0].n_cells, 4U);
    const power_law law = uncertainty_of(grid).whole;
    EXPECT_TRUE(law.is_defined);
    EXPECT_FALSE(law.is_clear());
    EXPECT_NEAR(law.fractions.front() * 3616.0, 4.0, 1e-9)
        << "two cells on either side, 4000 - 2 * 192";
    EXPECT_NEAR(law.fractions.back() * 3616.0, 12.0, 1e-9) << "the 4 cells, seen from three places";
}

TEST(metrics_exponents, undecided_cells_are_no_boundary_and_no_trial) {
    const class_grid grid = plane(256, 256, 2, [](const std::vector<double>& x) {
        return x[1] < 0.3 ? 0 : x[0] < 0.4 ? 1 : 2;
    });
    const power_law law = uncertainty_of(grid).whole;
    EXPECT_NEAR(law.exponent, 1.0, 0.01);
    EXPECT_NEAR(dimension_of(grid, box_counts_of(grid).whole), 1.0, 0.05);
}

TEST(metrics_exponents, each_class_has_the_exponent_of_its_own_boundary) {
    // left a Cantor set between basins 1 and 2, right a straight line between 2 and 3
    const class_grid grid = plane(2048, 256, 3, [](const std::vector<double>& x) {
        return x[0] < 0.5 ? cantor_label(2.0 * x[0]) : x[0] < 0.75 ? 2 : 3;
    });
    const metrics::scaling_by_class laws = uncertainty_of(grid);
    EXPECT_NEAR(laws.classes[0].exponent, 1.0 - cantor_dimension, 0.07);
    EXPECT_NEAR(laws.classes[2].exponent, 1.0, 1e-9);
    EXPECT_GT(laws.whole.exponent, laws.classes[0].exponent);
}

TEST(metrics_wada, stripes_are_as_far_apart_as_they_are_wide) {
    const class_grid grid = plane(
        90, 60, 3, [](const std::vector<double>& x) { return 1 + static_cast<int>(x[0] * 3.0); });
    const metrics::wada_test wada = wada_of(grid);
    ASSERT_TRUE(wada.is_defined);
    // the border of 2 and 3 runs between columns 59 and 60, that of 1 and 2 between 29 and 30
    EXPECT_DOUBLE_EQ(wada.classes[0].radius, 30.0);
    EXPECT_DOUBLE_EQ(wada.classes[1].radius, 0.0);
    EXPECT_DOUBLE_EQ(wada.radius(), 30.0);
    EXPECT_EQ(wada.classes[1].n_cells, 240U);
    EXPECT_DOUBLE_EQ(wada.beyond(0), 0.5);
    EXPECT_FALSE(wada.is_wada(8.0));
    EXPECT_TRUE(wada.is_wada(30.0));
}

TEST(metrics_wada, a_basin_without_a_common_boundary_is_infinitely_far) {
    const class_grid grid = plane(90, 60, 3, [](const std::vector<double>& x) {
        return x[0] < 0.3 ? 1 : x[0] < 0.6 ? 2 : x[0] < 0.7 ? 0 : 3;
    });
    EXPECT_TRUE(std::isinf(wada_of(grid).radius()));
}

TEST(metrics_wada, it_takes_three_basins) {
    const class_grid grid =
        plane(20, 20, 2, [](const std::vector<double>& x) { return x[0] < 0.5 ? 1 : 2; });
    EXPECT_FALSE(wada_of(grid).is_defined);
}

TEST(metrics_wada, three_basins_in_turn_in_the_gaps_of_a_cantor_set_share_one_boundary) {
    // between any two gaps there are gaps of every later generation: a Wada set on a line
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 59049)}, 3,
                   [](const std::vector<double>& x) { return 1 + cantor_generation(x[0]) % 3; });
    // at resolution 3^-10 gaps of the last three generations lie within 3^3 cells of each other
    EXPECT_LE(wada_of(grid).radius(), 27.0);
}

}  // namespace
}  // namespace hopscotch::test
