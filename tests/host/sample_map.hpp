// Small invented maps for the tests of the store, the pictures and the Python loader.
#pragma once

#include "host/map/numbers.hpp"
#include "host/map/rows.hpp"
#include "host/store/store.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hopscotch::test {

inline axis sample_axis(const std::string& name, double lowest, double highest, std::uint64_t n) {
    axis result;
    result.name = name;
    result.unit = "m s-1";
    result.long_name = "the " + name;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
        result.values.push_back(lowest + (highest - lowest) * share);
    }
    return result;
}

inline layer sample_layer(const std::string& name, number_type type, double fill) {
    layer result;
    result.name = name;
    result.type = type;
    result.fill = fill;
    result.long_name = "the " + name;
    return result;
}

/// Axes of the given sizes; layers of every number type.
inline map_layout sample_layout(const std::vector<std::uint64_t>& sizes,
                                const std::vector<std::uint64_t>& tile) {
    const char* const names[] = {"liftoff_speed", "mass_ratio", "restitution", "damping_ratio"};
    map_layout layout;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        layout.axes.push_back(sample_axis(names[i], 0.0, 2.0 + static_cast<double>(i), sizes[i]));
    }
    layout.layers.push_back(sample_layer("label", number_type::int16, -1));
    layout.layers.push_back(sample_layer("outcome", number_type::int8, -1));
    layout.layers.back().flags = {{0, "ok"}, {1, "attracted"}, {22, "budget"}};
    layout.layers.push_back(sample_layer("returns", number_type::int32, -1.0));
    layout.layers.push_back(
        sample_layer("time", number_type::float64, std::numeric_limits<double>::quiet_NaN()));
    layout.layers.back().unit = "s";
    layout.tile = tile;
    return layout;
}

/// The number a sample map has in a cell: a function of the axes' values only, not of tiles.
inline double sample_value(std::size_t layer, const std::vector<double>& x) {
    const double y = x.size() > 1 ? x[1] : 0.5;
    const double wave = std::sin(5.0 * x[0]) * std::cos(4.0 * y) + 0.3 * x[0] * y;
    const int label = wave < -0.3 ? 0 : wave < 0.2 ? 1 : wave < 0.7 ? 2 : 3;
    switch (layer) {
        case 0:
            return label;
        case 1:
            return label == 0 ? 22 : 1;
        case 2:
            return std::floor(20.0 + 50.0 * wave * wave);
        default:
            return label == 0 ? std::numeric_limits<double>::quiet_NaN() : 3.0 + wave;
    }
}

inline tile_data sample_tile(const map_layout& layout, std::uint64_t index) {
    tile_data tile{box_of(layout, index), {}};
    for (std::size_t i = 0; i < layout.layers.size(); ++i) {
        const number_type type = layout.layers[i].type;
        std::vector<std::byte> values(tile.box.n_cells() * bytes_of(type));
        std::uint64_t at = 0;
        std::vector<double> x(layout.axes.size());
        for_each_row(tile.box.extent, [&](const std::vector<std::uint64_t>& position) {
            for (std::size_t j = 0; j < x.size(); ++j) {
                x[j] = layout.axes[j].values[tile.box.origin[j] + position[j]];
            }
            for (std::uint64_t k = 0; k < tile.box.extent.back(); ++k, ++at) {
                x.back() = layout.axes.back().values[tile.box.origin.back() + k];
                fill_numbers(type, values.data(), at, 1, sample_value(i, x));
            }
        });
        tile.layers.push_back(std::move(values));
    }
    return tile;
}

inline map_summary sample_summary() {
    attractor_row fixed_point;
    fixed_point.label = 1;
    fixed_point.name = "fixed point 1";
    fixed_point.period = 1;
    fixed_point.points = {1.25};
    fixed_point.multipliers_real = {0.5};
    fixed_point.multipliers_imaginary = {0.0};
    fixed_point.trap = "[1.25, 1.5]";
    fixed_point.share = 0.375;
    fixed_point.colour = 0x0072b2;
    attractor_row cycle = fixed_point;
    cycle.label = 2;
    cycle.name = "period 2";
    cycle.period = 2;
    cycle.points = {0.75, 1.5};
    cycle.multipliers_real = {0.25, 0.25};
    cycle.multipliers_imaginary = {0.125, -0.125};
    cycle.colour = 0xe69f00;
    cycle.share = 0.25;
    attractor_row chaos;
    chaos.label = 3;
    chaos.name = "chaotic";
    chaos.colour = 0x009e73;
    chaos.share = 0.125;
    map_summary summary;
    summary.attributes = {{"audit", "0 of 1000 cells mislabelled"}};
    summary.attractors = {fixed_point, cycle, chaos};
    summary.point_columns = {"liftoff_speed"};
    return summary;
}

inline run_options sample_options(const std::filesystem::path& map,
                                  if_exists existing = if_exists::refuse) {
    run_options options;
    options.map = map;
    options.fingerprint = "0123456789abcdef";
    options.attributes = {{"title", "Sample map"}, {"scene", "[scene]\nname = \"sample\"\n"}};
    options.existing = existing;
    return options;
}

inline void put_tile(map_run& run, const map_layout& layout, std::uint64_t index) {
    run.put(compress(layout, sample_tile(layout, index), 4, 0.25));
}

inline void write_sample_map(const std::filesystem::path& map, const map_layout& layout) {
    map_run run(layout, sample_options(map, if_exists::replace));
    for (const std::uint64_t tile : run.missing_tiles()) put_tile(run, layout, tile);
    run.finish(sample_summary());
}

/// A folder for one test, removed with everything in it.
class scratch_folder {
public:
    scratch_folder() {
        static int counter = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("hopscotch-test-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
        std::filesystem::create_directories(path_);
    }
    ~scratch_folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    scratch_folder(const scratch_folder&) = delete;
    scratch_folder& operator=(const scratch_folder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace hopscotch::test
