// One-sided stability over parameters: the passive hopper's immediate basins against the page's
// closed form in 50 digits, shares of whole basins against an independent iteration of the
// single-impact branch, and a runner's basin between its gaits.
#include "analysis/labels/orbit_sides.hpp"
#include "analysis/labels/plan.hpp"
#include "analysis/labels/plan_points.hpp"
#include "analysis/labels/point_search.hpp"
#include "analysis/labels/slice_attractors.hpp"
#include "analysis/metrics/read_classes.hpp"
#include "analysis/periodic/periodic_orbit.hpp"
#include "analysis/truth/real50.hpp"
#include "host/cli/run_answer.hpp"
#include "host/cli/side_files.hpp"
#include "host/scene/error.hpp"
#include "host/scene/grid.hpp"
#include "tests/host/scratch_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

using number = real50::number;

scene scene_of(const std::string& name, const std::vector<std::string>& overrides) {
    return read_scene(std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/" + name, overrides);
}

/// models/passive_hopper.md, sections 3 and 4: the branch of single impacts above lossless motion
/// k, over half the flight time x.
struct lossless_branch {
    int k;
    number point;  // x*_k = alpha*_k
    number end;    // (k + 1) pi
    number least;  // where most_coupling is smallest

    explicit lossless_branch(int which) : k(which) {
        const number pi = 4 * atan(number(1));
        point = (k + number(0.5)) * pi;
        for (int i = 0; i < 80; ++i) point = k * pi + atan(point);
        end = (k + 1) * pi;
        least = minimum();
    }
    static number speed(const number& x) {
        const number s = sin(x);
        return (x * x - s * s) / (x - s * cos(x));
    }
    static number loss(const number& x) {  // without kappa
        const number p = x * cos(x) - sin(x);
        const number q = x - sin(x) * cos(x);
        return 4 * p * p * p * p / (q * q);
    }
    /// f >= alpha* where kappa is at most this.
    number most_coupling(const number& x) const {
        const number alpha = speed(x);
        return (alpha * alpha - point * point) / loss(x);
    }
    /// Where most_coupling is smallest: it falls to there and rises after (page).
    number minimum() const {
        number low = point + number("1e-6");
        number high = end;
        for (int i = 0; i < 200; ++i) {  // thirds: to 1e-35
            const number third = (high - low) / 3;
            (most_coupling(low + third) < most_coupling(high - third) ? high : low) =
                most_coupling(low + third) < most_coupling(high - third) ? high - third
                                                                         : low + third;
        }
        return low;
    }
    /// r_k(M).
    double reach(double mass_ratio) const {
        const number coupling = number(mass_ratio) / pow(1 + number(mass_ratio), 2);
        number inside = point + number("1e-12");
        number outside = least;
        if (most_coupling(outside) >= coupling) return static_cast<double>(end - point);
        for (int i = 0; i < 120; ++i) {
            const number middle = (inside + outside) / 2;
            (most_coupling(middle) >= coupling ? inside : outside) = middle;
        }
        return static_cast<double>(speed(inside) - point);
    }
};

const sided_orbit& orbit_at(const side_table& table, std::size_t point, const std::string& name) {
    const auto found = std::find_if(
        table.orbits.begin(), table.orbits.end(),
        [&](const sided_orbit& each) { return each.point == point && each.name == name; });
    if (found == table.orbits.end()) throw std::runtime_error("no orbit " + name);
    return *found;
}

TEST(orbit_sides, reach_as_far_as_the_hoppers_closed_form_over_the_mass_ratio) {
    const scene scene =
        scene_of("one_sided_hopper.toml",
                 {"grid.axis.0.max=9.0", "grid.axis.0.cells=4", "grid.axis.1.cells=33",
                  "grid.axis.1.min=0.05", "grid.axis.1.max=20"});
    const side_table table = sides_of(scene, plan_labels(scene));
    ASSERT_EQ(table.n_points, 33u);
    for (const int k : {1, 2}) {
        const lossless_branch branch(k);
        for (std::size_t point = 0; point < table.n_points; ++point) {
            const double mass_ratio = value_of(scene.axes[1], point);
            const sided_orbit& orbit = orbit_at(table, point, "fixed point " + std::to_string(k));
            EXPECT_NEAR(orbit.state[0], static_cast<double>(branch.point), 1e-15);
            const orbit_side& left = orbit.sides[0];
            const orbit_side& right = orbit.sides[1];
            EXPECT_EQ(left.kind, side_kind::repelling);
            EXPECT_EQ(left.extent, 0.0);
            EXPECT_EQ(right.kind, side_kind::attracting);
            EXPECT_NEAR(right.extent, branch.reach(mass_ratio), 1e-12) << k << " " << mass_ratio;
            // next to the point -C beta^(4/3) (1 + (2 / alpha*) (beta / K)^(1/3)) with beta up to
            // 1e-5: the second term, at most 0.011, adds 1/3 of itself to the exponent
            EXPECT_NEAR(right.exponent, 4.0 / 3.0, 4e-3);
            EXPECT_NEAR(left.exponent, 4.0 / 3.0, 4e-3);
            // C_L = 10 C_R; the fits' exponents enter with ln(1e6), from opposite sides
            EXPECT_NEAR(left.coefficient / right.coefficient, 10.0, 1.2);
        }
    }
}

TEST(orbit_sides, are_the_whole_branch_beyond_the_pages_mass_ratios) {
    // page, section 4: k = 1 for M <= 0.103458 or M >= 9.66578; k = 2: 0.0644945 / 15.5052
    struct threshold {
        int k;
        double at;
        bool is_above;
    };
    for (const auto& [k, at, is_above] : {threshold{1, 0.103458, false},
                                          {1, 9.66578, true},
                                          {2, 0.0644945, false},
                                          {2, 15.5052, true}}) {
        const scene scene = scene_of(
            "one_sided_hopper.toml",
            {"grid.axis.0.max=9.0", "grid.axis.0.cells=4", "grid.axis.1.cells=21",
             "grid.axis.1.scale=\"linear\"", "grid.axis.1.min=" + std::to_string(0.999 * at),
             "grid.axis.1.max=" + std::to_string(1.001 * at)});
        const side_table table = sides_of(scene, plan_labels(scene));
        const lossless_branch branch(k);
        const double whole = static_cast<double>(branch.end - branch.point);
        int n_whole = 0;
        for (std::size_t point = 0; point < table.n_points; ++point) {
            const double mass_ratio = value_of(scene.axes[1], point);
            if (std::abs(mass_ratio - at) < 1e-5 * at) continue;  // the page's digits
            const double extent =
                orbit_at(table, point, "fixed point " + std::to_string(k)).sides[1].extent;
            const bool is_whole = std::abs(extent - whole) < 1e-12;
            EXPECT_EQ(is_whole, (mass_ratio > at) == is_above) << k << " " << mass_ratio;
            n_whole += is_whole ? 1 : 0;
        }
        EXPECT_EQ(n_whole, 10);
    }
}

/// Does the orbit of a start on branch 1 tend to alpha*_1? Impacts on the branch in closed form,
/// independent of the kernels.
bool tends_to_first(double alpha, double mass_ratio, double point, double reach) {
    const double coupling = mass_ratio / ((1.0 + mass_ratio) * (1.0 + mass_ratio));
    const auto speed = [](double x) {
        return (x * x - std::sin(x) * std::sin(x)) / (x - std::sin(x) * std::cos(x));
    };
    for (int hop = 0; hop < 1000; ++hop) {
        if (alpha <= point) return false;
        if (alpha <= point + reach) return true;
        double low = point;
        double high = 2.0 * M_PI;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (speed(middle) < alpha ? low : high) = middle;
        }
        const double p = low * std::cos(low) - std::sin(low);
        const double q = low - std::sin(low) * std::cos(low);
        const double square = alpha * alpha - coupling * 4.0 * std::pow(p, 4) / (q * q);
        if (!(square > 0.0)) return false;
        alpha = std::sqrt(square);
    }
    return false;
}

