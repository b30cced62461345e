// Exact distances on even and uneven axes, distances to failing cells, and minimal critical shocks.
#include "analysis/metrics/critical_shock.hpp"
#include "analysis/metrics/slice_shocks.hpp"
#include "analysis/metrics/distance.hpp"
#include "analysis/metrics/fall_distance.hpp"
#include "tests/analysis/metric_maps.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace hopscotch::test {
namespace {

using metrics::class_grid;
using metrics::length_unit;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An axis of values that a logarithmic scene axis has.
axis log_axis(const std::string& name, double lowest, double highest, std::uint64_t n) {
    axis result = metric_axis(name, std::log(lowest), std::log(highest), n);
    for (double& value : result.values) value = std::exp(value);
    result.scale = "log";
    return result;
}

/// Every distance by looking at every marked cell.
std::vector<double> squared_by_search(const class_grid& grid, length_unit unit) {
    std::vector<std::vector<double>> position;
    for (std::uint64_t cell = 0; cell < grid.cells.size(); ++cell) {
        std::vector<double> x(grid.rank());
        std::uint64_t rest = cell;
        for (std::size_t i = grid.rank(); i-- > 0; rest /= grid.axes[i].size()) {
            x[i] = positions_of(grid.axes[i], unit)[rest % grid.axes[i].size()];
        }
        position.push_back(x);
    }
    std::vector<double> result(grid.cells.size(), infinity);
    for (std::uint64_t a = 0; a < grid.cells.size(); ++a) {
        for (std::uint64_t b = 0; b < grid.cells.size(); ++b) {
            if (grid.cells[b] != 1) continue;
            double sum = 0.0;
            for (std::size_t i = 0; i < grid.rank(); ++i) {
                const double d = position[a][i] - position[b][i];
                sum += d * d;
            }
            result[a] = std::min(result[a], sum);
        }
    }
    return result;
}

std::vector<double> squared_by_transform(const class_grid& grid, length_unit unit) {
    const std::uint64_t size = grid.cells.size() / grid.axes.front().size();
    const metrics::distance_transform distances(
        grid, unit, [&](std::uint64_t i, std::span<std::uint8_t> marks) {
            for (std::uint64_t j = 0; j < size; ++j) marks[j] = grid.cells[i * size + j] == 1;
        });
    std::vector<double> result(grid.cells.size());
    for (std::uint64_t i = 0; i < distances.n_slabs(); ++i) {
        distances.squared(i, std::span(result).subspan(i * size, size));
    }
    return result;
}

TEST(metrics_distance, equals_the_search_over_all_cells_on_one_to_three_axes) {
    const std::vector<std::vector<axis>> maps{
        {metric_axis("x", 0.0, 3.0, 301)},
        {metric_axis("x", 0.0, 3.0, 37), log_axis("y", 0.01, 100.0, 41)},
        {log_axis("x", 0.1, 10.0, 11), metric_axis("y", -1.0, 1.0, 13),
         metric_axis("z", 0.0, 5.0, 9)}};
    std::mt19937 random(3);
    for (const std::vector<axis>& axes : maps) {
        for (const unsigned one_in : {3U, 40U, 100000U}) {
            const class_grid grid = metric_map(axes, 2, [&](const std::vector<double>&) {
                return random() % one_in == 0 ? 2 : 1;
            });
            const std::vector<double> cells = squared_by_search(grid, length_unit::cells);
            EXPECT_EQ(squared_by_transform(grid, length_unit::cells), cells)
                << "integers are exact";
            const std::vector<double> units = squared_by_search(grid, length_unit::axis_units);
            const std::vector<double> found = squared_by_transform(grid, length_unit::axis_units);
            for (std::size_t i = 0; i < units.size(); ++i) {
                if (std::isinf(units[i])) {
                    EXPECT_TRUE(std::isinf(found[i]));
                } else {
                    // a tie may be decided either way: rounding of squares of lengths below 10
                    EXPECT_NEAR(found[i], units[i], 1e-13);
                }
            }
        }
    }
}

TEST(metrics_fall_distance, of_a_half_plane_is_the_number_of_columns) {
    class_grid grid =
        metric_map({metric_axis("x", 0.0, 2.0, 200), metric_axis("y", 0.0, 1.0, 50)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.5 ? 2 : 1; });
    grid.classes[1].is_fall = true;
    const metrics::fall_distances cells = distances_to_falls(grid, length_unit::cells);
    ASSERT_TRUE(cells.is_defined);
    EXPECT_DOUBLE_EQ(cells.classes[0].shortest, 1.0);
    EXPECT_NEAR(cells.classes[0].median, 75.0, 75.0 * 1e-3) << "columns 1 to 150";
    EXPECT_TRUE(std::isnan(cells.classes[1].median)) << "a fall has no distance to itself";
    const metrics::fall_distances units = distances_to_falls(grid, length_unit::axis_units);
    EXPECT_NEAR(units.classes[0].shortest, 0.01, 1e-12);
    EXPECT_NEAR(units.classes[0].median, 0.75, 0.75 * 1e-3);
}

TEST(metrics_fall_distance, is_not_defined_where_nothing_fails) {
    const class_grid grid = metric_map({metric_axis("x", 0.0, 2.0, 20)}, 1,
                                       [](const std::vector<double>&) { return 1; });
    EXPECT_FALSE(distances_to_falls(grid, length_unit::cells).is_defined);
}

metrics::attractor_points points_at(const std::vector<double>& points, int label = 1) {
    attractor_row row;
    row.label = label;
    row.name = "fixed point";
    row.points = points;
    return {{row}, {"x", "y"}, {}};
}

TEST(metrics_critical_shock, is_the_distance_to_a_straight_boundary) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 100), metric_axis("y", 0.0, 2.0, 100)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.7 ? 1 : 2; });
    const auto shock = critical_shocks(grid, points_at({0.5, 1.1})).at(0);
    ASSERT_TRUE(shock.is_defined);
    EXPECT_TRUE(shock.is_in_own_basin);
    // the first cell of the other basin is centred at 0.705; no cell centre lies at y = 1.1 itself
    EXPECT_NEAR(shock.in_axis_units.distance, std::hypot(0.205, 0.01), 1e-12);
    EXPECT_NEAR(shock.in_axis_units.at.at(0), 0.705, 1e-12);
    EXPECT_EQ(shock.in_axis_units.class_there, 1);
    EXPECT_NEAR(shock.in_cells.distance, std::hypot(20.5, 0.5), 1e-9);
    EXPECT_FALSE(shock.in_axis_units.is_limited_by_edge());
    EXPECT_NEAR(shock.extents.at(0).right, 0.205, 1e-12);
    EXPECT_EQ(shock.extents.at(0).right_end, metrics::basin_end::other_basin);
    EXPECT_EQ(shock.extents.at(0).left_end, metrics::basin_end::edge);
    EXPECT_NEAR(shock.extents.at(0).left, 0.495, 1e-12) << "to the first cell's centre";
    EXPECT_EQ(shock.extents.at(1).left_end, metrics::basin_end::edge);
    EXPECT_EQ(shock.extents.at(1).right_end, metrics::basin_end::edge);
}

