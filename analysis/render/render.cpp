#include "analysis/render/render.hpp"

#include "analysis/render/colouring.hpp"
#include "analysis/render/diagram.hpp"
#include "analysis/render/figure.hpp"
#include "analysis/render/image_data.hpp"
#include "analysis/render/palette.hpp"
#include "analysis/render/png_file.hpp"
#include "host/store/map_reader.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {

namespace {

using namespace picture;

constexpr std::uint64_t most_pixels = 1024;  // along each side of the data area

std::string title_of(const map_reader& map, const std::filesystem::path& file) {
    for (const char* name : {"title", "name"}) {
        const std::string text = map.attribute(name);
        if (!text.empty()) return text;
    }
    return file.stem().string();
}

std::string subtitle_of(const image_data& data, const colouring& colours) {
    std::string text =
        data.what.long_name.empty() ? axis_title(data.what.name, "") : data.what.long_name;
    for (const std::string& remark : data.remarks) text += ", " + remark;
    const bool is_picture = data.has_second_axis && !colours.is_categorical();
    if (is_picture && colours.has_empty_cells()) text += " (grey: no value)";
    return text;
}

/// Pixels of `cells` cells, each a whole number of pixels wide: as many as fit, but not much more
/// than the other side has.
double pixels_for(std::uint64_t cells, std::uint64_t other) {
    const auto largest = [](std::uint64_t n, double room) {
        const auto n_cells = static_cast<double>(n);
        return n_cells * std::max(1.0, std::floor(room / n_cells));
    };
    const double other_side = largest(other, most_pixels);
    return largest(cells, std::min<double>(most_pixels, 1.25 * other_side));
}

/// Every cell as a rectangle of whole pixels, the second axis upward.
void draw_cells(framed_canvas& drawn, const image_data& data, const colouring& colours) {
    const double width = drawn.data.width / static_cast<double>(data.across.values.size());
    const double height = drawn.data.height / static_cast<double>(data.up.values.size());
    for (std::size_t i = 0; i < data.across.values.size(); ++i) {
        for (std::size_t j = 0; j < data.up.values.size(); ++j) {
            drawn.picture.fill(
                {drawn.data.left + static_cast<double>(i) * width,
                 drawn.data.bottom() - static_cast<double>(j + 1) * height, width, height},
                colours.of(data.at(i, j)));
        }
    }
}

/// A dot per cell: a curve would join what a jump separates.
void draw_dots(framed_canvas& drawn, const image_data& data, const drawn_axis& up) {
    const double radius = data.values.size() > 300 ? 1.6 : 3.0;
    for (std::size_t i = 0; i < data.values.size(); ++i) {
        if (data.is_fill(data.values[i]) || !std::isfinite(data.values[i])) continue;
        const double x = data.across.share_of(data.across.values[i]);
        const double y = up.share_of(data.values[i]);
        if (y < 0.0 || y > 1.0) continue;
        drawn.picture.dot(
            {drawn.data.left + x * drawn.data.width, drawn.data.bottom() - y * drawn.data.height},
            radius, distinct_colour(0));
    }
}

void explain(figure& figure, const image_data& data, const colouring& colours) {
    figure.legend_title = axis_title(data.what.name, data.what.unit);
    if (colours.is_categorical()) {
        figure.legend = colours.legend();
    } else {
        figure.bar = &colours;
    }
}

/// The vertical scale of a curve: its range and a little more.
drawn_axis scale_of(const image_data& data, const colouring& colours) {
    drawn_axis up;
    up.name = data.what.name;
    up.unit = data.what.unit;
    up.is_log = colours.is_log();
    const double margin = 0.04 * (colours.highest() - colours.lowest());
    const double factor = std::pow(colours.highest() / colours.lowest(), 0.04);
    up.lowest = up.is_log ? colours.lowest() / factor : colours.lowest() - margin;
    up.highest = up.is_log ? colours.highest() * factor : colours.highest() + margin;
    return up;
}

canvas draw(const image_data& data, figure figure, const colouring& colours) {
    const std::uint64_t n_across = data.across.values.size();
    const std::uint64_t n_up = data.up.values.size();
    figure.across = axis_of(data.across);
    figure.width = pixels_for(n_across, data.has_second_axis ? n_up : 1);
    const bool is_curve = !data.has_second_axis && !colours.is_categorical();
    drawn_axis up = data.up;
    if (is_curve) {
        up = scale_of(data, colours);
        figure.up = axis_of(up);
        figure.height = std::round(0.62 * figure.width);
    } else {
        explain(figure, data, colours);
        if (data.has_second_axis) figure.up = axis_of(data.up);
        figure.height =
            data.has_second_axis ? pixels_for(n_up, n_across) : std::round(0.16 * figure.width);
    }
    framed_canvas drawn = draw_frame(figure);
    if (is_curve) {
        draw_dots(drawn, data, up);
    } else {
        draw_cells(drawn, data, colours);
    }
    draw_edges(drawn, figure);
    return std::move(drawn.picture);
}

}  // namespace

void render_map(const std::filesystem::path& map, const std::filesystem::path& png,
                const std::string& layer) {
    const map_reader reader(map);
    if (is_diagram(reader.layout())) {
        write_png(png, draw_diagram(reader, layer, title_of(reader, map)));
        return;
    }
    const image_data data = read_image(reader, layer, most_pixels);
    const colouring colours(data, reader.attractors());
    figure figure;
    figure.title = title_of(reader, map);
    figure.subtitle = subtitle_of(data, colours);
    write_png(png, draw(data, std::move(figure), colours));
}

}  // namespace hopscotch
