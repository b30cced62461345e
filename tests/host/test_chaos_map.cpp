// The question lyapunov as a map: layers and their values, the audit of the motion, and numbers
// that do not depend on tiles, threads and backends.
#include "host/run/audit.hpp"
#include "host/run/requests.hpp"
#include "host/run/summary.hpp"
#include "host/scene/layers.hpp"
#include "host/store/map_reader.hpp"
#include "kernels/contract/motion.hpp"
#include "tests/host/scratch_run.hpp"

#include <cmath>

using namespace hopscotch;
using testing_runs::scratch_run;

namespace {

const char* const over_gain = R"([scene]
title = "Exponents over the gain"
[model]
name = "raibert_pneumatic_simple"
[grid]
section = "energy"
[[grid.axis]]
name = "gain"
min = 1.2
max = 7.0
cells = 30
[[grid.axis]]
name = "energy"
min = 0.1
max = 2.1
cells = 4
[question]
kind = "lyapunov"
returns = 2400
[accuracy]
audit_cells = 12
[output]
layers = ["lyapunov", "lyapunov_error", "lyapunov_rate", "lyapunov_returns", "outcome"]
)";

std::string error_of(const std::vector<std::string>& overrides) {
    try {
        parse_scene(over_gain, "scene.toml", overrides);
    } catch (const scene_error& error) {
        return error.what();
    }
    return "no error";
}

class chaos_map : public scratch_run {};

}  // namespace

TEST_F(chaos_map, holds_the_exponent_of_every_cell) {
    const run_report report = run(over_gain, "map.h5");
    ASSERT_TRUE(report.is_finished);
    const map_reader map(report.file);
    const std::vector<double> exponents = map.read_all("lyapunov");
    const std::vector<double> rates = map.read_all("lyapunov_rate");
    const std::vector<double> motions = map.read_all("motion");
    const std::vector<double> used = map.read_all("lyapunov_returns");
    const axis& gains = map.layout().axes[0];
    for (std::size_t cell = 0; cell < exponents.size(); ++cell) {
        const double truth = std::log(std::abs(1.0 - std::log(gains.values[cell / 4])));
        EXPECT_NEAR(exponents[cell], truth, 1e-9) << gains.values[cell / 4];
        EXPECT_LT(rates[cell], 0.0);  // returns take about half a second
        EXPECT_EQ(motions[cell], 1.0);
        EXPECT_GE(used[cell], 1000.0);
    }
    EXPECT_EQ(report.motions.at(1), 120u);
    const layer& motion = map.layout().layers[layer_index(map.layout(), "motion")];
    ASSERT_EQ(motion.flags.size(), 5u);
    EXPECT_EQ(motion.flags[2].second, "chaotic");
}

TEST_F(chaos_map, is_the_same_for_any_tile_number_of_threads_and_backend) {
    const std::vector<std::string> chaotic{"grid.axis.0.min=14.0", "grid.axis.0.max=24.0",
                                           "question.error=0.02"};
    const auto with = [&](std::string one) {
        std::vector<std::string> overrides = chaotic;
        if (!one.empty()) overrides.push_back(std::move(one));
        return overrides;
    };
    const run_report first = run(over_gain, "a.h5", with(""), 1);
    EXPECT_GT(first.motions.at(2), 60u);
    EXPECT_EQ(run(over_gain, "b.h5", with("output.tile=[7, 3]"), 3).hash, first.hash);
    run_choices scalar = choices("c.h5");
    scalar.backend = "scalar";
    EXPECT_EQ(run_map(parse_scene(over_gain, "scene.toml", chaotic), scalar, {}).hash, first.hash);
}

TEST_F(chaos_map, is_audited_by_the_motion_in_double_double) {
    run_hooks hooks;
    hooks.audit = [](const scene& what, const label_plan& plan, const map_run& run) {
        const audit_report report = audit(
            what, plan, [&](std::uint64_t tile) { return run.read(tile); },
            what.accuracy.audit_cells);
        return attributes_of(what, report, "map.h5");
    };
    const run_report report =
        run(over_gain, "map.h5", {"grid.axis.0.max=21.0", "grid.axis.0.cells=60"}, 2, hooks);
    EXPECT_EQ(map_reader(report.file).attribute("audit_method"), "motion in dd");
    EXPECT_EQ(map_reader(report.file).attribute("audit_cells"), "12");
    EXPECT_EQ(map_reader(report.file).attribute("audit_wrong"), "0");
}

TEST_F(chaos_map, finds_a_stored_motion_wrong_that_is_wrong) {
    const scene scene = parse_scene(over_gain, "scene.toml");
    const cell_verdict right = judge(scene, {}, 60, static_cast<int>(motion::periodic));
    EXPECT_TRUE(right.agrees());
    const cell_verdict wrong = judge(scene, {}, 60, static_cast<int>(motion::chaotic));
    EXPECT_FALSE(wrong.agrees());
    EXPECT_EQ(wrong.computed, static_cast<int>(motion::periodic));
    EXPECT_TRUE(judge(scene, {}, 60, static_cast<int>(motion::undecided)).agrees());
}

TEST_F(chaos_map, sums_up_its_motions) {
    const scene scene = parse_scene(over_gain, "scene.toml");
    const run_report report = run(over_gain, "map.h5");
    EXPECT_NE(text_of(scene, report).find("periodic"), std::string::npos);
    EXPECT_NE(json_of(scene, report)
                  .find("\"motions\": [\n    {\"value\": 1, \"name\": \"periodic\", "
                        "\"cells\": 120, \"share\": 1}"),
              std::string::npos);
}

TEST_F(chaos_map, offers_one_exponent_per_column_of_the_section) {
    EXPECT_NE(error_of({"output.layers=[\"lyapunov_2\"]"}).find("no layer \"lyapunov_2\""),
              std::string::npos);
    const std::vector<std::string> on_a_juggler{"model.name=\"mirror_planar\"",
                                                "grid.section=\"apex\"",
                                                "grid.axis.0.name=\"bx\"",
                                                "grid.axis.1.name=\"bz\"",
                                                "start.vx=0",
                                                "output.layers=[\"lyapunov_3\"]"};
    const scene planar = parse_scene(over_gain, "scene.toml", on_a_juggler);
    const std::vector<layer_plan> layers = chosen_layers(planar);
    EXPECT_EQ(layers[0].role, layer_role::exponent);
    EXPECT_EQ(layers[0].index, 2);
    EXPECT_EQ(most_returns_of(planar), 3400u) << "the transient comes first";
}

TEST_F(chaos_map, refuses_numbers_that_make_no_estimate) {
    EXPECT_NE(error_of({"question.transient=0"}).find("question.transient = 0"), std::string::npos);
    EXPECT_NE(error_of({"question.min_blocks=4"}).find("at least 8"), std::string::npos);
    EXPECT_NE(error_of({"question.blok=4"}).find("block?"), std::string::npos);
}