TEST(metrics_critical_shock, equals_the_search_over_all_cells) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.1, 0.9);
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 57), log_axis("y", 0.05, 1.0, 43)}, 3,
                   [&](const std::vector<double>&) {
                       const auto draw = random() % 50;
                       return draw == 0 ? 2 : draw == 1 ? 3 : draw == 2 ? 0 : 1;
                   });
    for (int i = 0; i < 50; ++i) {
        const std::vector<double> point{unit(random), unit(random)};
        double nearest = infinity;
        for (std::uint64_t cell = 0; cell < grid.cells.size(); ++cell) {
            if (grid.cells[cell] == 0 || grid.cells[cell] == metrics::no_class) continue;
            const double dx = grid.axes[0].values[cell / 43] - point[0];
            const double dy = std::log(grid.axes[1].values[cell % 43]) - std::log(point[1]);
            nearest = std::min(nearest, std::hypot(dx, dy));
        }
        EXPECT_NEAR(critical_shocks(grid, points_at(point)).at(0).in_axis_units.distance, nearest,
                    1e-13);
    }
}

TEST(metrics_critical_shock, along_a_logarithmic_axis_is_a_ratio) {
    class_grid grid = metric_map({log_axis("x", 1.0, 100.0, 1000)}, 2,
                                 [](const std::vector<double>& x) { return x[0] < 20.0 ? 1 : 2; });
    metrics::attractor_points points = points_at({10.0});
    points.columns = {"x"};
    const auto shock = critical_shocks(grid, points).at(0);
    const double step = std::log(100.0) / 1000.0;
    EXPECT_NEAR(shock.in_axis_units.distance, std::log(2.0), step)
        << "the boundary is at a ratio 2";
    EXPECT_NEAR(shock.in_cells.distance, std::log(2.0) / step, 1.0);
}

TEST(metrics_critical_shock, is_the_shortest_of_all_points_of_a_cycle) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 100), metric_axis("y", 0.0, 1.0, 100)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.7 ? 1 : 2; });
    const auto shock = critical_shocks(grid, points_at({0.2, 0.505, 0.6, 0.505, 0.6, 7.0})).at(0);
    EXPECT_EQ(shock.n_points, 3U);
    EXPECT_EQ(shock.n_in_map, 2U) << "the third one lies outside the map";
    EXPECT_NEAR(shock.in_axis_units.distance, 0.105, 1e-12);
    EXPECT_EQ(shock.point, (std::vector<double>{0.6, 0.505}));
}

