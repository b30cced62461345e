// Sweeps: every map is the one that a scene with those values would give, whatever the order,
// threads, interruptions; the index shows what is there and never what is not.
#include "host/run/run_sweep.hpp"
#include "host/scene/sweep.hpp"
#include "host/store/sweep_index.hpp"
#include "host/store/verify.hpp"
#include "tests/host/fake_model.hpp"
#include "tests/host/scratch_run.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <csignal>

using namespace hopscotch;

namespace {

const char* const swept = R"([model]
name = "fake_bouncer"
[[sweep.axis]]
name = "gain"
values = [0.5, 1.5, 0.75]
[[sweep.axis]]
name = "speed"
min = 1.0
max = 2.0
points = 2
[[grid.axis]]
name = "height"
min = 0.0
max = 20.0
cells = 40
[[grid.axis]]
name = "offset"
min = 0.0
max = 1.0
cells = 6
[question]
kind = "basins"
returns = 50
[output]
tile = [16, 6]
layers = ["label", "outcome", "returns"]
)";

label_plan plan_of(const scene&, std::span<const std::uint64_t> = {}) {
    label_plan plan;
    plan.decided_by = decision::intervals;
    plan.n_traps = 1;
    plan.traps.push_back({0.0, 2.5, 1});
    attractor_row rest;
    rest.label = 1;
    rest.name = "rest";
    rest.period = 1;
    rest.points = {0.25, 0.0};
    plan.attractors = {rest};
    plan.point_columns = {"height", "speed"};
    return plan;
}

const sweep_hooks hooks{[](const scene&, const std::filesystem::path&) {
                            return run_hooks{plan_of, {}};
                        },
                        [](const map_reader&) {
                            return map_facts{{{1, false, "rest", 0.5, 0.125}}, 0.25, 0.75, 1.0};
                        }};

scene read(const std::vector<std::string>& overrides = {}) {
    return parse_scene(swept, "scene.toml", overrides, fake::models());
}

/// The message of the error that reading this scene ends in.
std::string refusal(const std::vector<std::string>& overrides) {
    try {
        read(overrides);
    } catch (const scene_error& error) {
        return error.what();
    }
    return "accepted";
}

class run_of_a_sweep : public testing_runs::scratch_run {
protected:
    void TearDown() override {
        fake::on_call = nullptr;
        scratch_run::TearDown();
    }
    sweep_report sweep(const std::string& name, if_exists existing = if_exists::refuse,
                       int n_threads = 2) const {
        run_choices how = choices(name, n_threads);
        how.existing = existing;
        return run_sweep(read(), how, hooks);
    }
    std::filesystem::path map(const std::string& name, std::uint64_t point) const {
        return sweep_map_path(sweep_directory_of(folder_ / name), point);
    }
};

}  // namespace

TEST(sweep_scene, has_a_point_for_every_combination_in_c_order) {
    const scene scene = read();
    EXPECT_TRUE(is_sweep(scene));
    EXPECT_EQ(sweep_shape(scene.sweep), (std::vector<std::uint64_t>{3, 2}));
    EXPECT_EQ(sweep_values(scene.sweep, sweep_coordinates(scene.sweep, 3)),
              (std::vector<double>{1.5, 2.0}));
    EXPECT_EQ(sweep_dimensions(scene)[0].values, (std::vector<double>{0.5, 1.5, 0.75}));
    EXPECT_EQ(sweep_dimensions(scene)[1].unit, "m/s");
}

TEST(sweep_scene, zip_moves_all_axes_together) {
    const scene scene = read({"sweep.combine=zip", "sweep.axis.1.points=3"});
    EXPECT_EQ(sweep_shape(scene.sweep), std::vector<std::uint64_t>{3});
    EXPECT_EQ(sweep_values(scene.sweep, sweep_coordinates(scene.sweep, 1)),
              (std::vector<double>{1.5, 1.5}));
    EXPECT_EQ(sweep_dimensions(scene)[0].name, "point");
    EXPECT_EQ(sweep_followers(scene)[1].values, (std::vector<double>{1.0, 1.5, 2.0}));
}

TEST(sweep_scene, one_of_its_maps_is_the_plain_scene_with_those_values) {
    const scene map = map_scene(read(), 3);
    EXPECT_FALSE(is_sweep(map));
    EXPECT_EQ(map.parameters[0], 1.5);
    EXPECT_EQ(map.start[1], 2.0);
    const std::string plain = R"([model]
name = "fake_bouncer"
[model.parameters]
gain = 1.5
[start]
speed = 2.0
)" + std::string(swept).substr(std::string(swept).find("[[grid.axis]]"));
    EXPECT_EQ(map.fingerprint, parse_scene(plain, "p.toml", {}, fake::models()).fingerprint);
    EXPECT_EQ(map.fingerprint, read({"sweep.point=[1, 1]"}).fingerprint);
    EXPECT_NE(map.fingerprint, map_scene(read(), 2).fingerprint);
    EXPECT_NE(map.fingerprint, read().fingerprint);
}