class sides_of_a_run : public testing_runs::scratch_run {};

TEST_F(sides_of_a_run, have_the_share_of_the_whole_basin_that_the_closed_form_gives) {
    constexpr int n_cells = 4000;
    const lossless_branch branch(1);
    const double point = static_cast<double>(branch.point);
    const scene scene =
        scene_of("one_sided_hopper.toml",
                 {"grid.axis.0.min=" + std::to_string(point - 0.5), "grid.axis.0.max=6.283185",
                  "grid.axis.0.cells=" + std::to_string(n_cells), "grid.axis.1.cells=6",
                  "grid.axis.1.min=1", "grid.axis.1.max=12"});
    const run_report report = run_map(scene, choices("map.h5"), {.plan = plan_labels});
    side_table table = sides_of(scene, plan_labels(scene));
    add_shares(table, scene, metrics::read_classes(map_reader(report.file)));
    double largest = 0.0;
    for (std::size_t p = 0; p < table.n_points; ++p) {
        const double mass_ratio = value_of(scene.axes[1], p);
        const double reach = branch.reach(mass_ratio);
        int n = 0;
        for (int i = 0; i < n_cells; ++i) {
            const double alpha = value_of(scene.axes[0], static_cast<std::uint64_t>(i));
            n += tends_to_first(alpha, mass_ratio, point, reach) ? 1 : 0;
        }
        const sided_orbit& orbit = orbit_at(table, p, "fixed point 1");
        EXPECT_EQ(orbit.sides[0].share, 0.0) << "no speed rises";
        // the same cells: all but those that lie on a boundary to rounding
        EXPECT_NEAR(orbit.sides[1].share, static_cast<double>(n) / n_cells, 1.5 / n_cells);
        EXPECT_GE(orbit.sides[1].share_error, 0.0);
        EXPECT_LT(orbit.sides[1].share_error, 0.01);
        largest = std::max(largest, orbit.sides[1].share);
    }
    EXPECT_GT(largest, 0.7);
    EXPECT_LT(orbit_at(table, 0, "fixed point 1").sides[1].share, 0.3);
}

