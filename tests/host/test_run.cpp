// The run of a map: its numbers do not depend on threads, tiles or interruptions; what is finished
// is never computed twice; signals and time limits leave a run that can be taken up again.
#include "host/run/attributes.hpp"
#include "host/run/estimate.hpp"
#include "host/run/run_map.hpp"
#include "host/run/stop_condition.hpp"
#include "host/run/summary.hpp"
#include "host/scene/grid.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/fake_model.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include <unistd.h>

using namespace hopscotch;

namespace {

const char* const basins = R"([scene]
title = "Fake basins"
[model]
name = "fake_bouncer"
[[grid.axis]]
name = "height"
min = 0.0
max = 20.0
cells = 50
[[grid.axis]]
name = "gain"
min = 0.25
max = 2.25
cells = 40
[start]
speed = 3
[question]
kind = "basins"
returns = 50
[output]
tile = [16, 16]
layers = ["label", "outcome", "returns", "period", "last_height", "speed", "time", "bounces"]
)";

/// Attractor 1 below 0.5; attractor 2 above 10 times the gain, so that traps differ between
/// columns.
label_plan plan_of(const scene& scene, std::span<const std::uint64_t> = {}) {
    label_plan plan;
    plan.decided_by = decision::intervals;
    plan.point_axes = {1};
    plan.n_traps = 2;
    for (const double gain : values_of(scene.axes[1])) {
        plan.traps.push_back({0.0, 0.5, 1});
        plan.traps.push_back({10.0 * gain, 1e9, 2});
    }
    plan.attractors.resize(2);
    plan.attractors[0].label = 1;
    plan.attractors[0].name = "rest";
    plan.attractors[0].period = 1;
    plan.attractors[1].label = 2;
    plan.attractors[1].name = "far away";
    plan.point_columns = {"height"};
    return plan;
}

class run_of_a_map : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("hopscotch_run_" + std::string(test->name()) + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        fake::on_call = nullptr;
        std::filesystem::remove_all(folder_);
    }

    scene read(const std::vector<std::string>& overrides = {}) const {
        return parse_scene(basins, "basins.toml", overrides, fake::models());
    }
    run_choices choices(const std::string& name, int n_threads = 2) const {
        run_choices result;
        result.file = folder_ / name;
        result.n_threads = n_threads;
        result.is_quiet = true;
        return result;
    }
    run_report run(const std::string& name, const std::vector<std::string>& overrides = {},
                   int n_threads = 2) const {
        return run_map(read(overrides), choices(name, n_threads), {plan_of, {}});
    }

    std::filesystem::path folder_;
};

}  // namespace

TEST_F(run_of_a_map, gives_every_cell_its_own_start_parameters_and_traps) {
    const run_report report = run("map.h5");
    ASSERT_TRUE(report.is_finished);
    const scene scene = read();
    const map_reader map(report.file);
    const std::vector<double> labels = map.read_all("label");
    const std::vector<double> heights = map.read_all("last_height");
    const std::vector<double> returns = map.read_all("returns");
    const std::vector<double> periods = map.read_all("period");
    for (std::uint64_t cell = 0; cell < scene.n_cells(); ++cell) {
        const cell_start start = start_of(scene, coordinates_of(scene, cell));
        const double gain = start.parameters[0];
        double height = start.columns[0];
        int label = 0;
        int n = 0;
        while (label == 0 && n < 50 && height <= 1000.0) {
            height *= gain;
            ++n;
            if (height <= 0.5) label = 1;
            if (height >= 10.0 * gain) label = 2;
        }
        ASSERT_EQ(labels[cell], label) << cell;
        ASSERT_EQ(heights[cell], height) << cell;
        ASSERT_EQ(returns[cell], n) << cell;
        ASSERT_EQ(periods[cell], label == 1 ? 1 : 0) << cell;
    }
}

TEST_F(run_of_a_map, is_the_same_for_any_number_of_threads_and_any_tile) {
    const std::string hash = run("a.h5", {}, 1).hash;
    EXPECT_EQ(hash.size(), 32u);
    EXPECT_EQ(run("b.h5", {}, 4).hash, hash);
    EXPECT_EQ(run("c.h5", {"output.tile=[7, 40]"}, 3).hash, hash);
    EXPECT_EQ(run("d.h5", {"output.tile=[9, 9]", "output.compression=0"}, 2).hash, hash);
    EXPECT_EQ(run("e.h5", {"output.tile=[50, 40]"}, 2).hash, hash);
}

