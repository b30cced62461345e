// The groups /attractors and /tiles of a map file.
#include "host/store/map_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hopscotch {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> counted(std::size_t n) {
    std::vector<double> values(n);
    for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<double>(i);
    return values;
}

void make_coordinate(hdf5_file& file, const std::string& group, const std::string& name,
                     hdf5_type type, const std::vector<double>& values) {
    file.write(group + "/" + name, type, {values.size()}, values);
    file.make_scale(group + "/" + name, name);
}

void make_coordinate(hdf5_file& file, const std::string& group, const std::string& name,
                     const std::vector<std::string>& texts) {
    file.write(group + "/" + name, texts);
    file.make_scale(group + "/" + name, name);
}

void attach(hdf5_file& file, const std::string& group, const std::string& name,
            const std::vector<std::string>& scales, const std::string& long_name) {
    for (unsigned i = 0; i < scales.size(); ++i) {
        file.attach_scale(group + "/" + name, group + "/" + scales[i], i);
    }
    file.set_attribute(group + "/" + name, "long_name", long_name);
}

template <class Read>
std::vector<double> column_of(const std::vector<attractor_row>& rows, Read&& read) {
    std::vector<double> values;
    for (const attractor_row& row : rows) values.push_back(static_cast<double>(read(row)));
    return values;
}

/// Rows of unequal length as a table whose rows end in NaN.
std::vector<double> padded(const std::vector<std::vector<double>>& rows, std::size_t width) {
    std::vector<double> table;
    for (const std::vector<double>& row : rows) {
        table.insert(table.end(), row.begin(), row.end());
        table.resize(table.size() + width - row.size(), nan);
    }
    return table;
}

void write_points(hdf5_file& file, const std::vector<attractor_row>& rows,
                  const std::vector<std::string>& columns) {
    std::size_t width = 0;
    std::vector<std::vector<double>> points;
    for (const attractor_row& row : rows) {
        width = std::max(width, row.points.size());
        points.push_back(row.points);
    }
    if (width == 0 || columns.empty()) return;
    const std::size_t n_points = (width + columns.size() - 1) / columns.size();
    make_coordinate(file, "/attractors", "point", hdf5_type::int32, counted(n_points));
    make_coordinate(file, "/attractors", "column", columns);
    file.write("/attractors/points", {rows.size(), n_points, columns.size()},
               std::span<const double>(padded(points, n_points * columns.size())));
    attach(file, "/attractors", "points", {"label", "point", "column"},
           "points of the orbit on the section");
}

void write_multipliers(hdf5_file& file, const std::vector<attractor_row>& rows) {
    std::size_t width = 0;
    std::vector<std::vector<double>> pairs;
    for (const attractor_row& row : rows) {
        pairs.emplace_back();
        for (std::size_t i = 0; i < row.multipliers_real.size(); ++i) {
            pairs.back().push_back(row.multipliers_real[i]);
            pairs.back().push_back(
                i < row.multipliers_imaginary.size() ? row.multipliers_imaginary[i] : 0.0);
        }
        width = std::max(width, pairs.back().size());
    }
    if (width == 0) return;
    make_coordinate(file, "/attractors", "multiplier", hdf5_type::int32, counted(width / 2));
    make_coordinate(file, "/attractors", "part", {"real", "imaginary"});
    file.write("/attractors/multipliers", {rows.size(), width / 2, 2},
               std::span<const double>(padded(pairs, width)));
    attach(file, "/attractors", "multipliers", {"label", "multiplier", "part"},
           "eigenvalues of the return map's derivative over one period");
}

/// Row i of a table with its trailing NaN cut off.
std::vector<double> row_of(const std::vector<double>& table, std::size_t n_rows, std::size_t i) {
    const std::size_t width = n_rows == 0 ? 0 : table.size() / n_rows;
    auto begin = table.begin() + static_cast<std::ptrdiff_t>(i * width);
    auto end = begin + static_cast<std::ptrdiff_t>(width);
    while (end != begin && std::isnan(*(end - 1))) --end;
    return {begin, end};
}

}  // namespace

void write_attractors(hdf5_file& file, const std::vector<attractor_row>& rows,
                      const std::vector<std::string>& point_columns) {
    const auto numbers_of = [&](const std::string& name, hdf5_type type,
                                const std::vector<double>& values, const std::string& long_name) {
        file.write("/attractors/" + name, type, {rows.size()}, values);
        attach(file, "/attractors", name, {"label"}, long_name);
    };
    const auto texts_of = [&](const std::string& name, auto read, const std::string& long_name) {
        std::vector<std::string> texts;
        for (const attractor_row& row : rows) texts.push_back(read(row));
        file.write("/attractors/" + name, texts);
        attach(file, "/attractors", name, {"label"}, long_name);
    };
    file.make_group("/attractors");
    make_coordinate(file, "/attractors", "label", hdf5_type::int32,
                    column_of(rows, [](const auto& row) { return row.label; }));
    file.set_attribute("/attractors/label", "long_name", "value in the layer label");
    texts_of(
        "name", [](const auto& row) { return row.name; }, "name of the attractor");
    numbers_of("period", hdf5_type::int32,
               column_of(rows, [](const auto& row) { return row.period; }),
               "returns per period, 0 where aperiodic");
    numbers_of("share", hdf5_type::float64,
               column_of(rows, [](const auto& row) { return row.share; }), "share of all cells");
    file.set_attribute("/attractors/share", "units", "1");
    numbers_of("colour", hdf5_type::uint32,
               column_of(rows, [](const auto& row) { return row.colour; }),
               "colour in pictures, red * 65536 + green * 256 + blue");
    texts_of(
        "trap", [](const auto& row) { return row.trap; },
        "the set whose members are proved to be attracted");
    write_points(file, rows, point_columns);
    write_multipliers(file, rows);
}

