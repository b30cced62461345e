// What traps save: returns that labelled orbits took, against the budget that they may spend.
#include "analysis/labels/plan.hpp"
#include "host/run/trap_gain.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/scratch_run.hpp"

using namespace hopscotch;

namespace {

// plastic impacts: some orbits are caught at once or after one return, others are not
const char* const hoppers = R"([scene]
title = "Hoppers"
[model]
name = "passive_hopper"
[grid]
section = "liftoff"
[[grid.axis]]
name = "liftoff_speed"
min = 0.0
max = 15.0
cells = 40
[[grid.axis]]
name = "mass_ratio"
min = 0.01
max = 100.0
cells = 30
scale = "log"
[question]
kind = "basins"
returns = 1
[output]
tile = [16, 16]
layers = ["label", "outcome", "returns"]
)";

class gain_of_traps : public testing_runs::scratch_run {};

}  // namespace

TEST_F(gain_of_traps, counts_the_returns_of_labelled_cells) {
    run_hooks hooks;
    hooks.plan = [](const scene& what, std::span<const std::uint64_t> searched) {
        return plan_labels(what, searched);
    };
    const run_report report = run(hoppers, "map.h5", {}, 1, hooks);
    ASSERT_TRUE(report.is_finished);
    const map_reader map(report.file);
    const std::vector<double> labels = map.read_all("label");
    const std::vector<double> returns = map.read_all("returns");
    double n_labelled = 0.0;
    double sum = 0.0;
    for (std::size_t cell = 0; cell < labels.size(); ++cell) {
        if (labels[cell] == 0.0) continue;
        ++n_labelled;
        sum += returns[cell];
    }
    ASSERT_GT(n_labelled, 0.0);
    ASSERT_LT(n_labelled, 1200.0) << "some cells spend their returns without a label";
    EXPECT_EQ(static_cast<double>(report.gain.n_labelled), n_labelled);
    EXPECT_EQ(report.gain.returns, sum);
    EXPECT_EQ(report.gain.budget, 1.0);
    EXPECT_EQ(map.attribute("trap_gain"), text_of(report.gain));
}

TEST_F(gain_of_traps, is_the_same_from_a_sample_of_all_cells) {
    const scene scene = parse_scene(hoppers, "scene.toml");
    const label_plan plan = plan_labels(scene);
    run_hooks hooks;
    hooks.plan = [&](const hopscotch::scene&, std::span<const std::uint64_t>) { return plan; };
    const run_report report = run(hoppers, "map.h5", {}, 1, hooks);
    const basin_sample sample = sample_basins(scene, plan);
    EXPECT_EQ(sample.n_cells, 1200u);
    EXPECT_EQ(sample.gain.n_labelled, report.gain.n_labelled);
    EXPECT_EQ(sample.gain.returns, report.gain.returns);
}

TEST(trap_gain, is_the_budget_over_the_mean_number_of_returns) {
    EXPECT_EQ((trap_gain{4, 40.0, 2000.0}.factor()), 200.0);
    EXPECT_EQ((trap_gain{4, 0.0, 2000.0}.factor()), 2000.0) << "all start in a trap";
    EXPECT_EQ(text_of(trap_gain{4, 40.0, 2000.0}),
              "10 returns per labelled orbit of a budget of 2000: 200 times fewer");
}