/// Minimal critical shocks of the slices of a map that has just been computed.
metrics::shocks_over_parameters shocks_of(const scene& scene, const std::filesystem::path& file) {
    const label_plan plan = plan_labels(scene);
    return metrics::critical_shocks_of_slices(metrics::read_classes(map_reader(file)),
                                              slices_of(scene, plan, axes_of_points(scene), {}));
}

TEST_F(sides_of_a_run, end_where_critical_shocks_find_other_basins_at_every_mass_ratio) {
    const scene scene =
        scene_of("one_sided_hopper.toml",
                 {"grid.axis.0.min=4.48", "grid.axis.0.max=4.58", "grid.axis.0.cells=4000",
                  "grid.axis.1.cells=8", "grid.axis.1.min=0.5", "grid.axis.1.max=2"});
    const run_report report = run_map(scene, choices("map.h5"), {.plan = plan_labels});
    const metrics::shocks_over_parameters over = shocks_of(scene, report.file);
    ASSERT_EQ(over.slices.size(), 8u);
    constexpr double cell = 0.1 / 4000.0;
    const lossless_branch branch(1);
    for (const metrics::slice_shocks& slice : over.slices) {
        ASSERT_EQ(slice.shocks.size(), 1u);
        const metrics::critical_shock& shock = slice.shocks[0];
        EXPECT_EQ(shock.name, "fixed point 1");
        // it attracts from the right only, as far as r_1(M); other basins are one cell away at most
        EXPECT_LE(shock.in_axis_units.distance, cell);
        const double reach = branch.reach(slice.at[0]);
        EXPECT_GE(shock.extents[0].right, reach - 1e-12);
        EXPECT_LE(shock.extents[0].right, reach + cell + 1e-12);
    }
}

TEST_F(sides_of_a_run, of_runners_have_the_shock_that_reaches_the_unstable_gait) {
    const scene scene =
        scene_of("ghigliazza2005_basins.toml", {"grid.axis.0.cells=2000", "grid.axis.1.cells=5",
                                                "grid.axis.1.min=4.4", "grid.axis.1.max=4.9"});
    const run_report report = run_map(scene, choices("map.h5"), {.plan = plan_labels});
    const metrics::shocks_over_parameters over = shocks_of(scene, report.file);
    ASSERT_EQ(over.slices.size(), 5u);
    const double cell = (scene.axes[0].highest - scene.axes[0].lowest) / 2000.0;
    const plan_points points(scene, {1});
    for (std::size_t i = 0; i < 5; ++i) {
        ASSERT_EQ(over.slices[i].shocks.size(), 1u);
        const metrics::critical_shock& shock = over.slices[i].shocks[0];
        EXPECT_TRUE(shock.is_in_own_basin);
        const double speed = over.slices[i].at[0];
        const double guess[] = {speed, shock.in_axis_units.at[0]};
        const auto unstable = refine_periodic_orbit(points.map_at(i), guess, 1);
        ASSERT_TRUE(unstable && !unstable->is_stable()) << "the nearest other cell is next to it";
        const double distance = unstable->points[1] - shock.point[0];
        EXPECT_GE(shock.in_axis_units.distance, distance);
        EXPECT_LE(shock.in_axis_units.distance, distance + cell);
    }
}

