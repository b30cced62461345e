// A map while it is computed: what survives, what is recomputed, and that the finished file is
// always the same one.
#include "tests/host/sample_map.hpp"

#include "host/store/atomic_file.hpp"
#include "host/store/tile_file.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

namespace hopscotch {
namespace {

using test::put_tile;
using test::sample_layout;
using test::sample_options;
using test::sample_summary;
using test::sample_tile;
using test::scratch_folder;

void flip_byte(const std::filesystem::path& path, std::uint64_t at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(file.get() ^ 0x55);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte);
}

class store_run : public testing::Test {
protected:
    std::vector<std::byte> undisturbed() const {
        test::write_sample_map(folder / "undisturbed.h5", layout);
        return read_bytes(folder / "undisturbed.h5");
    }

    scratch_folder folder;
    std::filesystem::path map = folder / "map.h5";
    map_layout layout = sample_layout({70, 50}, {32, 16});
};

TEST_F(store_run, gives_back_what_was_put) {
    test::write_sample_map(map, layout);
    const map_reader reader(map);
    ASSERT_EQ(reader.layout().axes.size(), 2U);
    EXPECT_EQ(reader.layout().axes[1].name, "mass_ratio");
    EXPECT_EQ(reader.layout().axes[1].values, layout.axes[1].values);
    EXPECT_EQ(reader.layout().axes[1].unit, "m s-1");
    EXPECT_EQ(reader.layout().tile, layout.tile);
    ASSERT_EQ(reader.layout().layers.size(), 4U);
    EXPECT_EQ(reader.layout().layers[1].flags, layout.layers[1].flags);
    EXPECT_EQ(reader.attribute("title"), "Sample map");
    EXPECT_EQ(reader.attribute("audit"), "0 of 1000 cells mislabelled");
    for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) {
        EXPECT_EQ(reader.tile(i).layers, sample_tile(layout, i).layers) << i;
    }
    EXPECT_TRUE(reader.missing_tiles().empty());
    EXPECT_FALSE(std::filesystem::exists(map_run::directory_of(map)));
}

TEST_F(store_run, gives_back_the_attractors) {
    test::write_sample_map(map, layout);
    const map_reader reader(map);
    const std::vector<attractor_row> asked = sample_summary().attractors;
    ASSERT_EQ(reader.attractors().size(), asked.size());
    EXPECT_EQ(reader.point_columns(), sample_summary().point_columns);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        EXPECT_EQ(reader.attractors()[i].label, asked[i].label);
        EXPECT_EQ(reader.attractors()[i].name, asked[i].name);
        EXPECT_EQ(reader.attractors()[i].period, asked[i].period);
        EXPECT_EQ(reader.attractors()[i].points, asked[i].points);
        EXPECT_EQ(reader.attractors()[i].multipliers_real, asked[i].multipliers_real);
        EXPECT_EQ(reader.attractors()[i].multipliers_imaginary, asked[i].multipliers_imaginary);
        EXPECT_EQ(reader.attractors()[i].trap, asked[i].trap);
        EXPECT_EQ(reader.attractors()[i].share, asked[i].share);
        EXPECT_EQ(reader.attractors()[i].colour, asked[i].colour);
    }
    const std::vector<std::pair<int, std::string>> flags{
        {0, "none"}, {1, "fixed point 1"}, {2, "period 2"}, {3, "chaotic"}};
    EXPECT_EQ(reader.layout().layers[0].flags, flags);
}

