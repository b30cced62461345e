// What goes wrong on disks: one clear message each, and nothing finished is lost.
#include "tests/host/sample_map.hpp"

#include "host/store/atomic_file.hpp"

#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <functional>

namespace hopscotch {
namespace {

using test::put_tile;
using test::sample_layout;
using test::sample_options;
using test::sample_summary;
using test::scratch_folder;

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const store_error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "no error";
}

testing::AssertionResult says(const std::string& message, const std::string& words) {
    if (message.find(words) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "\"" << message << "\" does not say \"" << words << "\"";
}

/// Files of this process may not grow beyond a size while the object lives.
class file_size_limit {
public:
    explicit file_size_limit(rlim_t bytes) : before_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &limit_);
        rlimit lower = limit_;
        lower.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &lower);
    }
    ~file_size_limit() {
        ::setrlimit(RLIMIT_FSIZE, &limit_);
        std::signal(SIGXFSZ, before_);
    }
    file_size_limit(const file_size_limit&) = delete;
    file_size_limit& operator=(const file_size_limit&) = delete;

private:
    rlimit limit_{};
    void (*before_)(int);
};

/// A file system of 256 KiB, where the test may mount one.
class small_disk {
public:
    explicit small_disk(const std::filesystem::path& place) : place_(place) {
        std::filesystem::create_directory(place);
        is_there_ = ::mount("tmpfs", place.c_str(), "tmpfs", 0, "size=256k") == 0;
    }
    ~small_disk() {
        if (is_there_) ::umount(place_.c_str());
    }
    small_disk(const small_disk&) = delete;
    small_disk& operator=(const small_disk&) = delete;

    bool is_there() const { return is_there_; }

private:
    std::filesystem::path place_;
    bool is_there_ = false;
};

class store_errors : public testing::Test {
protected:
    scratch_folder folder;
    std::filesystem::path map = folder / "map.h5";
    map_layout layout = sample_layout({64, 64}, {32, 32});
};

TEST_F(store_errors, an_existing_file_is_refused_before_any_work) {
    std::ofstream(map) << "precious";
    const std::string message = message_of([&] { map_run(layout, sample_options(map)); });
    EXPECT_TRUE(says(message, map.string() + " (there is already a file of that name); remove it"));
    EXPECT_EQ(std::filesystem::file_size(map), 8U);
    EXPECT_FALSE(std::filesystem::exists(map_run::directory_of(map)));
}

TEST_F(store_errors, resuming_over_a_file_that_is_no_map_is_refused) {
    std::ofstream(map) << "precious";
    EXPECT_TRUE(says(message_of([&] { map_run(layout, sample_options(map, if_exists::resume)); }),
                     "not a readable HDF5 file"));
}

TEST_F(store_errors, an_unfinished_run_is_not_thrown_away_by_accident) {
    { put_tile(*std::make_unique<map_run>(layout, sample_options(map)), layout, 3); }
    EXPECT_TRUE(says(message_of([&] { map_run(layout, sample_options(map)); }),
                     "an unfinished run with 1 tile of 4); go on with --resume"));
    const map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.finished_tiles(), std::vector<std::uint64_t>{3});
}

TEST_F(store_errors, a_run_that_put_nothing_leaves_nothing) {
    { const map_run run(layout, sample_options(map)); }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(store_errors, another_scene_cannot_resume_a_run_or_take_its_map) {
    run_options other = sample_options(map, if_exists::resume);
    other.fingerprint = "another";
    { put_tile(*std::make_unique<map_run>(layout, sample_options(map)), layout, 0); }
    EXPECT_TRUE(says(message_of([&] { map_run(layout, other); }), "belongs to another scene"));
    test::write_sample_map(map, layout);
    EXPECT_TRUE(says(message_of([&] { map_run(layout, other); }), "belongs to another scene"));
}

TEST_F(store_errors, tiles_of_another_scene_are_never_removed) {
    run_options other = sample_options(map, if_exists::resume);
    other.fingerprint = "another";
    { put_tile(*std::make_unique<map_run>(layout, sample_options(map)), layout, 0); }
    std::filesystem::remove(map_run::directory_of(map) / "run.h5");
    EXPECT_TRUE(says(message_of([&] { map_run(layout, other); }), "a tile of another scene"));
    const map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.finished_tiles(), std::vector<std::uint64_t>{0});
}

TEST_F(store_errors, a_damaged_run_description_is_written_anew) {
    { put_tile(*std::make_unique<map_run>(layout, sample_options(map)), layout, 0); }
    std::filesystem::resize_file(map_run::directory_of(map) / "run.h5", 0);
    const map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.finished_tiles(), std::vector<std::uint64_t>{0});
    ASSERT_EQ(run.notes().size(), 1U);
    EXPECT_TRUE(says(run.notes()[0], "run.h5"));
}

TEST_F(store_errors, another_grid_cannot_resume_a_run) {
    { put_tile(*std::make_unique<map_run>(layout, sample_options(map)), layout, 0); }
    EXPECT_TRUE(
        says(message_of([&] {
                 map_run(sample_layout({64, 64}, {16, 16}), sample_options(map, if_exists::resume));
             }),
             "another grid or tiles"));
}