std::vector<attractor_row> read_attractors(hdf5_file& file,
                                           std::vector<std::string>& point_columns) {
    const std::string group = "/attractors/";
    const std::vector<double> labels = file.read_doubles(group + "label");
    const std::vector<std::string> names = file.read_texts(group + "name");
    const std::vector<std::string> traps = file.read_texts(group + "trap");
    const std::vector<double> periods = file.read_doubles(group + "period");
    const std::vector<double> shares = file.read_doubles(group + "share");
    const std::vector<double> colours = file.read_doubles(group + "colour");
    std::vector<double> points;
    std::vector<double> multipliers;
    if (file.has(group + "points")) {
        points = file.read_doubles(group + "points");
        point_columns = file.read_texts(group + "column");
    }
    if (file.has(group + "multipliers")) multipliers = file.read_doubles(group + "multipliers");
    std::vector<attractor_row> rows(labels.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].label = static_cast<int>(labels[i]);
        rows[i].name = names.at(i);
        rows[i].trap = traps.at(i);
        rows[i].period = static_cast<int>(periods.at(i));
        rows[i].share = shares.at(i);
        rows[i].colour = static_cast<std::uint32_t>(colours.at(i));
        rows[i].points = row_of(points, rows.size(), i);
        const std::vector<double> pairs = row_of(multipliers, rows.size(), i);
        for (std::size_t j = 0; j + 1 < pairs.size(); j += 2) {
            rows[i].multipliers_real.push_back(pairs[j]);
            rows[i].multipliers_imaginary.push_back(pairs[j + 1]);
        }
    }
    return rows;
}

void write_tile_table(hdf5_file& file, const map_description& map,
                      const std::vector<tile_row>& rows) {
    const map_layout& layout = map.layout;
    std::vector<std::string> axis_names;
    std::vector<std::string> layer_names;
    for (const axis& each : layout.axes) axis_names.push_back(each.name);
    for (const layer& each : layout.layers) layer_names.push_back(each.name);
    std::vector<std::uint64_t> origins;
    std::vector<std::uint64_t> extents;
    std::vector<std::uint64_t> sums;
    std::vector<double> seconds;
    for (const tile_row& row : rows) {
        origins.insert(origins.end(), row.box.origin.begin(), row.box.origin.end());
        extents.insert(extents.end(), row.box.extent.begin(), row.box.extent.end());
        for (const layer_sum& sum : row.sums) sums.insert(sums.end(), {sum.low, sum.high});
        seconds.push_back(row.seconds);
    }
    using words = std::span<const std::uint64_t>;
    file.make_group("/tiles");
    make_coordinate(file, "/tiles", "tile", hdf5_type::uint32, counted(rows.size()));
    make_coordinate(file, "/tiles", "axis", axis_names);
    make_coordinate(file, "/tiles", "layer", layer_names);
    make_coordinate(file, "/tiles", "word", {"low", "high"});
    file.write("/tiles/origin", {rows.size(), axis_names.size()}, words(origins));
    attach(file, "/tiles", "origin", {"tile", "axis"}, "first cell of the tile");
    file.write("/tiles/extent", {rows.size(), axis_names.size()}, words(extents));
    attach(file, "/tiles", "extent", {"tile", "axis"}, "cells of the tile");
    file.write("/tiles/checksum", {rows.size(), layer_names.size(), 2}, words(sums));
    attach(file, "/tiles", "checksum", {"tile", "layer", "word"},
           "sum over the tile's cells, 128 bits in two words");
    // Times differ from run to run: an attribute, so that all datasets of equal maps are equal.
    file.set_attribute("/tiles", "compute_seconds", typed_numbers{hdf5_type::float64, seconds});
    if (!map.tile_directory.empty()) file.set_text("/tiles", "directory", map.tile_directory);
}

std::vector<tile_row> read_tile_table(hdf5_file& file, const map_layout& layout) {
    const std::size_t n_axes = layout.axes.size();
    const std::size_t n_layers = layout.layers.size();
    const std::vector<std::uint64_t> origins = file.read_words("/tiles/origin");
    const std::vector<std::uint64_t> extents = file.read_words("/tiles/extent");
    const std::vector<std::uint64_t> sums = file.read_words("/tiles/checksum");
    const std::vector<double> seconds = file.attribute_numbers("/tiles", "compute_seconds");
    std::vector<tile_row> rows;
    for (std::uint64_t tile = 0; tile < layout.n_tiles(); ++tile) {
        tile_row row{box_of(layout, tile), {}, seconds.at(tile)};
        for (std::size_t i = 0; i < n_axes; ++i) {
            if (origins.at(tile * n_axes + i) != row.box.origin[i] ||
                extents.at(tile * n_axes + i) != row.box.extent[i]) {
                throw store_error(file.place() + ": /tiles", "the tile table does not fit the map",
                                  "");
            }
        }
        for (std::size_t i = 0; i < n_layers; ++i) {
            const std::size_t at = 2 * (tile * n_layers + i);
            row.sums.push_back({sums.at(at), sums.at(at + 1)});
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace hopscotch