TEST_F(store_run, writes_the_same_file_whatever_the_order_of_tiles) {
    map_run run(layout, sample_options(map));
    std::vector<std::uint64_t> tiles = run.missing_tiles();
    std::reverse(tiles.begin(), tiles.end());
    std::swap(tiles[1], tiles[5]);
    for (const std::uint64_t tile : tiles) put_tile(run, layout, tile);
    run.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, writes_the_same_file_from_many_threads) {
    map_run run(layout, sample_options(map));
    std::vector<std::thread> threads;
    for (std::uint64_t first = 0; first < 4; ++first) {
        threads.emplace_back([&, first] {
            for (std::uint64_t i = first; i < layout.n_tiles(); i += 4) put_tile(run, layout, i);
        });
    }
    for (std::thread& each : threads) each.join();
    run.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, resumes_with_exactly_the_tiles_that_were_finished) {
    {
        map_run run(layout, sample_options(map));
        for (const std::uint64_t tile : {1, 4, 7}) put_tile(run, layout, tile);
    }
    map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.finished_tiles(), (std::vector<std::uint64_t>{1, 4, 7}));
    EXPECT_TRUE(run.notes().empty());
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    run.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, survives_kill_9_at_any_moment) {
    const pid_t child = ::fork();
    if (child == 0) {
        map_run run(layout, sample_options(map));
        for (std::uint64_t i = 0;; i = (i + 1) % 5) put_tile(run, layout, i);  // until killed
    }
    while (!std::filesystem::exists(tile_path(map_run::directory_of(map), 2))) ::usleep(1000);
    ::usleep(7321);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    map_run run(layout, sample_options(map, if_exists::resume));
    ASSERT_EQ(run.notes().size(), 1U) << "the dead run's lock, and no damaged tile";
    EXPECT_NE(run.notes()[0].find("took over from process " + std::to_string(child)),
              std::string::npos)
        << run.notes()[0];
    EXPECT_GE(run.finished_tiles().size(), 3U);
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    run.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, a_half_written_tile_is_no_tile) {
    {
        map_run run(layout, sample_options(map));
        put_tile(run, layout, 0);
    }
    const std::filesystem::path directory = map_run::directory_of(map);
    const std::filesystem::path partial = partial_name(tile_path(directory, 3));
    std::filesystem::copy_file(tile_path(directory, 0), partial);
    const map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.finished_tiles(), std::vector<std::uint64_t>{0});
    EXPECT_FALSE(std::filesystem::exists(partial));
}

TEST_F(store_run, a_damaged_or_truncated_tile_is_named_removed_and_computed_again) {
    {
        map_run run(layout, sample_options(map));
        for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) put_tile(run, layout, i);
    }
    const std::filesystem::path directory = map_run::directory_of(map);
    const std::vector<std::byte> chunk = compress(layout, sample_tile(layout, 2), 4).chunks[3];
    const std::vector<std::byte> bytes = read_bytes(tile_path(directory, 2));
    const auto at = std::search(bytes.begin(), bytes.end(), chunk.begin(), chunk.end());
    ASSERT_NE(at, bytes.end());
    flip_byte(tile_path(directory, 2), static_cast<std::uint64_t>(at - bytes.begin()) + 20);
    std::filesystem::resize_file(tile_path(directory, 5), 1000);
    std::filesystem::resize_file(tile_path(directory, 6), 0);
    map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.missing_tiles(), (std::vector<std::uint64_t>{2, 5, 6}));
    ASSERT_EQ(run.notes().size(), 3U);
    EXPECT_NE(run.notes()[0].find("tile_000000002.h5"), std::string::npos);
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    run.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, no_flipped_byte_of_a_tile_file_is_ever_read_as_data) {
    const map_layout small = sample_layout({8, 8}, {8, 8});
    const std::filesystem::path directory = folder / "tiles";
    std::filesystem::create_directory(directory);
    const tile_data right = sample_tile(small, 0);
    write_tile(directory, small, "scene", compress(small, right, 4));
    const std::uint64_t size = std::filesystem::file_size(tile_path(directory, 0));
    int n_found = 0;
    for (std::uint64_t at = 0; at < size; at += 3) {
        flip_byte(tile_path(directory, 0), at);
        try {
            const compressed_tile tile = read_tile(directory, small, "scene", 0);
            EXPECT_EQ(checked_tile(small, tile, "tile").layers, right.layers) << at;
        } catch (const store_error&) {
            ++n_found;
        }
        flip_byte(tile_path(directory, 0), at);
    }
    EXPECT_GT(n_found, 0);
}

