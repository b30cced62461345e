// Reading maps: strides, unfinished and damaged maps. What is missing is said, never read as data.
#include "tests/host/sample_map.hpp"

#include "host/store/atomic_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace hopscotch {
namespace {

using test::put_tile;
using test::sample_layout;
using test::sample_options;
using test::scratch_folder;

class store_reader : public testing::Test {
protected:
    /// Overwrites the first occurrence of some bytes in the map file.
    void replace(const std::vector<std::byte>& what, const std::vector<std::byte>& with) const {
        std::vector<std::byte> bytes = read_bytes(map);
        const auto found = std::search(bytes.begin(), bytes.end(), what.begin(), what.end());
        ASSERT_NE(found, bytes.end());
        std::copy(with.begin(), with.end(), found);
        write_atomically(map, bytes);
    }

    std::vector<std::byte> chunk_of(std::uint64_t tile, std::size_t layer) const {
        return compress(layout, test::sample_tile(layout, tile), 4).chunks[layer];
    }

    scratch_folder folder;
    std::filesystem::path map = folder / "map.h5";
    map_layout layout = sample_layout({70, 50}, {32, 16});
};

TEST_F(store_reader, a_strided_range_holds_the_cells_asked_for) {
    test::write_sample_map(map, layout);
    const map_reader reader(map);
    const cell_range range{{3, 5}, {61, 40}, {7, 3}};
    const std::vector<double> values = reader.read("returns", range);
    ASSERT_EQ(range.shape(), (std::vector<std::uint64_t>{9, 14}));
    ASSERT_EQ(values.size(), 9U * 14U);
    for (std::uint64_t i = 0; i < 9; ++i) {
        for (std::uint64_t j = 0; j < 14; ++j) {
            const std::vector<double> x{layout.axes[0].values[3 + 7 * i],
                                        layout.axes[1].values[5 + 3 * j]};
            EXPECT_EQ(values[i * 14 + j], test::sample_value(2, x)) << i << " " << j;
        }
    }
    EXPECT_TRUE(reader.problems().empty());
}

TEST_F(store_reader, a_range_outside_the_map_or_an_unknown_layer_is_refused) {
    test::write_sample_map(map, layout);
    const map_reader reader(map);
    EXPECT_THROW(reader.read("label", {{0, 0}, {71, 1}, {}}), store_error);
    EXPECT_THROW(reader.read("label", {{0, 0}, {1, 1}, {0, 1}}), store_error);
    EXPECT_THROW(reader.read("colour", {{0, 0}, {1, 1}, {}}), store_error);
}

TEST_F(store_reader, missing_tiles_of_an_unfinished_run_read_as_not_computed) {
    map_run run(layout, sample_options(map));
    put_tile(run, layout, 0);
    const map_reader reader(map);  // the map's name leads to its run directory
    EXPECT_FALSE(reader.is_finished_map());
    EXPECT_EQ(reader.missing_tiles().size(), layout.n_tiles() - 1);
    const std::vector<double> labels = reader.read_all("label");
    EXPECT_GE(labels[0], 0.0);
    EXPECT_EQ(labels.back(), -1.0);
    EXPECT_EQ(reader.problems().size(), layout.n_tiles() - 1);
    EXPECT_THROW(reader.tile(5), store_error);
    EXPECT_EQ(verify_file(map).size(), layout.n_tiles() - 1);
}

TEST_F(store_reader, a_flipped_byte_of_a_chunk_is_found_and_its_tile_not_read) {
    test::write_sample_map(map, layout);
    const std::vector<std::byte> chunk = chunk_of(4, 3);
    std::vector<std::byte> damaged = chunk;
    damaged[chunk.size() / 2] ^= std::byte{0x10};
    replace(chunk, damaged);
    const std::vector<map_problem> problems = verify_file(map);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].what, map_problem::kind::damaged_tile);
    EXPECT_EQ(problems[0].tile, 4U);
    const map_reader reader(map);
    const std::vector<double> values = reader.read_all("time");
    const std::vector<std::uint64_t> origin = box_of(layout, 4).origin;
    EXPECT_TRUE(std::isnan(values[origin[0] * 50 + origin[1]]));
    ASSERT_EQ(reader.problems().size(), 1U);
    EXPECT_NE(reader.problems()[0].find("tile 4 (damaged: layer time"), std::string::npos);
}

TEST_F(store_reader, a_chunk_that_decodes_to_other_numbers_is_found) {
    layout = sample_layout({64, 32}, {32, 32});
    test::write_sample_map(map, layout);
    tile_data tile = test::sample_tile(layout, 0);
    std::fill(tile.layers[1].begin(), tile.layers[1].end(), std::byte{1});  // decodes perfectly
    const std::vector<std::byte> right = chunk_of(0, 1);
    std::vector<std::byte> wrong = compress(layout, tile, 4).chunks[1];
    ASSERT_LE(wrong.size(), right.size());
    wrong.resize(right.size());
    replace(right, wrong);
    ASSERT_EQ(verify_file(map).size(), 1U);
}

TEST_F(store_reader, a_hash_that_is_not_the_maps_is_found) {
    test::write_sample_map(map, layout);
    const std::string hash = map_reader(map).attribute("hash");
    std::vector<std::byte> right(hash.size());
    std::memcpy(right.data(), hash.data(), hash.size());
    std::vector<std::byte> wrong = right;
    std::rotate(wrong.begin(), wrong.begin() + 5, wrong.end());
    replace(right, wrong);
    const std::vector<map_problem> problems = verify_file(map);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].what, map_problem::kind::wrong_hash);
}

TEST_F(store_reader, a_truncated_map_and_a_text_file_are_unreadable_not_empty) {
    test::write_sample_map(map, layout);
    std::filesystem::resize_file(map, std::filesystem::file_size(map) / 2);
    std::ofstream(folder / "text.h5") << "no map";
    for (const std::filesystem::path& path : {map, folder / "text.h5", folder / "nothing.h5"}) {
        const std::vector<map_problem> problems = verify_file(path);
        ASSERT_EQ(problems.size(), 1U) << path;
        EXPECT_EQ(problems[0].what, map_problem::kind::unreadable_file) << path;
        EXPECT_NE(problems[0].text.find(path.string()), std::string::npos) << problems[0].text;
    }
}

}  // namespace
}  // namespace hopscotch
