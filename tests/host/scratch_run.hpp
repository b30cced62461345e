// Runs scenes given as text, into a folder that goes away: for tests of whole maps.
#pragma once

#include "host/run/run_map.hpp"
#include "host/scene/scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

namespace hopscotch::testing_runs {

class scratch_run : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("hopscotch_" + std::string(test->name()) + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    run_choices choices(const std::string& name, int n_threads = 2) const {
        run_choices result;
        result.file = folder_ / name;
        result.n_threads = n_threads;
        result.is_quiet = true;
        return result;
    }
    run_report run(const char* text, const std::string& name,
                   const std::vector<std::string>& overrides = {}, int n_threads = 2,
                   const run_hooks& hooks = {}) const {
        return run_map(parse_scene(text, "scene.toml", overrides), choices(name, n_threads), hooks);
    }

    std::filesystem::path folder_;
};

}  // namespace hopscotch::testing_runs
