// Maps whose tile files stay: the map file is an index of virtual datasets, and what is missing in
// the folder of tiles is never read as data.
#include "host/store/store.hpp"
#include "tests/host/sample_map.hpp"

#include <gtest/gtest.h>

#include <fstream>

using namespace hopscotch;
using namespace hopscotch::test;

namespace {

const map_layout layout = sample_layout({20, 13}, {8, 5});

run_options joined(const std::filesystem::path& map, if_exists existing = if_exists::refuse) {
    run_options options = sample_options(map, existing);
    options.keeps_tiles = true;
    return options;
}

void write_joined_map(const std::filesystem::path& map) {
    map_run run(layout, joined(map));
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    run.finish(sample_summary());
}

std::filesystem::path tile_file(const std::filesystem::path& map, int tile) {
    return map_run::directory_of(map) / ("tile_00000000" + std::to_string(tile) + ".h5");
}

}  // namespace

TEST(virtual_map, has_the_numbers_hash_and_attractors_of_a_packed_one) {
    const scratch_folder folder;
    write_sample_map(folder / "packed.h5", layout);
    write_joined_map(folder / "joined.h5");
    const map_reader packed(folder / "packed.h5");
    const map_reader map(folder / "joined.h5");
    EXPECT_TRUE(map.is_finished_map());
    EXPECT_EQ(map.layout().tile, layout.tile);
    EXPECT_EQ(map.attribute("hash"), packed.attribute("hash"));
    EXPECT_EQ(map.attractors().size(), 3u);
    for (const layer& each : layout.layers) {
        const std::vector<double> values = map.read_all(each.name);
        const std::vector<double> expected = packed.read_all(each.name);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const bool both_nan = std::isnan(values[i]) && std::isnan(expected[i]);
            EXPECT_TRUE(both_nan || values[i] == expected[i]) << each.name << " " << i;
        }
    }
    EXPECT_TRUE(map.problems().empty());
    EXPECT_TRUE(verify_file(folder / "joined.h5").empty());
}

TEST(virtual_map, can_be_moved_with_its_tiles) {
    const scratch_folder folder;
    write_joined_map(folder / "map.h5");
    std::filesystem::create_directories(folder / "elsewhere");
    std::filesystem::rename(folder / "map.h5", folder / "elsewhere/renamed.h5");
    std::filesystem::rename(folder / "map.h5.tiles", folder / "elsewhere/map.h5.tiles");
    EXPECT_TRUE(verify_file(folder / "elsewhere/renamed.h5").empty());
}

TEST(virtual_map, a_missing_tile_reads_as_not_computed) {
    const scratch_folder folder;
    write_joined_map(folder / "map.h5");
    std::filesystem::remove(tile_file(folder / "map.h5", 0));
    const map_reader map(folder / "map.h5");
    EXPECT_EQ(map.missing_tiles(), std::vector<std::uint64_t>{0});
    EXPECT_EQ(map.read("label", {{0, 0}, {1, 1}})[0], -1.0);
    EXPECT_EQ(map.problems().size(), 1u);
    const std::vector<map_problem> problems = verify_file(folder / "map.h5");
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].what, map_problem::kind::missing_tile);
}

TEST(virtual_map, a_tile_of_the_same_scene_with_other_numbers_is_found) {
    const scratch_folder folder;
    write_joined_map(folder / "map.h5");
    map_layout other = layout;
    other.axes[0].values[3] += 0.25;  // its cells tell other values
    {
        map_run run(other, joined(folder / "other.h5"));
        put_tile(run, other, 0);
        std::filesystem::copy_file(tile_file(folder / "other.h5", 0),
                                   tile_file(folder / "map.h5", 0),
                                   std::filesystem::copy_options::overwrite_existing);
    }
    const std::vector<map_problem> problems = verify_file(folder / "map.h5");
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].what, map_problem::kind::damaged_tile);
}

TEST(virtual_map, resumes_where_tiles_were_lost_and_is_complete_where_none_was) {
    const scratch_folder folder;
    write_joined_map(folder / "map.h5");
    EXPECT_TRUE(map_run(layout, joined(folder / "map.h5", if_exists::resume)).complete());
    const std::string hash = map_reader(folder / "map.h5").attribute("hash");
    std::filesystem::remove(tile_file(folder / "map.h5", 2));
    std::filesystem::resize_file(tile_file(folder / "map.h5", 5), 100);
    {
        map_run run(layout, joined(folder / "map.h5", if_exists::resume));
        EXPECT_FALSE(run.complete());
        EXPECT_EQ(run.missing_tiles(), (std::vector<std::uint64_t>{2, 5}));
        for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
        run.finish(sample_summary());
    }
    EXPECT_EQ(map_reader(folder / "map.h5").attribute("hash"), hash);
    EXPECT_TRUE(verify_file(folder / "map.h5").empty());
}

TEST(virtual_map, is_gone_as_soon_as_another_run_replaces_its_tiles) {
    const scratch_folder folder;
    write_joined_map(folder / "map.h5");
    const map_run run(layout, joined(folder / "map.h5", if_exists::replace));
    EXPECT_FALSE(std::filesystem::exists(folder / "map.h5"));
}
