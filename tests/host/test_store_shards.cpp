// Several processes at one run directory: who may work there, whose lock is taken over, and whose
// files are left alone.
#include "tests/host/sample_map.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/run_directory.hpp"
#include "host/store/run_lock.hpp"
#include "host/store/tile_file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace hopscotch {
namespace {

using test::put_tile;
using test::sample_layout;
using test::sample_options;
using test::sample_summary;
using test::scratch_folder;

class store_shards : public testing::Test {
protected:
    run_options options(const shard& part, if_exists existing = if_exists::refuse) const {
        run_options asked = sample_options(map, existing);
        asked.part = part;
        return asked;
    }

    /// What opening the run says; empty where it is opened.
    std::string refusal(const shard& part) const {
        try {
            const map_run run(layout, options(part, if_exists::resume));
            return "";
        } catch (const store_error& error) {
            return error.what();
        }
    }

    void leave_lock(const std::string& text) const {
        std::filesystem::create_directories(directory);
        std::ofstream(directory / "lock") << text;
    }

    scratch_folder folder;
    std::filesystem::path map = folder / "map.h5";
    std::filesystem::path directory = map_run::directory_of(map);
    map_layout layout = sample_layout({70, 50}, {32, 16});  // 12 tiles
    const shard whole{0, 1};
    const shard first{0, 3};
    const shard second{1, 3};
};

TEST_F(store_shards, shards_work_side_by_side_but_each_only_once) {
    const map_run a(layout, options(first));
    const map_run b(layout, options(second));
    EXPECT_EQ(a.missing_tiles(), (std::vector<std::uint64_t>{0, 3, 6, 9}));
    EXPECT_EQ(b.missing_tiles(), (std::vector<std::uint64_t>{1, 4, 7, 10}));
    EXPECT_NE(refusal(first).find("another run works here: process"), std::string::npos);
}

TEST_F(store_shards, a_whole_run_and_a_shard_exclude_each_other) {
    {
        const map_run run(layout, options(first));
        EXPECT_NE(refusal(whole).find("another run works here"), std::string::npos);
        EXPECT_EQ(refusal(second), "");
    }
    {
        map_run run(layout, options(whole));
        put_tile(run, layout, 0);
        EXPECT_NE(refusal(first).find("another run works here"), std::string::npos);
    }
    EXPECT_EQ(refusal(first), "");
}

TEST_F(store_shards, a_refused_run_leaves_no_lock_behind) {
    {
        const map_run run(layout, options(first));
        EXPECT_NE(refusal(whole), "");
    }
    EXPECT_FALSE(std::filesystem::exists(directory / "lock"));
    EXPECT_EQ(refusal(whole), "");
}

TEST_F(store_shards, a_lock_of_another_host_is_explained_with_job_and_age) {
    leave_lock("process 7 host far-away since 2020-01-01T00:00:00Z job 312 start 0\n");
    const std::string said = refusal(whole);
    for (const char* part :
         {"held by process 7 on far-away (job 312), started 2020-01-01T00:00:00Z (",
          " ago), last "
          "sign of life 0:00:0",
          "squeue -j 312 tells; if that run is dead, remove "}) {
        EXPECT_NE(said.find(part), std::string::npos) << part << " in " << said;
    }
    EXPECT_NE(refusal(first), "") << "a shard meets it too";
}

TEST_F(store_shards, a_requeued_job_takes_over_from_its_earlier_start_on_another_host) {
    leave_lock("process 7 host far-away since 2020-01-01T00:00:00Z job 312 start 0\n");
    ::setenv("SLURM_JOB_ID", "312", 1);
    ::setenv("SLURM_RESTART_COUNT", "1", 1);
    {
        const map_run run(layout, options(whole, if_exists::resume));
        ASSERT_EQ(run.notes().size(), 1U);
        EXPECT_NE(run.notes()[0].find("took over from process 7 on far-away (job 312)"),
                  std::string::npos);
    }
    leave_lock("process 7 host far-away since 2020-01-01T00:00:00Z job 312 start 1\n");
    EXPECT_NE(refusal(whole), "") << "two runs of one start are two runs";
    leave_lock("process 7 host far-away since 2020-01-01T00:00:00Z job 99 start 0\n");
    EXPECT_NE(refusal(whole), "") << "another job's lock stays";
    ::unsetenv("SLURM_JOB_ID");
    ::unsetenv("SLURM_RESTART_COUNT");
}

TEST_F(store_shards, every_tile_is_a_sign_of_life) {
    map_run run(layout, options(whole));
    const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(5);
    std::filesystem::last_write_time(directory / "lock", old);
    put_tile(run, layout, 0);
    const auto now = std::filesystem::last_write_time(directory / "lock");
    EXPECT_LT(std::filesystem::file_time_type::clock::now() - now, std::chrono::minutes(1));
}

TEST_F(store_shards, opening_a_shard_leaves_the_files_of_the_others_alone) {
    map_run other(layout, options(second));
    put_tile(other, layout, 1);
    const auto theirs = partial_name(tile_path(directory, 4));
    const auto ours = partial_name(tile_path(directory, 3));
    for (const auto& file : {theirs, ours}) std::ofstream(file) << "half a tile";
    const map_run run(layout, options(first, if_exists::replace));
    EXPECT_TRUE(std::filesystem::exists(theirs));
    EXPECT_FALSE(std::filesystem::exists(ours));
    EXPECT_EQ(tiles_present(directory), std::vector<std::uint64_t>{1});
}

TEST_F(store_shards, joined_shards_are_the_file_of_one_run) {
    test::write_sample_map(folder / "undisturbed.h5", layout);
    for (const std::uint64_t index : {2, 0, 1}) {
        map_run run(layout, options({index, 3}));
        for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    }
    map_run run(layout, options(whole, if_exists::resume));
    run.require_all_tiles();
    run.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), read_bytes(folder / "undisturbed.h5"));
    EXPECT_FALSE(std::filesystem::exists(directory));
}

}  // namespace
}  // namespace hopscotch
