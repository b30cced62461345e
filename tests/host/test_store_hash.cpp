// The map's hash: what it must not depend on, and what it must notice.
#include "tests/host/sample_map.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace hopscotch {
namespace {

using test::sample_layout;
using test::sample_tile;

std::vector<layer_sum> sums_of(const map_layout& layout, bool is_backwards = false) {
    std::vector<layer_sum> sums(layout.layers.size());
    for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) {
        const std::uint64_t index = is_backwards ? layout.n_tiles() - 1 - i : i;
        const tile_data tile = sample_tile(layout, index);
        for (std::size_t k = 0; k < sums.size(); ++k) {
            sums[k] += sum_of(layout, tile.box, k, tile.layers[k]);
        }
    }
    return sums;
}

std::string hash_of(const map_layout& layout) { return map_hash(layout, sums_of(layout)); }

TEST(map_hash, does_not_depend_on_tile_size) {
    const std::string whole = hash_of(sample_layout({70, 50}, {70, 50}));
    EXPECT_EQ(whole.size(), 32U);
    for (const std::vector<std::uint64_t>& tile :
         {std::vector<std::uint64_t>{16, 16}, {7, 13}, {70, 1}, {1, 50}, {1000, 9}}) {
        EXPECT_EQ(hash_of(sample_layout({70, 50}, tile)), whole) << tile[0] << " x " << tile[1];
    }
}

TEST(map_hash, does_not_depend_on_tile_order) {
    const map_layout layout = sample_layout({70, 50}, {16, 16});
    EXPECT_EQ(map_hash(layout, sums_of(layout, true)), hash_of(layout));
}

TEST(map_hash, does_not_depend_on_tile_size_in_one_and_three_dimensions) {
    EXPECT_EQ(hash_of(sample_layout({101}, {101})), hash_of(sample_layout({101}, {8})));
    EXPECT_EQ(hash_of(sample_layout({9, 8, 7}, {9, 8, 7})),
              hash_of(sample_layout({9, 8, 7}, {4, 3, 2})));
}

TEST(map_hash, notices_every_single_changed_bit_of_a_tile) {
    const map_layout layout = sample_layout({6, 5}, {6, 5});
    tile_data tile = sample_tile(layout, 0);
    for (std::size_t k = 0; k < layout.layers.size(); ++k) {
        for (std::byte& each : tile.layers[k]) each = std::byte{0};
        const layer_sum before = sum_of(layout, tile.box, k, tile.layers[k]);
        for (std::size_t bit = 0; bit < 8 * tile.layers[k].size(); ++bit) {
            tile.layers[k][bit / 8] ^= std::byte{1} << (bit % 8);
            EXPECT_NE(sum_of(layout, tile.box, k, tile.layers[k]), before) << k << " " << bit;
            tile.layers[k][bit / 8] ^= std::byte{1} << (bit % 8);
        }
    }
}

TEST(map_hash, notices_two_swapped_cells) {
    const map_layout layout = sample_layout({40, 30}, {40, 30});
    tile_data tile = sample_tile(layout, 0);
    const layer_sum before = sum_of(layout, tile.box, 2, tile.layers[2]);
    double first = number_at(number_type::int32, tile.layers[2].data(), 3);
    double second = number_at(number_type::int32, tile.layers[2].data(), 777);
    ASSERT_NE(first, second);
    fill_numbers(number_type::int32, tile.layers[2].data(), 3, 1, second);
    fill_numbers(number_type::int32, tile.layers[2].data(), 777, 1, first);
    EXPECT_NE(sum_of(layout, tile.box, 2, tile.layers[2]), before);
}

TEST(map_hash, tells_layers_of_equal_numbers_apart) {
    map_layout layout = sample_layout({20, 20}, {20, 20});
    layout.layers.push_back(layout.layers[2]);
    layout.layers.back().name = "events";
    tile_data tile = sample_tile(sample_layout({20, 20}, {20, 20}), 0);
    tile.layers.push_back(tile.layers[2]);
    EXPECT_NE(sum_of(layout, tile.box, 2, tile.layers[2]),
              sum_of(layout, tile.box, 4, tile.layers[4]));
}

TEST(map_hash, tells_axes_of_different_values_apart) {
    map_layout layout = sample_layout({20, 20}, {20, 20});
    const std::vector<layer_sum> sums = sums_of(layout);
    const std::string before = map_hash(layout, sums);
    layout.axes[1].values[7] = std::nextafter(layout.axes[1].values[7], 0.0);
    EXPECT_NE(map_hash(layout, sums), before);
}

TEST(map_hash, takes_every_nan_for_the_same_and_the_two_zeros_for_different) {
    const map_layout layout = sample_layout({4}, {4});
    const tile_box box = box_of(layout, 0);
    const auto sum_with = [&](std::uint64_t bits) {
        std::vector<std::byte> values(4 * sizeof(double));
        std::memcpy(values.data() + 8, &bits, sizeof bits);
        return sum_of(layout, box, 3, values);
    };
    EXPECT_EQ(sum_with(0x7ff8000000000000), sum_with(0xfff8000000000123));
    EXPECT_EQ(sum_with(0x7ff8000000000000), sum_with(0x7fffffffffffffff));
    EXPECT_NE(sum_with(0x7ff8000000000000), sum_with(0x7ff0000000000000));
    EXPECT_NE(sum_with(0), sum_with(std::bit_cast<std::uint64_t>(-0.0)));
}

TEST(map_hash, refuses_a_buffer_that_does_not_fit_the_tile) {
    const map_layout layout = sample_layout({4, 4}, {4, 4});
    EXPECT_THROW(sum_of(layout, box_of(layout, 0), 0, std::vector<std::byte>(31)),
                 std::invalid_argument);
}

TEST(map_layout, tiles_cover_every_cell_once) {
    const map_layout layout = sample_layout({10, 7, 5}, {4, 7, 2});
    EXPECT_EQ(layout.tiles_along(), (std::vector<std::uint64_t>{3, 1, 3}));
    std::uint64_t cells = 0;
    for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) cells += box_of(layout, i).n_cells();
    EXPECT_EQ(cells, layout.n_cells());
    EXPECT_EQ(box_of(layout, 8).origin, (std::vector<std::uint64_t>{8, 0, 4}));
    EXPECT_EQ(box_of(layout, 8).extent, (std::vector<std::uint64_t>{2, 7, 1}));
    EXPECT_THROW(box_of(layout, 9), std::out_of_range);
}

TEST(compressed_tile, gives_back_every_bit_whatever_the_level) {
    const map_layout layout = sample_layout({10, 7}, {4, 5});
    for (std::uint64_t i = 0; i < layout.n_tiles(); ++i) {
        const tile_data tile = sample_tile(layout, i);
        for (const int level : {0, 1, 9}) {
            const compressed_tile packed = compress(layout, tile, level, 1.5);
            EXPECT_EQ(decompress(layout, packed).layers, tile.layers);
            EXPECT_EQ(packed.summary.seconds, 1.5);
        }
    }
}

TEST(compressed_tile, counts_the_values_of_integer_layers) {
    const map_layout layout = sample_layout({2, 2}, {2, 2});
    tile_data tile = sample_tile(layout, 0);
    fill_numbers(number_type::int16, tile.layers[0].data(), 0, 4, -1);
    fill_numbers(number_type::int16, tile.layers[0].data(), 1, 2, 7);
    const tile_summary summary = summarise(layout, tile);
    EXPECT_EQ(summary.counts[0], (value_counts{{-1, 2}, {7, 2}}));
    EXPECT_TRUE(summary.counts[3].empty());
}

}  // namespace
}  // namespace hopscotch