TEST(sweep_scene, says_what_is_wrong_with_its_axes) {
    const auto says = [](const std::vector<std::string>& overrides, const char* words) {
        EXPECT_NE(refusal(overrides).find(words), std::string::npos) << refusal(overrides);
    };
    says({"sweep.axis.0.name=height"}, "an axis of the grid as well");
    says({"sweep.axis.0.name=gian"}, "gain?");
    says({"sweep.axis.0.values=[]"}, "at least one value");
    says({"sweep.axis.0.values=[0.5, 9.0]"}, "outside");
    says({"sweep.axis.0.values=[0.5, 0.5]"}, "twice");
    says({"sweep.axis.0.min=1.0"}, "given as well");
    says({"sweep.axis.1.points=1"}, "at least 2");
    says({"sweep.combine=zip"}, "but gain has 3");
    says({"sweep.combine=zap"}, "zip");
    says({"sweep.point=[3, 0]"}, "3 x 2 points");
    says({"model.parameters.gain=1.0"}, "set in model.parameters as well");
    says({"start.speed=1.0"}, "an axis of the sweep as well");
    says({"model.options.law=steep", "sweep.axis.0.values=[1.0, 3.0]"}, "gain <= 2");
}

TEST_F(run_of_a_sweep, gives_the_maps_that_their_own_scenes_give) {
    const sweep_report report = sweep("sweep.h5");
    ASSERT_TRUE(report.is_finished);
    EXPECT_EQ(report.n_computed, 6u);
    EXPECT_EQ(report.tally.cells, 6u * 240u);
    for (std::uint64_t point = 0; point < 6; ++point) {
        const run_report alone =
            run_map(map_scene(read(), point), choices("alone.h5"), run_hooks{plan_of, {}});
        EXPECT_EQ(report.maps[point].hash, alone.hash) << point;
        EXPECT_EQ(map_reader(map("sweep.h5", point)).attribute("hash"), alone.hash) << point;
        EXPECT_TRUE(verify_file(map("sweep.h5", point)).empty());
        std::filesystem::remove(alone.file);
    }
    EXPECT_NE(report.maps[0].hash, report.maps[2].hash);
    EXPECT_FALSE(std::filesystem::exists(report.directory / "lock"));
}

TEST_F(run_of_a_sweep, has_one_hash_for_any_number_of_threads) {
    EXPECT_EQ(sweep("a.h5", if_exists::refuse, 1).hash, sweep("b.h5", if_exists::refuse, 4).hash);
}

TEST_F(run_of_a_sweep, ends_cleanly_on_a_signal_and_resumes_to_the_same_maps) {
    const std::string hash = sweep("whole.h5").hash;
    std::atomic<int> n_calls = 0;
    fake::on_call = [&] {
        if (++n_calls == 8) std::raise(SIGINT);
    };
    const sweep_report first = sweep("part.h5", if_exists::refuse, 1);
    fake::on_call = nullptr;
    EXPECT_FALSE(first.is_finished);
    EXPECT_GT(first.n_missing, 0u);
    EXPECT_LT(first.n_missing, 6u);
    EXPECT_THROW(sweep("part.h5"), store_error);  // neither taken up silently nor overwritten
    const sweep_report second = sweep("part.h5", if_exists::resume);
    EXPECT_TRUE(second.is_finished);
    EXPECT_EQ(second.n_computed, first.n_missing);
    EXPECT_EQ(second.hash, hash);
    EXPECT_LE(second.tally.cells + first.tally.cells, 6u * 240u);  // no tile twice
}

TEST_F(run_of_a_sweep, resume_computes_lost_and_damaged_maps_again) {
    const std::string hash = sweep("sweep.h5").hash;
    std::filesystem::remove(map("sweep.h5", 1));
    std::filesystem::resize_file(map("sweep.h5", 4), 1000);
    const sweep_report again = sweep("sweep.h5", if_exists::resume);
    EXPECT_EQ(again.n_computed, 2u);
    EXPECT_EQ(again.hash, hash);
    EXPECT_EQ(again.notes.size(), 1u);
}

TEST_F(run_of_a_sweep, refuses_to_resume_another_sweep) {
    sweep("sweep.h5");
    run_choices how = choices("sweep.h5");
    how.existing = if_exists::resume;
    EXPECT_THROW(run_sweep(read({"question.returns=51"}), how, hooks), store_error);
}

TEST_F(run_of_a_sweep, a_living_run_keeps_others_out) {
    std::atomic<bool> is_first_call = true;
    std::atomic<bool> is_refused = false;
    fake::on_call = [&] {
        if (!is_first_call.exchange(false)) return;
        try {
            sweep("sweep.h5", if_exists::resume, 1);
        } catch (const store_error&) {
            is_refused = true;
        }
    };
    sweep("sweep.h5", if_exists::refuse, 1);
    EXPECT_TRUE(is_refused);
}

TEST_F(run_of_a_sweep, the_index_tells_it_is_one) {
    const sweep_report report = sweep("sweep.h5");
    EXPECT_EQ(sweep_directory(report.file), report.directory);
    EXPECT_TRUE(sweep_directory(map("sweep.h5", 0)).empty());
    EXPECT_EQ(read_sweep_contents(report.file).hashes.at(5), report.maps[5].hash);
    EXPECT_THROW(map_reader{report.file}, store_error);  // it is no map
}

TEST_F(run_of_a_sweep, an_estimate_counts_all_maps) {
    const run_estimate guess = estimate_sweep(read(), choices("sweep.h5"), hooks);
    EXPECT_EQ(guess.n_maps, 6u);
    EXPECT_EQ(guess.n_cells, 6u * 240u);
    EXPECT_EQ(guess.n_tiles, 6u * 3u);
    EXPECT_EQ(guess.bytes, 6u * 240u * 7u);
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
}