// models/slip.md, section 4: below the gap the stable gait's basin ends at the unstable gait above
// it; the speed is conserved, so that it counts as a parameter
TEST(orbit_sides, of_runners_end_at_their_unstable_gaits_at_every_speed) {
    const scene scene = scene_of("ghigliazza2005_basins.toml",
                                 {"question.kind=\"one_sided\"", "grid.axis.1.cells=5",
                                  "grid.axis.1.min=4.4", "grid.axis.1.max=5.2"});
    const side_table table = sides_of(scene, plan_labels(scene));
    ASSERT_EQ(table.axes, std::vector<std::size_t>{1});
    ASSERT_EQ(table.orbits.size(), 5u);
    const plan_points points(scene, table.axes);
    for (const sided_orbit& orbit : table.orbits) {
        ASSERT_EQ(orbit.sides.size(), 2u);
        const orbit_side& above = orbit.sides[1];
        EXPECT_EQ(above.kind, side_kind::attracting);
        ASSERT_TRUE(above.is_bounded);
        const map_point map = points.map_at(orbit.point);
        const double multiplier = multipliers_at(map, orbit.state, 1, std::vector{1})[0].real();
        EXPECT_NEAR(above.exponent, 1.0, 1e-3);  // a fit at 1e-6 and 1e-5 of the scale
        // |P(x) - x| = |1 - multiplier| d; the exponent's error enters times ln(1e6)
        EXPECT_NEAR(above.coefficient, std::abs(1.0 - multiplier), 2e-2);
        std::vector<double> end = orbit.state;
        end[1] += above.extent;
        const auto gait = refine_periodic_orbit(map, end, 1);
        ASSERT_TRUE(gait.has_value());
        EXPECT_FALSE(gait->is_stable());
        EXPECT_NEAR(end[1], gait->points[1], 1e-12);  // asked: extents to 1e-12
    }
}

// models/raibert_hopper.md: E -> gain E exp(-E) has its fixed point at ln(gain), multiplier 1 -
// ln(gain), and all energies above 0 tend to it; the model's certificate names no points
TEST(orbit_sides, of_the_pneumatic_maps_fixed_point_reach_down_to_rest) {
    const scene scene = parse_scene(R"([scene]
title = "Energies"
[model]
name = "raibert_pneumatic_simple"
[grid]
section = "energy"
[[grid.axis]]
name = "energy"
min = 0.001
max = 4.0
cells = 50
[[grid.axis]]
name = "gain"
min = 1.5
max = 7.0
cells = 12
[question]
kind = "one_sided"
)",
                                    "scene.toml");
    const side_table table = sides_of(scene, plan_labels(scene));
    ASSERT_EQ(table.orbits.size(), 12u);
    for (const sided_orbit& orbit : table.orbits) {
        const double energy = std::log(value_of(scene.axes[1], orbit.point));
        EXPECT_NEAR(orbit.state[0], energy, 1e-14);
        EXPECT_NEAR(orbit.sides[0].extent, energy, 1e-12);
        EXPECT_TRUE(orbit.sides[0].is_bounded);
        EXPECT_FALSE(orbit.sides[1].is_bounded);
        for (const orbit_side& side : orbit.sides) {
            EXPECT_EQ(side.kind, side_kind::attracting);
            EXPECT_NEAR(side.exponent, 1.0, 1e-4);  // a fit at 1e-6 and 1e-5 of the scale
            // |P(x) - x| = ln(gain) d; the exponent's error enters times ln(1e6)
            EXPECT_NEAR(side.coefficient, energy, 1e-3 * energy);
        }
    }
}