TEST_F(store_run, a_tile_put_twice_is_replaced) {
    map_run run(layout, sample_options(map));
    tile_data tile = sample_tile(layout, 0);
    fill_numbers(number_type::int16, tile.layers[0].data(), 0, tile.box.n_cells(), 9);
    run.put(compress(layout, tile, 4));
    EXPECT_EQ(run.counts("label"), (value_counts{{9, tile.box.n_cells()}}));
    put_tile(run, layout, 0);
    EXPECT_EQ(run.counts("label").count(9), 0U);
    EXPECT_EQ(run.read(0).layers, sample_tile(layout, 0).layers);
}

TEST_F(store_run, counts_of_a_resumed_run_are_those_of_all_its_tiles) {
    value_counts counts;
    {
        map_run run(layout, sample_options(map));
        for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) put_tile(run, layout, i);
        counts = run.counts("label");
    }
    const map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_EQ(run.counts("label"), counts);
    EXPECT_GT(counts.size(), 2U);
}

TEST_F(store_run, helpers_put_tiles_that_the_owner_packs) {
    map_run owner(layout, sample_options(map));
    run_options asked = sample_options(map);
    asked.role = run_role::helper;
    map_run helper(layout, asked);
    for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) {
        put_tile(i % 2 == 0 ? owner : helper, layout, i);
    }
    owner.rescan(owner.missing_tiles());
    EXPECT_TRUE(owner.missing_tiles().empty());
    owner.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, tiles_that_a_helper_replaces_are_packed_as_they_are_then) {
    map_layout before = layout;
    before.axes[0].values[0] += 0.125;  // its cells tell other numbers
    map_run owner(layout, sample_options(map));
    for (std::uint64_t i = 0; i < layout.n_tiles(); ++i)
        put_tile(owner, i == 0 ? before : layout, i);
    run_options asked = sample_options(map);
    asked.role = run_role::helper;
    map_run helper(layout, asked);
    put_tile(helper, layout, 0);
    owner.rescan({0});
    owner.finish(sample_summary());
    EXPECT_EQ(read_bytes(map), undisturbed());
}

TEST_F(store_run, a_finished_map_of_the_same_scene_is_complete_when_resumed) {
    test::write_sample_map(map, layout);
    const map_run run(layout, sample_options(map, if_exists::resume));
    EXPECT_TRUE(run.complete());
    EXPECT_TRUE(run.missing_tiles().empty());
    EXPECT_FALSE(std::filesystem::exists(map_run::directory_of(map)));
}

TEST_F(store_run, replacing_keeps_the_old_map_until_the_new_one_is_finished) {
    test::write_sample_map(map, layout);
    const std::vector<std::byte> before = read_bytes(map);
    run_options asked = sample_options(map, if_exists::replace);
    asked.attributes.emplace_back("comment", "second run");
    map_run run(layout, asked);
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    EXPECT_EQ(read_bytes(map), before);
    run.finish(sample_summary());
    EXPECT_EQ(map_reader(map).attribute("comment"), "second run");
}

TEST_F(store_run, one_and_three_dimensional_maps_are_stored_too) {
    for (const map_layout& each : {sample_layout({37}, {10}), sample_layout({9, 8, 7}, {4, 3, 7}),
                                   sample_layout({1, 1}, {256, 256})}) {
        test::write_sample_map(map, each);
        const map_reader reader(map);
        for (std::uint64_t i = 0; i < each.n_tiles(); ++i) {
            EXPECT_EQ(reader.tile(i).layers, sample_tile(each, i).layers);
        }
        EXPECT_TRUE(verify_file(map).empty());
    }
}

}  // namespace
}  // namespace hopscotch
