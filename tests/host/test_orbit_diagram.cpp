// Orbit diagrams against known orbits: periods of the pneumatic map, the two folds of the clocked
// hopper seen by sweeps up and down, and the file's axes.
#include "host/store/map_reader.hpp"
#include "host/store/tile_file.hpp"
#include "tests/host/scratch_run.hpp"

#include <cmath>

using namespace hopscotch;
using testing_runs::scratch_run;

namespace {

const char* const over_gain = R"([scene]
title = "Energies over the gain"
[model]
name = "raibert_pneumatic_simple"
[grid]
section = "energy"
[[grid.axis]]
name = "gain"
min = 2.0
max = 12.0
cells = 21
edges = true
[[grid.axis]]
name = "energy"
min = 0.1
max = 2.1
cells = 3
[question]
kind = "orbit_diagram"
transient = 3000
returns = 10
)";

// long thrust: folds at 248.65 and 275.11 ms (models/openloop_hopper.md, section 7)
const char* const folds = R"([scene]
title = "Folds"
[model]
name = "openloop_hopper"
[model.parameters]
thrust = 1.55
thrust_time = 0.08
[grid]
section = "strobe"
[[grid.axis]]
name = "stride_period"
min = 0.24
max = 0.285
cells = 91
edges = true
[start]
height = -0.0027
velocity = -0.02
[question]
kind = "orbit_diagram"
transient = 800
returns = 4
)";

class orbit_diagram : public scratch_run {};

}  // namespace

TEST_F(orbit_diagram, shows_fixed_points_and_cycles_of_the_pneumatic_map) {
    const run_report report = run(over_gain, "map.h5");
    ASSERT_TRUE(report.is_finished);
    const map_reader map(report.file);
    const map_layout& layout = map.layout();
    ASSERT_EQ(layout.axes.size(), 3u);
    EXPECT_EQ(layout.axes[0].name, "gain");
    EXPECT_EQ(layout.axes[1].name, "orbit");
    EXPECT_EQ(layout.axes[1].size(), 5u);  // two sweeps and three starts
    EXPECT_EQ(layout.axes[2].name, "sample");
    EXPECT_EQ(layout.axes[2].size(), 10u);
    const std::vector<double> energies = map.read_all("energy");
    for (std::size_t i = 0; i < energies.size(); ++i) {
        const double gain = layout.axes[0].values[i / 50];
        const double energy = energies[i];
        if (gain < 7.2) {
            EXPECT_NEAR(energy, std::log(gain), 1e-9) << gain;  // E* = ln alpha
        } else if (gain > 7.6) {
            // period 2: E1 + E2 = 2 ln alpha, since E' = alpha E exp(-E) twice is the identity
            const double next = gain * energy * std::exp(-energy);
            EXPECT_NEAR(energy + next, 2.0 * std::log(gain), 1e-9) << gain;
            EXPECT_GT(std::abs(energy - next), 0.1);
        }
    }
}

TEST_F(orbit_diagram, has_no_sweeps_where_none_are_asked_for) {
    const run_report report = run(over_gain, "map.h5", {"question.sweeps=0"});
    const map_reader map(report.file);
    EXPECT_EQ(map.layout().axes[1].values, (std::vector<double>{2.0, 3.0, 4.0}));
    EXPECT_NEAR(map.read_all("energy")[0], std::log(2.0), 1e-12);
}

TEST_F(orbit_diagram, is_the_same_for_any_threads_tiles_and_kernels) {
    const std::string hash = run(over_gain, "a.h5", {}, 1).hash;
    EXPECT_EQ(run(over_gain, "b.h5", {}, 4).hash, hash);
    EXPECT_EQ(run(over_gain, "c.h5", {"output.tile=[1, 1]"}, 3).hash, hash);
    EXPECT_EQ(run(over_gain, "d.h5", {"output.tile=[8, 3]"}, 2).hash, hash);
    run_choices scalar = choices("e.h5");
    scalar.backend = "scalar";
    EXPECT_EQ(run_map(parse_scene(over_gain, "scene.toml"), scalar, {}).hash, hash);
}

