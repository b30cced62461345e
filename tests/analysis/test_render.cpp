// Pictures of maps: the right colour in the right place, bounded size, words that can be read.
#include "analysis/render/palette.hpp"
#include "analysis/render/render.hpp"
#include "analysis/render/ticks.hpp"
#include "tests/host/sample_map.hpp"

#include <gtest/gtest.h>

#include <png.h>

namespace hopscotch {
namespace {

using picture::rgb;
using test::sample_layout;
using test::scratch_folder;

struct decoded_png {
    unsigned width = 0;
    unsigned height = 0;
    std::vector<std::uint8_t> pixels;

    rgb at(unsigned x, unsigned y) const {
        const std::uint8_t* pixel = &pixels[3 * (std::size_t{y} * width + x)];
        return {pixel[0], pixel[1], pixel[2]};
    }
    std::size_t count(rgb colour) const {
        std::size_t n = 0;
        for (unsigned y = 0; y < height; ++y) {
            for (unsigned x = 0; x < width; ++x) n += at(x, y) == colour ? 1 : 0;
        }
        return n;
    }
};

decoded_png decode(const std::filesystem::path& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    decoded_png result;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return result;
    image.format = PNG_FORMAT_RGB;
    result.width = image.width;
    result.height = image.height;
    result.pixels.resize(PNG_IMAGE_SIZE(image));
    png_image_finish_read(&image, nullptr, result.pixels.data(), 0, nullptr);
    return result;
}

class render : public testing::Test {
protected:
    decoded_png drawn(const std::string& layer = {}) const {
        render_map(map, png, layer);
        return decode(png);
    }

