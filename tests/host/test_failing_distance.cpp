// The layer failing_distance against distances found by looking at every pair of cells.
#include "analysis/metrics/failing_layer.hpp"
#include "analysis/metrics/read_classes.hpp"
#include "host/store/map_reader.hpp"
#include "tests/host/scratch_run.hpp"

#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

class failing_distance : public testing_runs::scratch_run {};

constexpr const char* runner = R"([scene]
title = "Runner"
[model]
name = "slip"
[model.options]
stance_gravity = "off"
[[grid.axis]]
name = "speed"
min = 3.0
max = 7.0
cells = 23
[[grid.axis]]
name = "angle"
min = -0.2
max = 0.8
cells = 31
[grid]
section = "touchdown"
[question]
kind = "steps_to_fall"
returns = 20
[accuracy]
audit_cells = 0
[output]
tile = [7, 10]
layers = ["outcome", "failing_distance"]
)";

run_hooks with_distances() {
    run_hooks hooks;
    hooks.finish_layers = metrics::fill_failing_distances;
    return hooks;
}

bool fails(double code) { return metrics::is_failure(static_cast<outcome>(int(code))); }

TEST_F(failing_distance, is_the_distance_to_the_nearest_of_all_failing_cells) {
    const run_report report = run(runner, "map.h5", {}, 2, with_distances());
    const map_reader map(report.file);
    const std::vector<double> ends = map.read_all("outcome");
    const std::vector<double> distances = map.read_all("failing_distance");
    int n_failing = 0;
    for (int i = 0; i < 23 * 31; ++i) {
        double nearest = std::numeric_limits<double>::infinity();
        for (int j = 0; j < 23 * 31; ++j) {
            if (!fails(ends[std::size_t(j)])) continue;
            nearest = std::min(nearest, std::hypot(i / 31 - j / 31, i % 31 - j % 31));
        }
        n_failing += fails(ends[std::size_t(i)]);
        EXPECT_NEAR(distances[std::size_t(i)], nearest, 1e-14 * nearest) << i;
    }
    EXPECT_GT(n_failing, 50);
    EXPECT_LT(n_failing, 650);
}

TEST_F(failing_distance, does_not_depend_on_tiles) {
    const run_report small = run(runner, "a.h5", {}, 1, with_distances());
    const run_report large = run(runner, "b.h5", {"output.tile=[23, 31]"}, 2, with_distances());
    EXPECT_EQ(small.hash, large.hash);
}

TEST_F(failing_distance, is_infinite_where_nothing_fails) {
    constexpr const char* hopper = R"([scene]
title = "No orbit of this map fails"
[model]
name = "raibert_pneumatic_simple"
[[grid.axis]]
name = "energy"
min = 0.5
max = 3.0
cells = 5
[grid]
section = "energy"
[question]
kind = "steps_to_fall"
returns = 3
[output]
layers = ["outcome", "failing_distance"]
[accuracy]
audit_cells = 0
)";
    const run_report report = run(hopper, "map.h5", {}, 1, with_distances());
    for (const double distance : map_reader(report.file).read_all("failing_distance")) {
        EXPECT_EQ(distance, std::numeric_limits<double>::infinity());
    }
}

}  // namespace
}  // namespace hopscotch