TEST_F(store_errors, two_runs_on_one_directory_collide_with_a_clear_error) {
    const map_run first(layout, sample_options(map));
    const std::string message = message_of([&] { map_run(layout, sample_options(map)); });
    EXPECT_TRUE(says(message, "another run works here: process " + std::to_string(::getpid())));
    EXPECT_TRUE(says(message, "wait for it or stop it first?"));
}

TEST_F(store_errors, a_lock_from_another_host_is_not_taken_over) {
    std::filesystem::create_directory(map_run::directory_of(map));
    std::ofstream(map_run::directory_of(map) / "lock")
        << "process 1 host far-away since 2020-01-01T00:00:00Z\n";
    const std::string message = message_of([&] { map_run(layout, sample_options(map)); });
    EXPECT_TRUE(says(message, "held by process 1 on far-away, started 2020-01-01T00:00:00Z"));
    EXPECT_TRUE(says(message, "if that run is dead, remove "));
}

TEST_F(store_errors, a_lock_of_a_dead_run_is_explained_and_taken_over) {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    std::filesystem::create_directory(map_run::directory_of(map));
    std::ofstream(map_run::directory_of(map) / "lock")
        << "process 999999999 host " << host << " since 2020-01-01T00:00:00Z\n";
    const map_run run(layout, sample_options(map));
    ASSERT_EQ(run.notes().size(), 1U);
    EXPECT_TRUE(says(run.notes()[0], "took over from process 999999999"));
}

TEST_F(store_errors, missing_tiles_are_counted_and_named_by_finish) {
    map_run run(layout, sample_options(map));
    put_tile(run, layout, 0);
    const std::string message = message_of([&] { run.finish(sample_summary()); });
    EXPECT_TRUE(says(message, "3 tiles of 4 missing, the first one is 1); go on with --resume?"));
    EXPECT_FALSE(std::filesystem::exists(map));
}

TEST_F(store_errors, a_full_disk_while_computing_keeps_the_finished_tiles) {
    map_run run(layout, sample_options(map));
    put_tile(run, layout, 0);
    {
        const file_size_limit limit(2000);
        EXPECT_TRUE(says(message_of([&] { put_tile(run, layout, 1); }), "cannot be written: "));
    }
    EXPECT_EQ(run.finished_tiles(), std::vector<std::uint64_t>{0});
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    run.finish(sample_summary());
    EXPECT_TRUE(verify_file(map).empty());
}

TEST_F(store_errors, a_full_disk_while_packing_keeps_every_tile) {
    for (const double share : {0.3, 0.6, 0.9, 0.97}) {  // chunks, then metadata at the end
        map_run run(layout, sample_options(map, if_exists::resume));
        for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
        std::uint64_t bytes = 0;
        for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
            for (const auto& chunk : compress(layout, run.read(tile), 4).chunks) {
                bytes += chunk.size();
            }
        }
        const file_size_limit limit(static_cast<rlim_t>(share * static_cast<double>(bytes)));
        EXPECT_NE(message_of([&] { run.finish(sample_summary()); }), "no error");
        EXPECT_FALSE(std::filesystem::exists(map));
        EXPECT_TRUE(run.missing_tiles().empty());
    }
    map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_TRUE(run.missing_tiles().empty());
    run.finish(sample_summary());
    EXPECT_TRUE(verify_file(map).empty());
}

TEST_F(store_errors, a_file_system_without_room_is_named_before_packing) {
    const std::filesystem::path small = folder / "small";
    const small_disk disk(small);
    if (!disk.is_there()) GTEST_SKIP() << "needs the right to mount a small file system";
    map_run run(layout, sample_options(small / "map.h5"));
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    std::ofstream(small / "ballast") << std::string(256 * 1024, 'x');
    EXPECT_TRUE(says(message_of([&] { run.finish(sample_summary()); }),
                     "No space left on device); free some space and go on with --resume?"));
    EXPECT_TRUE(says(message_of([&] { put_tile(run, layout, 0); }), "No space left"));
    std::filesystem::remove(small / "ballast");
    run.finish(sample_summary());
    EXPECT_TRUE(verify_file(small / "map.h5").empty());
}

TEST_F(store_errors, a_folder_that_cannot_be_written_is_named) {
    std::ofstream(folder / "file") << "a file, not a folder";
    EXPECT_TRUE(says(message_of([&] { map_run(layout, sample_options(folder / "file/map.h5")); }),
                     "map.h5.tiles (cannot be made: Not a directory)"));
    EXPECT_TRUE(says(message_of([&] { map_run(layout, sample_options("/proc/map.h5")); }),
                     "/proc/map.h5.tiles (cannot be made: "));
}

TEST_F(store_errors, layers_and_axes_of_one_name_are_refused_at_the_start) {
    layout.layers[3].name = "mass_ratio";
    EXPECT_TRUE(says(message_of([&] { map_run(layout, sample_options(map)); }),
                     "layer mass_ratio has the name of an axis or layer"));
}

TEST_F(store_errors, a_tile_in_the_wrong_place_is_refused) {
    map_run run(layout, sample_options(map));
    compressed_tile tile = compress(layout, test::sample_tile(layout, 1), 4);
    tile.box.index = 2;
    EXPECT_THROW(run.put(tile), std::invalid_argument);
}

}  // namespace
}  // namespace hopscotch