TEST(metrics_critical_shock, of_a_slice_is_that_of_the_attractor_of_its_parameter) {
    // fixed point at p, its basin up to 0.5 + p / 2, in slices of p along the first axis
    const class_grid grid =
        metric_map({metric_axis("p", 0.0, 0.8, 20), metric_axis("x", -1.0, 2.0, 3000)}, 2,
                   [](const std::vector<double>& at) { return at[1] < 0.5 + at[0] / 2.0 ? 1 : 2; });
    metrics::slice_choice choice;
    choice.axes = {"q", "p"};
    choice.attractors = [&](std::span<const std::uint64_t> at) {
        EXPECT_EQ(at[0], 0U) << "no axis of the map";
        metrics::attractor_points points = points_at({grid.axes[0].values[at[1]]});
        points.columns = {"x"};
        return points;
    };
    const auto over = metrics::critical_shocks_of_slices(grid, choice);
    ASSERT_EQ(over.axes.size(), 1U);
    ASSERT_EQ(over.slices.size(), 20U);
    for (const metrics::slice_shocks& slice : over.slices) {
        const double p = slice.at[0];
        const double distance = slice.shocks.at(0).in_axis_units.distance;
        EXPECT_GE(distance, 0.5 - p / 2.0 - 1e-12);
        EXPECT_LE(distance, 0.5 - p / 2.0 + 1e-3 + 1e-12) << "to a cell's centre";
    }
    choice.axes = {"p", "x"};
    EXPECT_TRUE(metrics::critical_shocks_of_slices(grid, choice).slices.empty());
}

TEST(metrics_critical_shock, says_where_the_maps_edge_is_nearer_than_any_other_basin) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 100), metric_axis("y", 0.0, 1.0, 100)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.7 ? 1 : 2; });
    EXPECT_TRUE(
        critical_shocks(grid, points_at({0.1, 0.5})).at(0).in_axis_units.is_limited_by_edge());
}

TEST(metrics_critical_shock, says_where_an_undecided_cell_is_nearer) {
    const auto shock_with = [](double width) {
        const class_grid grid =
            metric_map({metric_axis("x", 0.0, 1.0, 100), metric_axis("y", 0.0, 1.0, 100)}, 2,
                       [width](const std::vector<double>& x) {
                           return x[0] < 0.7 ? 1 : x[0] < 0.7 + width ? 0 : 2;
                       });
        return critical_shocks(grid, points_at({0.595, 0.495})).at(0);
    };
    EXPECT_FALSE(shock_with(0.0).in_axis_units.is_limited_by_undecided());
    const metrics::critical_shock shock = shock_with(0.1);
    EXPECT_TRUE(shock.in_axis_units.is_limited_by_undecided());
    EXPECT_NEAR(shock.in_axis_units.distance, 0.21, 1e-12);
    EXPECT_NEAR(shock.in_axis_units.distance_to_undecided, 0.11, 1e-12);
    EXPECT_NEAR(shock.extents.at(0).right, 0.11, 1e-12);
    EXPECT_EQ(shock.extents.at(0).right_end, metrics::basin_end::undecided);
}

TEST(metrics_critical_shock, points_off_the_maps_plane_are_left_out) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 100)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.7 ? 1 : 2; });
    metrics::attractor_points points = points_at({0.4, 3.0, 0.5, 4.0});
    EXPECT_EQ(critical_shocks(grid, points).at(0).why, "no point of the attractor lies in the map")
        << "where the plane is unknown";
    points.plane = {{"y", 4.0}};
    const auto shock = critical_shocks(grid, points).at(0);
    EXPECT_EQ(shock.n_in_map, 1U);
    EXPECT_NEAR(shock.in_axis_units.distance, 0.205, 1e-12);
}

TEST(metrics_critical_shock, of_a_parameter_map_is_not_defined) {
    const class_grid grid =
        metric_map({metric_axis("x", 0.0, 1.0, 10), metric_axis("mass_ratio", 0.0, 1.0, 10)}, 2,
                   [](const std::vector<double>& x) { return x[0] < 0.7 ? 1 : 2; });
    const auto shock = critical_shocks(grid, points_at({0.4, 0.5})).at(0);
    EXPECT_FALSE(shock.is_defined);
    EXPECT_EQ(shock.why, "an axis is no state column of the attractors' points");
}

}  // namespace
}  // namespace hopscotch::test
