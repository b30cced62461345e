// Labels of hoppers on nonlinear springs: the persistent hops of every parameter point and the
// intervals that they attract. Source: models/passive_hopper.md sections 4 and 6.
#include "analysis/labels/plan.hpp"
#include "analysis/labels/return_map_samples.hpp"
#include "host/scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace hopscotch {
namespace {

scene nonlinear_scene(const std::vector<std::string>& overrides) {
    std::vector<std::string> all = overrides;
    all.push_back("grid.axis.0.cells=32");
    return read_scene(HOPSCOTCH_SOURCE "/configs/scenes/chatterjee2002_nonlinear.toml", all);
}

const attractor_row* find_row(const label_plan& plan, const std::string& name) {
    const auto found = std::find_if(plan.attractors.begin(), plan.attractors.end(),
                                    [&](const attractor_row& row) { return row.name == name; });
    return found == plan.attractors.end() ? nullptr : &*found;
}

TEST(nonlinear_labels, name_the_page_s_persistent_hop) {
    // one cell from 0 to 0.02: cubic stiffness 0.01; with constant gravity alpha has no mass ratio
    const label_plan plan = plan_labels(nonlinear_scene({"grid.axis.1.cells=1"}));
    EXPECT_EQ(plan.decided_by, decision::intervals);
    ASSERT_NE(find_row(plan, "hopping dies"), nullptr);
    const attractor_row* row = find_row(plan, "fixed point 1");
    ASSERT_NE(row, nullptr);
    EXPECT_NEAR(row->points.at(0), 4.20508972130, 5e-12);
    EXPECT_EQ(row->multipliers_real.at(0), 1.0);
    EXPECT_NE(find_row(plan, "fixed point 2"), nullptr);
}

TEST(nonlinear_labels, traps_begin_at_the_hop_of_their_own_parameter_point) {
    const scene scene = nonlinear_scene({"grid.axis.1.cells=3"});
    const label_plan plan = plan_labels(scene);
    const auto points = parameter_points(scene, plan.point_axes);
    ASSERT_EQ(points.size(), 3u);
    const auto n_traps = static_cast<std::size_t>(plan.n_traps);
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (int k = 1; k <= 2; ++k) {
            map_branch branch{};
            ASSERT_TRUE(scene.model->branch(k, points[p].data(), branch));
            const auto* first = plan.traps.data() + p * n_traps;
            const auto* trap = std::find_if(first, first + n_traps, [&](const trap_interval& t) {
                return t.lowest == branch.base;
            });
            ASSERT_NE(trap, first + n_traps) << "no trap at hop " << k << " of point " << p;
            // what starts in the trap's interior stays above the hop; beyond its end it falls below
            const return_map_samples map(scene, points[p]);
            const double within = trap->lowest + 0.999 * (trap->highest - trap->lowest);
            EXPECT_GE(map.at(within), branch.base);
            if (trap->highest < branch.end * (1.0 - 1e-9)) {
                EXPECT_FALSE(map.at(trap->highest * (1.0 + 1e-6)) >= branch.base);
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
