// Shares and their errors, boundary cells, and pieces: maps whose numbers can be counted by hand or
// integrated.
#include "analysis/metrics/boundary.hpp"
#include "analysis/metrics/components.hpp"
#include "analysis/metrics/shares.hpp"
#include "host/store/store_error.hpp"
#include "tests/analysis/metric_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch::test {
namespace {

using metrics::class_grid;
using metrics::value_box;

class_grid plane(std::uint64_t n, int n_labels, auto&& label_of) {
    return metric_map({metric_axis("x", 0.0, 1.0, n), metric_axis("y", 0.0, 1.0, n)}, n_labels,
                      label_of);
}

class_grid checkerboard(std::uint64_t n) {
    return plane(n, 2, [n](const std::vector<double>& x) {
        const auto cell = [n](double share) {
            return static_cast<int>(share * static_cast<double>(n));
        };
        return 1 + (cell(x[0]) + cell(x[1])) % 2;
    });
}

TEST(metrics_shares, undecided_cells_are_left_out_and_bound_the_share) {
    const class_grid grid = plane(100, 2, [](const std::vector<double>& x) {
        return x[0] < 0.2 ? 0 : x[0] < 0.6 ? 1 : 2;
    });
    const metrics::basin_shares shares = shares_in(grid, value_box::whole(grid));
    EXPECT_EQ(shares.n_cells, 10000U);
    EXPECT_EQ(shares.n_decided, 8000U);
    EXPECT_EQ(grid.n_without_class(), 2000U);
    EXPECT_EQ(shares.classes[0].n_cells, 4000U);
    EXPECT_DOUBLE_EQ(shares.classes[0].share, 0.5);
    EXPECT_DOUBLE_EQ(shares.classes[0].lowest, 0.4);
    EXPECT_DOUBLE_EQ(shares.classes[0].highest, 0.6);
}

TEST(metrics_shares, of_a_line_are_no_surer_than_the_places_of_its_boundaries) {
    // both ends at multiples of 8 cells, so that all interleaved grids agree; an end that lies
    // anywhere in a cell's width has the standard deviation 1 / sqrt(12) of it
    const class_grid line =
        metric_map({metric_axis("x", 0.0, 1.0, 160)}, 2,
                   [](const std::vector<double>& x) { return x[0] > 0.05 && x[0] < 0.85 ? 1 : 2; });
    const metrics::basin_shares shares = shares_in(line, value_box::whole(line));
    EXPECT_DOUBLE_EQ(shares.classes[0].share, 0.8);
    EXPECT_DOUBLE_EQ(shares.classes[0].error, std::sqrt(2.0 / 12.0) / 160.0);
}

TEST(metrics_shares, the_reference_box_is_taken_in_axis_values) {
    const class_grid grid =
        plane(100, 2, [](const std::vector<double>& x) { return x[0] < 0.5 ? 1 : 2; });
    value_box box = value_box::whole(grid);
    box.lowest = {0.4, 0.0};
    box.highest = {0.8, 0.1};
    const metrics::basin_shares shares = shares_in(grid, box);
    EXPECT_EQ(shares.n_cells, 400U);
    EXPECT_DOUBLE_EQ(shares.classes[0].share, 0.25);
    box.lowest = {0.4, 2.0};
    box.highest = {0.8, 3.0};
    EXPECT_THROW(shares_in(grid, box), store_error);
}

TEST(metrics_shares, the_standard_error_covers_the_true_area_of_discs_and_half_planes) {
    // 40 discs and 40 half planes with boundaries anywhere: exact areas are known
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int within_two = 0;
    double errors = 0.0;
    double claimed = 0.0;
    for (int i = 0; i < 80; ++i) {
        const double r = 0.2 + 0.2 * unit(random);
        const double c = 0.45 + 0.1 * unit(random);
        const bool is_disc = i % 2 == 0;
        const double truth = is_disc ? std::numbers::pi * r * r : r;
        const class_grid grid = plane(100, 2, [&](const std::vector<double>& x) {
            return (is_disc ? std::hypot(x[0] - c, x[1] - c) < r : x[0] < r) ? 1 : 2;
        });
        const metrics::basin_share share = shares_in(grid, value_box::whole(grid)).classes[0];
        within_two += std::abs(share.share - truth) <= 2.0 * share.error;
        errors += (share.share - truth) * (share.share - truth);
        claimed += share.error * share.error;
    }
    // a half plane that ends at a multiple of 8 cells claims no error: 1 in 8 of them
    EXPECT_GE(within_two, 72);
    EXPECT_LT(std::sqrt(claimed / errors), 4.0) << "not uselessly large either";
    EXPECT_GT(std::sqrt(claimed / errors), 1.0);
}

TEST(metrics_shares, the_standard_error_shrinks_with_the_cells_not_with_their_root) {
    const auto error_at = [](std::uint64_t n) {
        const class_grid grid = plane(n, 2, [](const std::vector<double>& x) {
            return std::hypot(x[0] - 0.51, x[1] - 0.48) < 0.3 ? 1 : 2;
        });
        return shares_in(grid, value_box::whole(grid)).classes[0].error;
    };
    const double binomial = std::sqrt(0.2827 * 0.7173) / 800.0;
    EXPECT_LT(error_at(800), 0.2 * error_at(100)) << "at least like 1 / n along an axis";
    EXPECT_LT(error_at(800), 0.5 * binomial);
}

TEST(metrics_boundary, a_straight_boundary_has_two_rows_of_cells) {
    const class_grid grid =
        plane(64, 2, [](const std::vector<double>& x) { return x[0] < 0.37 ? 1 : 2; });
    const metrics::boundary_counts counts = count_boundary_cells(grid);
    EXPECT_EQ(counts.n_cells, 128U);
    EXPECT_EQ(counts.of_classes, (std::vector<std::uint64_t>{64, 64}));
}

TEST(metrics_boundary, undecided_cells_make_no_boundary) {
    const class_grid grid = plane(64, 2, [](const std::vector<double>& x) {
        return x[0] < 0.25 ? 1 : x[0] < 0.5 ? 0 : 2;
    });
    EXPECT_EQ(count_boundary_cells(grid).n_cells, 0U);
}

TEST(metrics_boundary, on_a_checkerboard_every_cell_is_on_it) {
    EXPECT_EQ(count_boundary_cells(checkerboard(32)).n_cells, 1024U);
}

TEST(metrics_components, cells_that_touch_at_corners_only_are_pieces_of_their_own) {
    const std::vector<metrics::component_count> pieces = components_of(checkerboard(32));
    EXPECT_EQ(pieces[0].n, 512U);
    EXPECT_EQ(pieces[1].n, 512U);
    EXPECT_EQ(pieces[0].largest, 1U);
}

TEST(metrics_components, rings_are_one_piece_each_until_the_map_cuts_them) {
    const class_grid grid = plane(100, 2, [](const std::vector<double>& x) {
        const int ring = static_cast<int>(std::hypot(x[0] - 0.5, x[1] - 0.5) / 0.1);
        return 1 + std::min(ring, 6) % 2;
    });
    const std::vector<metrics::component_count> pieces = components_of(grid);
    EXPECT_EQ(pieces[0].n, 3U + 4U) << "disc and two rings, and the map's four corners";
    EXPECT_EQ(pieces[1].n, 2U + 4U) << "two rings, and one cut in four";
}

TEST(metrics_components, a_comb_is_joined_at_its_very_end) {
    const class_grid grid = plane(21, 2, [](const std::vector<double>& x) {
        const int row = static_cast<int>(x[1] * 21.0);
        const bool is_tooth = static_cast<int>(x[0] * 21.0) % 2 == 0;
        return is_tooth || row == 20 ? 1 : 2;
    });
    const std::vector<metrics::component_count> pieces = components_of(grid);
    EXPECT_EQ(pieces[0].n, 1U);
    EXPECT_EQ(pieces[0].largest, grid.classes[0].n_cells);
    EXPECT_EQ(pieces[1].n, 10U);
    EXPECT_EQ(pieces[1].largest, 20U);
}

TEST(metrics_components, pieces_are_joined_along_all_three_axes) {
    const auto ball = [](const std::vector<double>& x) {
        return std::hypot(x[0] - 0.5, x[1] - 0.5, x[2] - 0.5) < 0.4 ? 1 : 2;
    };
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 20), metric_axis("y", 0.0, 1.0, 24),
                    metric_axis("z", 0.0, 1.0, 28)},
                   2, ball);
    const std::vector<metrics::component_count> pieces = components_of(grid);
    EXPECT_EQ(pieces[0].n, 1U);
    EXPECT_EQ(pieces[1].n, 1U);
    EXPECT_EQ(pieces[0].largest + pieces[1].largest, 20U * 24U * 28U);
}

TEST(metrics_components, on_one_axis_pieces_are_intervals) {
    const class_grid grid = metric_map(
        {metric_axis("x", 0.0, 1.0, 90)}, 2,
        [](const std::vector<double>& x) { return 1 + static_cast<int>(x[0] * 9.0) % 2; });
    const std::vector<metrics::component_count> pieces = components_of(grid);
    EXPECT_EQ(pieces[0].n, 5U);
    EXPECT_EQ(pieces[1].n, 4U);
    EXPECT_EQ(pieces[1].largest, 10U);
}

}  // namespace
}  // namespace hopscotch::test
