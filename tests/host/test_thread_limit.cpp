// `--threads N` holds for a whole command: the search for attractors, tiles and the audit alike,
// in a map and in all maps of a sweep together.
#include "host/run/estimate.hpp"
#include "host/run/run_sweep.hpp"
#include "host/run/thread_limit.hpp"
#include "tests/host/fake_model.hpp"
#include "tests/host/scratch_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include <omp.h>
#include <tbb/global_control.h>

using namespace hopscotch;

namespace {

const char* const basins = R"([model]
name = "fake_bouncer"
[[grid.axis]]
name = "height"
min = 0.0
max = 20.0
cells = 40
[[grid.axis]]
name = "gain"
min = 0.25
max = 2.25
cells = 6
[question]
kind = "basins"
returns = 50
[accuracy]
audit_cells = 10
[output]
tile = [16, 6]
layers = ["label"]
)";

const char* const eight_speeds = R"([[sweep.axis]]
name = "speed"
min = 1.0
max = 2.0
points = 8
)";

scene read_map() {
    const std::vector<std::string> speed{"start.speed=1"};
    return parse_scene(basins, "scene.toml", speed, fake::models());
}

/// The threads that a passage of a run may use, as the passage itself finds.
struct allowed {
    int openmp = 0;  // threads that a region really gets
    std::size_t tbb = 0;
};

allowed allowed_here() {
    allowed found;
    std::atomic<int> n = 0;
#pragma omp parallel
    ++n;
    found.openmp = n;
    found.tbb = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return found;
}

/// Hooks that write down what they find at the plan, the audit and the end of a map.
class watched_run {
public:
    run_hooks hooks() {
        run_hooks result;
        result.plan = [this](const scene&, std::span<const std::uint64_t>) {
            note();
            return label_plan{};
        };
        result.audit = [this](const scene&, const label_plan&, const map_run&) {
            note();
            return attribute_list{};
        };
        result.finish_layers = [this](const scene&, map_run&) { note(); };
        return result;
    }
    const std::vector<allowed>& notes() const { return notes_; }

private:
    void note() {
        const allowed here = allowed_here();
        const std::lock_guard guard(mutex_);
        notes_.push_back(here);
    }
    std::mutex mutex_;
    std::vector<allowed> notes_;
};

class thread_limits : public testing_runs::scratch_run {};

}  // namespace

TEST_F(thread_limits, hold_for_the_search_the_audit_and_the_end_of_a_map) {
    for (const int n_threads : {1, 3}) {
        watched_run watched;
        const scene map = read_map();
        const std::string file = "map" + std::to_string(n_threads) + ".h5";
        ASSERT_TRUE(run_map(map, choices(file, n_threads), watched.hooks()).is_finished);
        ASSERT_EQ(watched.notes().size(), 3U);  // plan, layers, audit
        for (const allowed& here : watched.notes()) {
            EXPECT_EQ(here.openmp, n_threads);
            EXPECT_EQ(here.tbb, static_cast<std::size_t>(n_threads));
        }
    }
}

TEST_F(thread_limits, hold_for_an_estimate) {
    watched_run watched;
    const scene map = read_map();
    estimate(map, choices("none.h5", 1), watched.hooks());
    ASSERT_EQ(watched.notes().size(), 1U);
    EXPECT_EQ(watched.notes()[0].openmp, 1);
}

// maps are drawn by as many threads as there are, so that each searches with one
TEST_F(thread_limits, are_shared_by_the_maps_of_a_sweep) {
    watched_run watched;
    std::vector<allowed> facts;
    std::mutex mutex;
    const sweep_hooks hooks{
        [&](const scene&, const std::filesystem::path&) { return watched.hooks(); },
        [&](const map_reader&) {
            const allowed here = allowed_here();
            const std::lock_guard guard(mutex);
            facts.push_back(here);
            return map_facts{};
        }};
    const scene sweep =
        parse_scene(std::string(eight_speeds) + basins, "scene.toml", {}, fake::models());
    ASSERT_TRUE(run_sweep(sweep, choices("sweep.h5", 3), hooks).is_finished);
    ASSERT_EQ(watched.notes().size(), 3U * 8U);
    ASSERT_EQ(facts.size(), 8U);
    facts.insert(facts.end(), watched.notes().begin(), watched.notes().end());
    for (const allowed& here : facts) {
        EXPECT_EQ(here.openmp, 1);
        EXPECT_EQ(here.tbb, 3U);
    }
}

TEST(thread_limit, ends_with_its_scope) {
    const int before = omp_get_max_threads();
    {
        const thread_limit outer(5);
        EXPECT_EQ(omp_get_max_threads(), 5);
        {
            const thread_limit inner(5, 2);
            EXPECT_EQ(omp_get_max_threads(), 2);
        }
        EXPECT_EQ(omp_get_max_threads(), 5);
    }
    EXPECT_EQ(omp_get_max_threads(), before);
}
