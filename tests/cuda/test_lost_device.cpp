// A run that loses its GPU on the way: the processor goes on, or the run ends with what was
// finished kept; the map has the bits of an undisturbed one, and the file says what has happened.
#include "analysis/labels/plan.hpp"
#include "host/run/requests.hpp"
#include "host/run/run_map.hpp"
#include "host/store/map_reader.hpp"
#include "tests/cuda/emulated_device.hpp"
#include "tests/cuda/fake_runtime.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

namespace hopscotch {
namespace {

/// 48 tiles, in a folder of its own.
class lost_device : public testing::Test {
protected:
    lost_device()
        : folder_(std::filesystem::temp_directory_path() /
                  ("lost_device_" + std::to_string(getpid()))),
          scene_(read_scene(HOPSCOTCH_SOURCE "/configs/scenes/quickstart.toml",
                            std::vector<std::string>{"grid.axis.0.cells=96", "grid.axis.1.cells=64",
                                                     "output.tile=[8, 16]"})) {
        std::filesystem::create_directory(folder_);
    }
    ~lost_device() override {
        emulation::repair_emulated_devices();
        std::filesystem::remove_all(folder_);
    }

    std::filesystem::path file(const char* name) const { return folder_ / name; }

    /// The run's kernel is that of the emulated GPU, with the scalar one behind it or with none.
    run_report run(const char* name, bool has_processor, if_exists existing = if_exists::refuse) {
        run_choices choices;
        choices.file = file(name);
        choices.n_threads = 2;
        choices.is_quiet = true;
        choices.existing = existing;
        run_hooks hooks;
        hooks.plan = plan_labels;
        hooks.kernel = [&](const scene& scene) {
            const int variant = variant_of(scene);
            const auto of = [&](backend which) {
                return kernel_choice{
                    which, variant, model().kernel(which, variant),
                    which == backend::cuda ? &emulation::emulated_failures : nullptr};
            };
            return has_processor ? kernel_in_use(of(backend::cuda), of(backend::scalar))
                                 : kernel_in_use(of(backend::cuda));
        };
        return run_map(scene_, choices, hooks);
    }

    /// Without a GPU at all.
    std::string hash_of_processor() {
        run_choices choices;
        choices.file = file("processor.h5");
        choices.backend = "scalar";
        choices.is_quiet = true;
        run_hooks hooks;
        hooks.plan = plan_labels;
        return run_map(scene_, choices, hooks).hash;
    }

    /// From the call of that number on every call fails, of one device or of both.
    static void lose(const char* call, int after, int device = -1) {
        emulation::fake_runtime& runtime = emulation::emulated_runtime();
        runtime.lost_device = device;
        runtime.failing_call = call;
        runtime.calls_until_failure = after;
    }

    static const model_entry& model() {
        for (const model_entry* model : emulation::emulated_models()) {
            if (model->info->name == "passive_hopper") return *model;
        }
        throw std::runtime_error("no such model");
    }

    std::filesystem::path folder_;
    scene scene_;
};

TEST_F(lost_device, leaves_no_trace_where_it_is_not_lost) {
    const run_report report = run("map.h5", true);
    EXPECT_EQ(report.backend, "cuda");
    EXPECT_EQ(report.device_failure, "");
    EXPECT_EQ(report.hash, hash_of_processor());
    const map_reader map(file("map.h5"));
    EXPECT_EQ(map.attribute("backend"), "cuda");
    EXPECT_EQ(map.attribute("device_failure"), "");
}

TEST_F(lost_device, is_told_by_a_map_that_the_processor_has_finished) {
    const std::string undisturbed = hash_of_processor();
    for (const char* call : {"cudaLaunchKernel", "cudaStreamSynchronize"}) {
        SCOPED_TRACE(call);
        const int before = emulation::emulated_runtime().seen().n_launches;
        lose(call, 5);
        const run_report report = run("map.h5", true, if_exists::replace);
        EXPECT_GE(emulation::emulated_runtime().seen().n_launches, before + 5);
        EXPECT_TRUE(report.is_finished);
        EXPECT_EQ(report.hash, undisturbed);
        EXPECT_EQ(report.backend, "cuda, scalar");
        // one after the other, and each says why
        for (const char* part : {"device 0: ", "device 1: ", call}) {
            EXPECT_NE(report.device_failure.find(part), std::string::npos) << report.device_failure;
        }
        const map_reader map(file("map.h5"));
        EXPECT_EQ(map.attribute("backend"), "cuda, scalar");
        EXPECT_EQ(map.attribute("device_failure"), report.device_failure);
        ASSERT_FALSE(report.notes.empty());
        EXPECT_NE(report.notes.back().find("computed on by the processor"), std::string::npos);
        emulation::repair_emulated_devices();
    }
}

TEST_F(lost_device, leaves_its_tiles_to_the_other_device_whoever_stands_behind) {
    const std::string undisturbed = hash_of_processor();
    for (const bool has_processor : {true, false}) {
        for (const char* call : {"cudaMemcpyAsync to the host", "cudaStreamSynchronize"}) {
            SCOPED_TRACE(call);
            const auto before = emulation::emulated_runtime().seen().launches_of_device;
            lose(call, 5, 1);
            const run_report report = run("map.h5", has_processor, if_exists::replace);
            const auto after = emulation::emulated_runtime().seen().launches_of_device;
            EXPECT_TRUE(report.is_finished);
            EXPECT_EQ(report.hash, undisturbed);
            EXPECT_EQ(report.backend, "cuda");
            EXPECT_GT(after[1], before[1]);  // its last tile was under way
            EXPECT_GT(after[0] - before[0], 48 - (after[1] - before[1]));  // and was computed again
            const map_reader map(file("map.h5"));
            EXPECT_EQ(map.attribute("backend"), "cuda");
            EXPECT_EQ(map.attribute("device_failure"), report.device_failure);
            EXPECT_EQ(report.device_failure.find(std::string("device 1: ") + call), 0U)
                << report.device_failure;
            ASSERT_FALSE(report.notes.empty());
            EXPECT_NE(report.notes.back().find("computed on by the other devices"),
                      std::string::npos);
            emulation::repair_emulated_devices();
        }
    }
}

TEST_F(lost_device, that_was_asked_for_ends_the_run_and_keeps_what_is_finished) {
    lose("cudaStreamSynchronize", 20);
    try {
        run("map.h5", false);
        FAIL() << "the run has ended without an error";
    } catch (const device_error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("cudaStreamSynchronize"), std::string::npos) << text;
        EXPECT_NE(text.find("--backend auto?"), std::string::npos) << text;
    }
    const std::size_t n_missing = map_reader(file("map.h5")).missing_tiles().size();
    EXPECT_GT(n_missing, 0U);
    EXPECT_LT(n_missing, 48U);
    emulation::repair_emulated_devices();
    const run_report resumed = run("map.h5", false, if_exists::resume);
    EXPECT_EQ(resumed.tally.tiles, n_missing);
    EXPECT_EQ(resumed.hash, hash_of_processor());
}

}  // namespace
}  // namespace hopscotch