    scratch_folder folder;
    std::filesystem::path map = folder / "map.h5";
    std::filesystem::path png = folder / "map.png";
};

/// Writes a map whose labels a function gives.
template <class Label>
void write_labels(const std::filesystem::path& map, const map_layout& layout, Label&& label_of) {
    map_run run(layout, test::sample_options(map, if_exists::replace));
    for (const std::uint64_t index : run.missing_tiles()) {
        tile_data tile = test::sample_tile(layout, index);
        for (std::uint64_t i = 0; i < tile.box.n_cells(); ++i) {
            const std::uint64_t row = i / tile.box.extent[1] + tile.box.origin[0];
            const std::uint64_t column = i % tile.box.extent[1] + tile.box.origin[1];
            fill_numbers(number_type::int16, tile.layers[0].data(), i, 1, label_of(row, column));
        }
        run.put(compress(layout, tile, 4));
    }
    run.finish(test::sample_summary());
}

TEST_F(render, the_first_axis_runs_to_the_right_and_the_second_one_upward) {
    write_labels(map, sample_layout({64, 64}, {32, 32}), [](std::uint64_t i, std::uint64_t j) {
        return i < 32 ? 1 : j < 32 ? 2 : 3;  // left half; lower right; upper right
    });
    const decoded_png picture = drawn();
    const rgb left = rgb::of(0x0072b2);
    const rgb lower_right = rgb::of(0xe69f00);
    const rgb upper_right = rgb::of(0x009e73);
    EXPECT_EQ(picture.at(300, 600), left);
    EXPECT_EQ(picture.at(900, 300), upper_right);
    EXPECT_EQ(picture.at(900, 900), lower_right);
    EXPECT_GE(picture.count(left), 512U * 1024U);
    EXPECT_LT(picture.count(left), 513U * 1024U) << "the data area and a legend's swatch";
}

TEST_F(render, cells_without_a_label_are_dark_and_cells_not_computed_light) {
    const map_layout layout = sample_layout({64, 64}, {32, 32});
    map_run run(layout, test::sample_options(map));
    test::put_tile(run, layout, 0);
    const decoded_png unfinished = drawn();
    EXPECT_GE(unfinished.count(picture::not_computed), 3U * 512U * 512U);
    write_labels(folder / "other.h5", layout, [](auto, auto) { return 0; });
    render_map(folder / "other.h5", png);
    EXPECT_GE(decode(png).count(picture::undecided), 1024U * 1024U);
}

TEST_F(render, a_large_map_becomes_a_picture_of_bounded_size) {
    test::write_sample_map(map, sample_layout({2200, 1100}, {512, 512}));
    const decoded_png picture = drawn();
    EXPECT_GT(picture.width, 1000U);
    EXPECT_LT(picture.width, 1700U);
    EXPECT_LT(picture.height, 1400U);
}

TEST_F(render, every_layer_of_maps_with_one_to_four_axes_can_be_drawn) {
    for (const std::vector<std::uint64_t>& sizes :
         {std::vector<std::uint64_t>{300}, {1}, {1, 1}, {40, 30}, {9, 8, 7}, {5, 4, 3, 2}}) {
        const map_layout layout = sample_layout(sizes, sizes);
        test::write_sample_map(map, layout);
        for (const layer& each : layout.layers) {
            const decoded_png picture = drawn(each.name);
            EXPECT_GT(picture.width, 500U) << each.name << " with " << sizes.size() << " axes";
            EXPECT_GT(picture.count(picture::ink), 500U);
        }
    }
}

TEST_F(render, the_same_map_gives_the_same_picture) {
    test::write_sample_map(map, sample_layout({64, 64}, {32, 32}));
    const decoded_png first = drawn();
    test::write_sample_map(map, sample_layout({64, 64}, {16, 64}));
    EXPECT_EQ(drawn().pixels, first.pixels);
}

TEST_F(render, an_unknown_layer_is_refused_with_the_layers_there_are) {
    test::write_sample_map(map, sample_layout({8, 8}, {8, 8}));
    try {
        drawn("outcomes");
        FAIL();
    } catch (const store_error& error) {
        EXPECT_STREQ(error.what(),
                     "layer outcomes (the map has none of that name); one of label, "
                     "outcome, returns, time?");
    }
    EXPECT_FALSE(std::filesystem::exists(png));
}

TEST_F(render, a_picture_that_cannot_be_written_is_a_store_error) {
    test::write_sample_map(map, sample_layout({8, 8}, {8, 8}));
    EXPECT_THROW(render_map(map, folder / "nowhere" / "map.png"), store_error);
    EXPECT_THROW(render_map(folder / "nothing.h5", png), store_error);
}

std::string labels_of(const std::vector<picture::tick>& ticks) {
    std::string text;
    for (const picture::tick& each : ticks) {
        if (!each.label.empty()) text += (text.empty() ? "" : " ") + each.label;
    }
    return text;
}

TEST(ticks, stand_at_round_numbers) {
    EXPECT_EQ(labels_of(picture::linear_ticks(0.0, 15.0, 7)), "0 2.5 5.0 7.5 10.0 12.5 15.0");
    EXPECT_EQ(labels_of(picture::linear_ticks(-0.31, 0.29, 6)),
              "\u22120.3 \u22120.2 \u22120.1 0 0.1 0.2");
    EXPECT_EQ(labels_of(picture::linear_ticks(2e5, 6e5, 4)),
              "2\u00d710^{5} 3\u00d710^{5} 4\u00d710^{5} 5\u00d710^{5} 6\u00d710^{5}");
    EXPECT_EQ(labels_of(picture::linear_ticks(0.0, 2.5e-5, 5)),
              "0 5\u00d710^{\u22126} 10^{\u22125} 1.5\u00d710^{\u22125} 2\u00d710^{\u22125} "
              "2.5\u00d710^{\u22125}");
    EXPECT_EQ(labels_of(picture::linear_ticks(3.0, 3.0, 5)), "3");
}

TEST(ticks, of_a_logarithmic_axis_stand_at_powers_of_ten) {
    EXPECT_EQ(labels_of(picture::log_ticks(1e-3, 10.0, 7)), "0.001 0.01 0.1 1 10");
    EXPECT_EQ(labels_of(picture::log_ticks(1.0, 50.0, 7)), "1 2 5 10 20 50");
    EXPECT_EQ(labels_of(picture::log_ticks(1e-9, 1e3, 4)),
              "10^{\u22129} 10^{\u22126} 10^{\u22123} 10^{0} 10^{3}");
}

TEST(ticks, axis_titles_set_units_with_exponents) {
    EXPECT_EQ(picture::axis_title("liftoff_speed", "m s-1"), "liftoff speed (m s^{\u22121})");
    EXPECT_EQ(picture::axis_title("stiffness", "N/m^2"), "stiffness (N/m^{2})");
    EXPECT_EQ(picture::axis_title("mass_ratio", "1"), "mass ratio");
}

}  // namespace
}  // namespace hopscotch
