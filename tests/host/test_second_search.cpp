// Maps whose first search has missed an attractor: cells left open are searched once more, the map
// is completed, and a resumed run comes to the same end.
#include "analysis/labels/plan.hpp"
#include "host/run/open_cells.hpp"
#include "host/run/run_map.hpp"
#include "host/store/map_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hopscotch {
namespace {

/// The two hops of models/openloop_hopper.md, section 7, searched from one start only.
scene two_hops(const std::string& tile) {
    return read_scene(std::string(HOPSCOTCH_SOURCE) + "/configs/scenes/cham2007_fig8_basins.toml",
                      std::vector<std::string>{"grid.axis.0.cells=40", "grid.axis.1.cells=40",
                                               "question.returns=400", "question.samples=1",
                                               "accuracy.audit_cells=0", "output.tile=" + tile});
}

run_hooks blind_hooks() {
    run_hooks hooks;
    // the search of low periods would find the second orbit without any sample: only classes of
    // the first are given to the first pass
    hooks.plan = [](const scene& scene, std::span<const std::uint64_t> searched) {
        label_plan plan = plan_labels(scene, searched);
        if (!searched.empty()) return plan;
        for (trap_ellipsoid& trap : plan.ellipsoids) {
            if (trap.label == 2) trap.shape[0] = std::nan("");
        }
        plan.attractors.pop_back();
        return plan;
    };
    return hooks;
}

class second_search : public testing::Test {
protected:
    std::filesystem::path file_ =
        std::filesystem::temp_directory_path() /
        ("hopscotch_second_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
         "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5");
    void TearDown() override {
        std::filesystem::remove(file_);
        std::filesystem::remove_all(map_run::directory_of(file_));
    }
    run_report run(const std::string& tile, if_exists existing,
                   std::optional<double> walltime = {}) {
        run_choices choices;
        choices.file = file_;
        choices.is_quiet = true;
        choices.existing = existing;
        choices.walltime = walltime;
        return run_map(two_hops(tile), choices, blind_hooks());
    }
};

TEST_F(second_search, completes_a_map_whose_first_search_missed_an_attractor) {
    const run_report report = run("[16, 16]", if_exists::replace);
    ASSERT_TRUE(report.is_finished);
    ASSERT_EQ(report.attractors.size(), 2u);
    EXPECT_EQ(report.labels.count(0), 0u);  // none is left open
    EXPECT_GT(report.attractors[1].share, 0.4);
    EXPECT_FALSE(map_reader(file_).attribute(searched_cells).empty());
}

TEST_F(second_search, gives_the_same_map_for_every_tile_size) {
    const std::string hash = run("[16, 16]", if_exists::replace).hash;
    EXPECT_EQ(run("[40, 7]", if_exists::replace).hash, hash);
}

TEST_F(second_search, gives_the_same_map_when_resumed_between_the_passes) {
    const std::string hash = run("[16, 16]", if_exists::replace).hash;
    std::filesystem::remove(file_);
    const scene scene = two_hops("[16, 16]");
    {  // interrupted when the second search is done and kept, before its tiles are computed
        run_hooks hooks = blind_hooks();
        hooks.plan = [plan = hooks.plan](const struct scene& what,
                                         std::span<const std::uint64_t> searched) {
            if (!searched.empty()) std::raise(SIGTERM);
            return plan(what, searched);
        };
        run_choices choices;
        choices.file = file_;
        choices.is_quiet = true;
        EXPECT_FALSE(run_map(scene, choices, hooks).is_finished);
    }
    EXPECT_EQ(run("[16, 16]", if_exists::resume).hash, hash);
}

}  // namespace
}  // namespace hopscotch