TEST_F(orbit_diagram, resumes_from_any_of_its_tiles) {
    const std::string hash = run(over_gain, "whole.h5").hash;
    // 4 pieces of the parameter by 2 sweeps and 3 starts
    const std::vector<std::string> small{"output.tile=[6, 1]"};
    const scene scene = parse_scene(over_gain, "scene.toml", small);
    run_choices kept = choices("kept.h5");
    kept.keeps_tiles = true;
    kept.existing = if_exists::resume;
    EXPECT_EQ(run_map(scene, kept, {}).hash, hash);
    const std::vector<std::vector<std::uint64_t>> losses{
        {0}, {15}, {1}, {16}, {5, 6}, {5, 10, 17}, {2, 8}, {0, 1, 2, 3, 4}, {10, 11, 12, 13, 14}};
    for (const std::vector<std::uint64_t>& lost : losses) {
        for (const std::uint64_t tile : lost) {
            ASSERT_TRUE(std::filesystem::remove(tile_path(folder_ / "kept.h5.tiles", tile)));
        }
        const run_report report = run_map(scene, kept, {});
        EXPECT_TRUE(report.is_finished);
        EXPECT_EQ(report.hash, hash) << "without tile " << lost[0];
        EXPECT_EQ(report.tally.tiles, lost.size());
    }
}

TEST_F(orbit_diagram, resumes_without_the_states_that_it_does_not_store) {
    const std::vector<std::string> heights{"output.layers=[\"height\"]", "output.tile=[20]"};
    const std::string hash = run(folds, "whole.h5", heights).hash;
    const scene scene = parse_scene(folds, "scene.toml", heights);
    run_choices kept = choices("kept.h5");
    kept.keeps_tiles = true;
    kept.existing = if_exists::resume;
    EXPECT_EQ(run_map(scene, kept, {}).hash, hash);
    ASSERT_TRUE(std::filesystem::remove(folder_ / "kept.h5.tiles" / "tile_000000009.h5"));
    const run_report report = run_map(scene, kept, {});
    EXPECT_EQ(report.hash, hash);
    EXPECT_EQ(report.tally.tiles, 1u);
}

TEST_F(orbit_diagram, is_joined_from_shards_that_have_parts_of_its_sweeps) {
    const std::string hash = run(folds, "whole.h5").hash;
    const std::vector<std::string> pieces{"output.tile=[20]"};
    const scene scene = parse_scene(folds, "scene.toml", pieces);
    run_choices part = choices("map.h5");
    for (const std::uint64_t index : {3u, 0u, 1u, 2u}) {
        part.part = {index, 4};
        EXPECT_TRUE(run_map(scene, part, {}).is_part_done);
    }
    run_choices joined = choices("map.h5");
    joined.existing = if_exists::resume;
    joined.is_merge = true;
    EXPECT_EQ(run_map(scene, joined, {}).hash, hash);
}

TEST_F(orbit_diagram, sweeps_up_and_down_leave_their_branch_at_the_two_folds) {
    const run_report report = run(folds, "map.h5", {"output.tile=[20]"});
    const map_reader map(report.file);
    const std::vector<double> heights = map.read_all("height");
    const std::vector<double>& periods = map.layout().axes[0].values;
    constexpr std::size_t per_point = 3 * 4;
    for (std::size_t i = 0; i < periods.size(); ++i) {
        const double rising = heights[i * per_point];
        const double falling = heights[i * per_point + 4];
        // half a millisecond of the grid, and slow passages beside the folds
        const bool is_between = periods[i] > 0.2492 && periods[i] < 0.2749;
        const bool is_beyond = periods[i] < 0.2484 || periods[i] > 0.2756;
        if (is_between) EXPECT_GT(std::abs(rising - falling), 1e-4) << periods[i];
        if (is_beyond) EXPECT_NEAR(rising, falling, 1e-9) << periods[i];
    }
}

TEST_F(orbit_diagram, says_how_an_orbit_ended_instead_of_a_state) {
    const char* const runner = R"([scene]
title = "Ends"
[model]
name = "slip"
[model.parameters]
leg_length = 1.5
stiffness = 10.0
touchdown_angle = 0.7853981633974483
[model.options]
stance_gravity = "off"
[grid]
section = "touchdown"
[[grid.axis]]
name = "speed"
min = 3.94
max = 4.0
cells = 7
edges = true
[start]
angle = 0.3
[question]
kind = "orbit_diagram"
transient = 50
returns = 3
)";
    const run_report report = run(runner, "map.h5");
    const map_reader map(report.file);
    const std::vector<double> angles = map.read_all("angle");
    const std::vector<double> ends = map.read_all("outcome");
    std::size_t n_ended = 0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        EXPECT_EQ(std::isnan(angles[i]), ends[i] != 0.0);
        n_ended += ends[i] != 0.0 ? 1 : 0;
    }
    EXPECT_GT(n_ended, 9u);
    EXPECT_LT(n_ended, angles.size());
}

TEST_F(orbit_diagram, refuses_a_second_parameter_axis) {
    const auto message = [&](const std::vector<std::string>& overrides) {
        try {
            run(over_gain, "map.h5", overrides);
        } catch (const scene_error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_NE(message({"grid.axis.1.name=\"stiffness\"", "start.energy=1"})
                  .find("axis 1 of the grid is a second parameter"),
              std::string::npos);
}