TEST_F(run_of_a_map, counts_shares_outcomes_and_lanes) {
    const run_report report = run("map.h5");
    std::uint64_t cells = 0;
    for (const auto& [label, n] : report.labels) cells += n;
    EXPECT_EQ(cells, 2000u);
    double share = 0.0;
    for (const attractor_row& row : report.attractors) share += row.share;
    const auto none = report.labels.find(0);
    const double unlabelled = none == report.labels.end() ? 0.0 : static_cast<double>(none->second);
    EXPECT_DOUBLE_EQ(share + unlabelled / 2000.0, 1.0);
    EXPECT_EQ(report.tally.lanes.efficiency(), 1.0);
    EXPECT_EQ(report.tally.cells, 2000u);
    const map_reader map(report.file);
    EXPECT_EQ(map.attractors()[1].name, "far away");
    EXPECT_EQ(map.attractors()[1].share, report.attractors[1].share);
}

TEST_F(run_of_a_map, stores_enough_to_read_its_scene_again) {
    const run_report report = run("map.h5", {"grid.axis.0.cells=20"});
    const map_reader map(report.file);
    const scene again = scene_of(map, fake::models());
    EXPECT_EQ(again.fingerprint, read({"grid.axis.0.cells=20"}).fingerprint);
    EXPECT_EQ(map.attribute("model"), "fake_bouncer");
    EXPECT_EQ(map.attribute("hash"), report.hash);
}

TEST_F(run_of_a_map, ends_cleanly_on_a_signal_and_resumes_to_the_same_map) {
    const std::string hash = run("whole.h5").hash;
    std::atomic<int> n_calls = 0;
    fake::on_call = [&] {
        if (++n_calls == 5) std::raise(SIGINT);
    };
    const run_report first = run("part.h5", {}, 1);
    EXPECT_FALSE(first.is_finished);
    EXPECT_FALSE(std::filesystem::exists(first.file));
    EXPECT_EQ(first.n_tiles - first.n_missing, static_cast<std::uint64_t>(n_calls));
    EXPECT_LT(n_calls, 8);  // only the tiles in flight are finished: two tokens on one thread

    EXPECT_THROW(run("part.h5"), store_error);  // not silently taken up, not overwritten

    n_calls = 100;
    run_choices again = choices("part.h5");
    again.existing = if_exists::resume;
    const run_report second = run_map(read(), again, {plan_of, {}});
    EXPECT_TRUE(second.is_finished);
    EXPECT_EQ(static_cast<std::uint64_t>(n_calls - 100), first.n_missing);
    EXPECT_EQ(second.hash, hash);
    std::uint64_t cells = 0;
    for (const auto& [label, n] : second.labels) cells += n;
    EXPECT_EQ(cells, 2000u);  // shares count the tiles of both runs

    const run_report third = run_map(read(), again, {plan_of, {}});
    EXPECT_TRUE(third.is_finished);
    EXPECT_EQ(third.tally.cells, 0u);
}

TEST_F(run_of_a_map, begins_no_tile_that_would_outlast_the_walltime) {
    fake::on_call = [] { std::this_thread::sleep_for(std::chrono::milliseconds(30)); };
    run_choices limited = choices("map.h5", 1);
    limited.walltime = 0.2;
    const auto begin = std::chrono::steady_clock::now();
    const run_report report = run_map(read(), limited, {plan_of, {}});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_FALSE(report.is_finished);
    EXPECT_GT(report.n_missing, 0u);
    EXPECT_LT(report.n_missing, report.n_tiles);
    EXPECT_LT(seconds.count(),
              0.4);  // 12 tiles of 30 ms would take 0.36 s; allows a loaded machine
}