// its basin is an interval of one column only on a map of one column
TEST(orbit_sides, are_no_layer_of_maps_with_more_than_one_column) {
    EXPECT_THROW(scene_of("ghigliazza2005_basins.toml",
                          {"question.kind=\"one_sided\"", "output.layers=[\"immediate\"]"}),
                 scene_error);
}

/// Lines of a text file.
std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST_F(sides_of_a_run, are_a_table_and_a_map_over_parameters_orbits_and_sides) {
    const scene scene =
        scene_of("one_sided_hopper.toml", {"grid.axis.0.max=9.0", "grid.axis.0.cells=200",
                                           "grid.axis.1.cells=7", "accuracy.audit_cells=0"});
    const run_report report = run_map(scene, choices("map.h5"), {.plan = plan_labels});
    const std::string told = write_sides(report.file);
    EXPECT_NE(told.find("map_sides.csv"), std::string::npos);
    side_table table = sides_of(scene, plan_labels(scene));
    add_shares(table, scene, metrics::read_classes(map_reader(report.file)));

    const map_reader map(folder_ / "map_sides.h5");
    const std::vector<axis>& axes = map.layout().axes;
    ASSERT_EQ(axes.size(), 3u);
    EXPECT_EQ(axes[0].name, "mass_ratio");
    EXPECT_EQ(axes[0].size(), 7u);
    EXPECT_EQ(axes[1].values, (std::vector<double>{2.0, 3.0}));  // labels of alpha*_1, alpha*_2
    EXPECT_EQ(axes[2].values, (std::vector<double>{-1.0, 1.0}));
    const std::vector<double> extent = map.read_all("extent");
    const std::vector<double> share = map.read_all("basin_share");
    const std::vector<double> kind = map.read_all("kind");
    ASSERT_EQ(table.orbits.size(), 14u);
    for (const sided_orbit& orbit : table.orbits) {
        for (std::size_t side = 0; side < 2; ++side) {
            const std::size_t at =
                (orbit.point * 2 + static_cast<std::size_t>(orbit.label - 2)) * 2 + side;
            EXPECT_EQ(extent[at], orbit.sides[side].extent);
            EXPECT_EQ(share[at], orbit.sides[side].share);
            EXPECT_EQ(kind[at], side == 0 ? 2.0 : 0.0);
        }
    }
    const std::vector<std::string> lines = lines_of(folder_ / "map_sides.csv");
    ASSERT_EQ(lines.size(), 1u + 28u);
    EXPECT_EQ(lines[0],
              "mass_ratio,label,name,period,side,kind,extent,law_exponent,law_coefficient,"
              "basin_share,basin_share_error,is_bounded,liftoff_speed");
    EXPECT_NE(lines[2].find(",2,fixed point 1,1,1,attracting,"), std::string::npos) << lines[2];
}

// in a plane the sides are sectors: their shares add up to the basin's
TEST_F(sides_of_a_run, of_two_columns_are_sixteen_sectors_that_share_the_basin) {
    const scene scene = scene_of("cham2007_fig8_basins.toml",
                                 {"question.kind=\"one_sided\"", "grid.axis.0.cells=60",
                                  "grid.axis.1.cells=60", "accuracy.audit_cells=0"});
    const run_report report = run_map(scene, choices("map.h5"), {.plan = plan_labels});
    side_table table = sides_of(scene, plan_labels(scene));
    add_shares(table, scene, metrics::read_classes(map_reader(report.file)));
    ASSERT_EQ(table.orbits.size(), 2u);
    for (const sided_orbit& orbit : table.orbits) {
        ASSERT_EQ(orbit.sides.size(), 16u);
        double sum = 0.0;
        for (const orbit_side& side : orbit.sides) {
            EXPECT_EQ(side.kind, side_kind::attracting);
            EXPECT_GT(side.extent, 0.0);
            sum += side.share;
        }
        const double n_decided =
            3600.0 - static_cast<double>(report.labels.contains(0) ? report.labels.at(0) : 0);
        EXPECT_NEAR(sum, static_cast<double>(report.labels.at(orbit.label)) / n_decided, 1e-12);
    }
    write_sides(report.file);
    const map_reader map(folder_ / "map_sides.h5");
    EXPECT_EQ(map.layout().axes.back().name, "direction");
    EXPECT_EQ(map.layout().axes.back().values[15], 337.5);
}

}  // namespace
}  // namespace hopscotch
