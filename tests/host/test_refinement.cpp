// Boundary refinement: cells that are computed are those of a full run bit for bit, whatever tiles,
// threads and interruptions; what is not computed says so; what a coarse grid cannot see is known.
#include "host/refine/refinement.hpp"
#include "host/run/run_map.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/fake_model.hpp"
#include "tests/host/scratch_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>

using namespace hopscotch;

namespace {

const char* const basins = R"([model]
name = "fake_bouncer"
[[grid.axis]]
name = "height"
min = 0.0
max = 20.0
cells = 150
[[grid.axis]]
name = "gain"
min = 0.25
max = 2.25
cells = 120
[start]
speed = 3
[question]
kind = "basins"
returns = 50
[output]
tile = [32, 32]
layers = ["label", "outcome", "returns", "time", "period"]
)";

/// Below 0.5 lies attractor 1; attractor 2 above 10 times the gain.
label_plan plan_of(const scene& scene, std::span<const std::uint64_t> = {}) {
    label_plan plan;
    plan.decided_by = decision::intervals;
    plan.point_axes = {1};
    plan.n_traps = 2;
    for (std::uint64_t cell = 0; cell < scene.axes[1].cells; ++cell) {
        const double gain = 0.25 + 2.0 * (static_cast<double>(cell) + 0.5) /
                                       static_cast<double>(scene.axes[1].cells);
        plan.traps.push_back({0.0, 0.5, 1});
        plan.traps.push_back({10.0 * gain, 1e9, 2});
    }
    plan.attractors.resize(2);
    plan.attractors[0].label = 1;
    plan.attractors[0].name = "rest";
    plan.attractors[0].period = 1;
    plan.attractors[1].label = 2;
    plan.attractors[1].name = "far away";
    return plan;
}

const std::vector<std::string> refined{"grid.refine=3"};

class refined_run : public testing_runs::scratch_run {
protected:
    void TearDown() override {
        fake::on_call = nullptr;
        scratch_run::TearDown();
    }
    run_report map(const std::string& name, std::vector<std::string> overrides, int n_threads = 2,
                   if_exists existing = if_exists::refuse) const {
        run_choices how = choices(name, n_threads);
        how.existing = existing;
        return run_map(parse_scene(basins, "scene.toml", overrides, fake::models()), how,
                       {plan_of, {}});
    }
    std::vector<double> layer(const std::string& name, const std::string& what) const {
        return map_reader(folder_ / name).read_all(what);
    }
};

std::vector<std::string> with(std::vector<std::string> overrides, const std::string& more) {
    overrides.push_back(more);
    return overrides;
}

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

TEST_F(refined_run, has_the_full_runs_bits_in_every_computed_cell) {
    map("full.h5", {});
    const run_report report = map("part.h5", refined);
    const std::vector<double> level = layer("part.h5", "level");
    std::uint64_t n_inherited = 0;
    for (const char* name : {"label", "outcome", "returns", "time", "period"}) {
        const std::vector<double> full = layer("full.h5", name);
        const std::vector<double> part = layer("part.h5", name);
        n_inherited = 0;
        for (std::size_t cell = 0; cell < level.size(); ++cell) {
            if (level[cell] == refine::inherited_level) ++n_inherited;
            if (level[cell] == refine::inherited_level) continue;
            ASSERT_LE(level[cell], 4.0);  // 0 to 3, and those along boundaries
            ASSERT_TRUE(is_same(full[cell], part[cell])) << name << " " << cell;
        }
    }
    EXPECT_EQ(report.n_inherited, n_inherited);
    EXPECT_EQ(report.tally.cells, level.size() - n_inherited);  // none was computed twice
    EXPECT_GT(n_inherited, level.size() / 3);
    EXPECT_EQ(map_reader(report.file).attribute("refine_levels"), "3");
}

TEST_F(refined_run, labels_of_smooth_basins_are_those_of_the_full_run) {
    map("full.h5", {});
    map("part.h5", refined);
    EXPECT_EQ(layer("part.h5", "label"), layer("full.h5", "label"));
    EXPECT_EQ(layer("part.h5", "outcome"), layer("full.h5", "outcome"));
}

TEST_F(refined_run, every_cell_that_differs_from_a_neighbour_was_computed) {
    map("part.h5", refined);
    const std::vector<double> level = layer("part.h5", "level");
    const std::vector<double> label = layer("part.h5", "label");
    const std::vector<double> outcome = layer("part.h5", "outcome");
    for (std::size_t i = 0; i < 150; ++i) {
        for (std::size_t j = 0; j + 1 < 120; ++j) {
            const std::size_t cell = i * 120 + j;
            if (label[cell] == label[cell + 1] && outcome[cell] == outcome[cell + 1]) continue;
            EXPECT_NE(level[cell], refine::inherited_level) << i << " " << j;
            EXPECT_NE(level[cell + 1], refine::inherited_level) << i << " " << j;
        }
    }
}

TEST_F(refined_run, numbers_of_inherited_cells_are_not_computed) {
    map("part.h5", refined);
    const std::vector<double> level = layer("part.h5", "level");
    const std::vector<double> returns = layer("part.h5", "returns");
    const std::vector<double> time = layer("part.h5", "time");
    for (std::size_t cell = 0; cell < level.size(); ++cell) {
        const bool is_inherited = level[cell] == refine::inherited_level;
        EXPECT_EQ(returns[cell] == -1.0, is_inherited) << cell;
        EXPECT_TRUE(!is_inherited || std::isnan(time[cell])) << cell;
    }
}

