// One-sided stability by direction: where the immediate basin of an orbit ends.
#include "analysis/labels/plan.hpp"
#include "analysis/labels/point_search.hpp"
#include "analysis/labels/sector_table.hpp"
#include "analysis/periodic/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hopscotch {
namespace {

scene scene_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
    return read_scene(std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/" + name, overrides);
}

// models/slip.md, section 4: below the gap the stable gait's basin ends at the unstable gait above
// it
TEST(stability_sectors, a_runners_basin_ends_at_its_unstable_gait) {
    const scene scene =
        scene_of("ghigliazza2005_basins.toml",
                 {"grid.axis.1.cells=1", "grid.axis.1.min=4.5", "grid.axis.1.max=4.6"});
    const label_plan plan = plan_labels(scene);
    const std::vector<sector_row> rows = sector_table(scene, plan);
    ASSERT_EQ(rows.size(), 1u);
    ASSERT_EQ(rows[0].sectors.size(), 2u);
    const map_point map = plan_points(scene, plan.point_axes).map_at(0);
    const stability_sector& above = rows[0].sectors[1];
    ASSERT_TRUE(above.attracts);
    ASSERT_TRUE(above.is_bounded);
    std::vector<double> end = rows[0].point;
    end[1] += above.extent * rows[0].scale[1];
    const auto gait = refine_periodic_orbit(map, end, 1);
    ASSERT_TRUE(gait.has_value());
    EXPECT_FALSE(gait->is_stable());
    EXPECT_NEAR(end[1], gait->points[1], 1e-12);  // asked: extents to 1e-12
}

// a stable orbit with multiplier mu attracts like |mu| d on both sides (1-D)
TEST(stability_sectors, the_law_next_to_a_hyperbolic_orbit_is_its_multiplier) {
    const scene scene =
        scene_of("ghigliazza2005_basins.toml",
                 {"grid.axis.1.cells=1", "grid.axis.1.min=4.5", "grid.axis.1.max=4.6"});
    const label_plan plan = plan_labels(scene);
    const double multiplier = plan.attractors.at(0).multipliers_real.at(0);
    for (const stability_sector& sector : sector_table(scene, plan).at(0).sectors) {
        EXPECT_NEAR(sector.exponent, 1.0, 1e-3);  // a fit at 1e-6 and 1e-5
        // the exponent's error enters the coefficient times ln(1e6)
        EXPECT_NEAR(sector.coefficient, std::abs(multiplier), 1e-2);
    }
}

// models/openloop_hopper.md, section 7: the boundary between the two hops is the saddle's stable
// manifold, so that starts just inside and just outside the end go to different orbits
TEST(stability_sectors, ends_separate_the_two_hops) {
    const scene scene = scene_of("cham2007_fig8_basins.toml");
    const label_plan plan = plan_labels(scene);
    const std::vector<sector_row> rows = sector_table(scene, plan);
    ASSERT_EQ(rows.size(), 2u);
    const map_point map = plan_points(scene, plan.point_axes).map_at(0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const stability_sector& sector : rows[i].sectors) {
            ASSERT_TRUE(sector.attracts && sector.is_bounded);
            for (const double side : {-1e-9, 1e-9}) {
                std::vector<double> x = rows[i].point;
                for (std::size_t c = 0; c < 2; ++c) {
                    x[c] += sector.extent * (1.0 + side) * sector.direction[c] * rows[i].scale[c];
                }
                const return_jet late = map.jet(x.data(), 400);
                ASSERT_EQ(late.end, outcome::ok);
                const std::size_t expected = side < 0.0 ? i : 1 - i;
                EXPECT_NEAR(late.state[0], rows[expected].point[0], 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