TEST_F(run_of_a_map, a_failing_tile_leaves_the_finished_ones) {
    std::atomic<int> n_calls = 0;
    fake::on_call = [&] {
        if (++n_calls == 4) throw std::runtime_error("a kernel's host code failed");
    };
    EXPECT_THROW(run("map.h5", {}, 1), std::runtime_error);
    fake::on_call = nullptr;
    run_choices again = choices("map.h5");
    again.existing = if_exists::resume;
    const run_report report = run_map(read(), again, {plan_of, {}});
    EXPECT_TRUE(report.is_finished);
    EXPECT_LT(report.tally.cells, 2000u);
}

TEST_F(run_of_a_map, refuses_questions_and_backends_it_does_not_have) {
    EXPECT_THROW(run("a.h5", {"question.kind=branch", "output.layers=[\"outcome\"]"}), scene_error);
    EXPECT_THROW(run("a.h5", {"accuracy.precision=dd"}), scene_error);
    run_choices other = choices("a.h5");
    other.backend = "avx2";  // the fake model is built for the scalar backend only
    EXPECT_THROW(run_map(read(), other, {plan_of, {}}), device_error);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.h5"));
}

TEST_F(run_of_a_map, marks_cells_without_a_state_as_not_computed) {
    const run_report report = run("map.h5", {"grid.axis.0.min=-20.0"});
    const map_reader map(report.file);
    const std::vector<double> outcomes = map.read_all("outcome");
    const std::vector<double> heights = map.read_all("last_height");
    for (std::size_t cell = 0; cell < outcomes.size(); ++cell) {
        const bool is_invalid = outcomes[cell] == static_cast<double>(outcome::invalid_start);
        EXPECT_EQ(is_invalid, cell < 1000) << cell;
        EXPECT_EQ(std::isnan(heights[cell]), is_invalid) << cell;
    }
}

TEST_F(run_of_a_map, hands_the_audit_finished_tiles_and_stores_its_words) {
    run_hooks hooks{plan_of, [](const scene&, const label_plan&, const map_run& run) {
                        EXPECT_TRUE(run.missing_tiles().empty());
                        return attribute_list{{"audit_mislabelled", "0"}};
                    }};
    const run_report report = run_map(read(), choices("map.h5"), hooks);
    EXPECT_EQ(map_reader(report.file).attribute("audit_mislabelled"), "0");
    EXPECT_NE(text_of(read(), report).find("audit_mislabelled"), std::string::npos);
}

TEST_F(run_of_a_map, interrupted_during_the_audit_keeps_every_tile) {
    run_hooks hooks{plan_of, [](const scene&, const label_plan&, const map_run&) -> attribute_list {
                        throw interruption();
                    }};
    const run_report first = run_map(read(), choices("map.h5"), hooks);
    EXPECT_FALSE(first.is_finished);
    EXPECT_EQ(first.n_missing, 0u);
    run_choices again = choices("map.h5");
    again.existing = if_exists::resume;
    const run_report second = run_map(read(), again, {plan_of, {}});
    EXPECT_TRUE(second.is_finished);
    EXPECT_EQ(second.tally.cells, 0u);
    EXPECT_FALSE(second.hash.empty());
}

TEST_F(run_of_a_map, an_estimate_counts_cells_tiles_and_bytes_without_touching_the_disk) {
    const run_estimate guess = estimate(read(), choices("map.h5"), {plan_of, {}});
    EXPECT_EQ(guess.n_cells, 2000u);
    EXPECT_EQ(guess.n_tiles, 12u);
    EXPECT_EQ(guess.bytes, 2000u * (2 + 1 + 4 + 2 + 8 + 8 + 8 + 8));
    EXPECT_GT(guess.seconds, 0.0);
    EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST(sample_cells, are_different_in_range_and_repeatable) {
    const auto cells = sample_cells(1000, 100, 7);
    EXPECT_EQ(cells.size(), 100u);
    for (std::size_t i = 1; i < cells.size(); ++i) EXPECT_LT(cells[i - 1], cells[i]);
    EXPECT_LT(cells.back(), 1000u);
    EXPECT_EQ(cells, sample_cells(1000, 100, 7));
    EXPECT_NE(cells, sample_cells(1000, 100, 8));
    EXPECT_EQ(sample_cells(5, 100, 7).size(), 5u);
}