TEST_F(refined_run, is_the_same_for_any_number_of_threads_and_any_tile) {
    const std::string hash = map("a.h5", refined, 1).hash;
    EXPECT_EQ(map("b.h5", refined, 4).hash, hash);
    EXPECT_EQ(map("c.h5", with(refined, "output.tile=[8, 8]"), 3).hash, hash);
    EXPECT_EQ(map("d.h5", with(refined, "output.tile=[150, 16]"), 3).hash, hash);
    EXPECT_EQ(map("e.h5", with(refined, "output.tile=[150, 120]"), 2).hash, hash);
}

TEST_F(refined_run, resumes_to_the_same_map_from_any_round) {
    const std::string hash = map("whole.h5", refined).hash;
    int n_resumed = 0;
    for (const int last_call : {3, 15, 24, 40, 60, 80}) {
        std::atomic<int> n_calls = 0;
        fake::on_call = [&] {
            if (++n_calls == last_call) std::raise(SIGINT);
        };
        const std::string name = "part" + std::to_string(last_call) + ".h5";
        const run_report first = map(name, refined, 1);
        fake::on_call = nullptr;
        if (first.is_finished) {
            EXPECT_EQ(first.hash, hash);
            continue;
        }
        ++n_resumed;
        const run_report second = map(name, refined, 2, if_exists::resume);
        EXPECT_TRUE(second.is_finished);
        EXPECT_EQ(second.hash, hash) << last_call;
        EXPECT_EQ(first.tally.cells + second.tally.cells, 150u * 120u - second.n_inherited);
    }
    EXPECT_GE(n_resumed, 3);
}

TEST_F(refined_run, a_lost_tile_is_computed_again_to_the_same_map) {
    const std::string hash = map("whole.h5", refined).hash;
    run_choices how = choices("kept.h5");
    how.keeps_tiles = true;
    const scene scene = parse_scene(basins, "scene.toml", refined, fake::models());
    run_map(scene, how, {plan_of, {}});
    std::filesystem::remove(map_run::directory_of(how.file) / "tile_000000007.h5");
    how.existing = if_exists::resume;
    EXPECT_EQ(run_map(scene, how, {plan_of, {}}).hash, hash);
}

// Heights stay where they are; those in [7.0, 7.3], cells 56 to 57 of 160, are an attractor.
TEST_F(refined_run, a_feature_within_a_block_is_not_seen_but_one_that_meets_its_corner_is) {
    const char* const strip = R"([model]
name = "fake_bouncer"
[model.parameters]
gain = 1.0
[[grid.axis]]
name = "height"
min = 0.0
max = 20.0
cells = 160
[start]
speed = 3
[question]
kind = "basins"
returns = 5
)";
    const auto plan = [](const scene&, std::span<const std::uint64_t>) {
        label_plan result;
        result.decided_by = decision::intervals;
        result.n_traps = 1;
        result.traps = {{7.0, 7.3, 1}};
        return result;
    };
    const auto n_ones = [&](const std::string& refine) {
        const std::string name = refine + ".h5";
        run_map(parse_scene(strip, "strip.toml", std::vector<std::string>{refine}, fake::models()),
                choices(name), {plan, {}});
        const std::vector<double> labels = layer(name, "label");
        return std::count(labels.begin(), labels.end(), 1.0);
    };
    EXPECT_EQ(n_ones("grid.refine=0"), 2);
    EXPECT_EQ(n_ones("grid.refine=3"), 2);  // cell 56 is a multiple of 8
    EXPECT_EQ(n_ones("grid.refine=4"), 0);  // but not of 16
    const std::vector<double> level = layer("grid.refine=4.h5", "level");
    EXPECT_EQ(std::count(level.begin(), level.end(), 0.0), 10);
    EXPECT_EQ(std::count(level.begin(), level.end(), refine::inherited_level), 150);
}

TEST(refinement, looks_at_a_tile_and_its_neighbours) {
    map_layout layout;
    layout.axes.resize(2);
    layout.axes[0].values.resize(50);
    layout.axes[1].values.resize(40);
    layout.tile = {10, 10};  // 5 x 4 tiles
    EXPECT_EQ(refine::with_neighbours(layout, {0}), (std::vector<std::uint64_t>{0, 1, 4, 5}));
    EXPECT_EQ(refine::with_neighbours(layout, {9}),
              (std::vector<std::uint64_t>{4, 5, 6, 8, 9, 10, 12, 13, 14}));
    EXPECT_EQ(refine::coarse_cells_in(box_of(layout, 0), 3), 4u);
}

TEST(refinement, needs_classes_and_tiles_of_whole_blocks) {
    const auto refusal = [](const std::vector<std::string>& overrides) -> std::string {
        try {
            parse_scene(basins, "scene.toml", overrides, fake::models());
        } catch (const scene_error& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(refusal({"grid.refine=3", "output.tile=[20, 32]"}).find("multiples of 8"),
              std::string::npos);
    EXPECT_NE(refusal({"grid.refine=3", "question.kind=return_map", "output.layers=[\"outcome\"]"})
                  .find("no classes"),
              std::string::npos);
    EXPECT_NE(refusal({"grid.refine=9"}).find("at most 8"), std::string::npos);
    EXPECT_EQ(refusal({"grid.refine=3", "output.tile=[150, 24]"}), "accepted");
}
