#include "analysis/render/image_data.hpp"

#include "analysis/render/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch::picture {

namespace {

std::uint64_t stride_for(std::uint64_t cells, std::uint64_t most) {
    return (cells + most - 1) / most;
}

/// Ends of the scale: half a (drawn) cell beyond the first and last sample.
void set_ends(drawn_axis& drawn) {
    const auto scaled = [&](double x) { return drawn.is_log ? std::log(x) : x; };
    const std::size_t n = drawn.values.size();
    double first = scaled(drawn.values.front());
    double last = scaled(drawn.values.back());
    const double half = n > 1 ? 0.5 * (last - first) / static_cast<double>(n - 1) : 0.5;
    first -= half;
    last += half;
    drawn.lowest = drawn.is_log ? std::exp(first) : first;
    drawn.highest = drawn.is_log ? std::exp(last) : last;
}

drawn_axis drawn(const axis& from, std::uint64_t stride) {
    drawn_axis result;
    result.name = from.name;
    result.unit = from.unit;
    result.is_log = from.scale == "log" && from.values.front() > 0.0;
    for (std::uint64_t i = 0; i < from.size(); i += stride) result.values.push_back(from.values[i]);
    set_ends(result);
    return result;
}

std::size_t chosen_layer(const map_reader& map, const std::string& name) {
    const std::vector<layer>& layers = map.layout().layers;
    const std::size_t wanted = layer_index(map.layout(), name.empty() ? "label" : name);
    if (wanted < layers.size()) return wanted;
    if (name.empty()) return 0;
    std::string known;
    for (const layer& each : layers) known += (known.empty() ? "" : ", ") + each.name;
    throw store_error("layer " + name, "the map has none of that name", "one of " + known);
}

std::string sentence_about(const std::vector<std::string>& problems) {
    const std::string n = std::to_string(problems.size());
    return n + (problems.size() == 1 ? " tile" : " tiles") + " missing or damaged";
}

}  // namespace

double drawn_axis::share_of(double value) const {
    if (is_log) return std::log(value / lowest) / std::log(highest / lowest);
    return (value - lowest) / (highest - lowest);
}

bool image_data::is_fill(double value) const { return std::isnan(value) || value == what.fill; }

image_data read_image(const map_reader& map, const std::string& layer, std::uint64_t most_cells) {
    const map_layout& layout = map.layout();
    image_data data;
    data.what = layout.layers[chosen_layer(map, layer)];
    cell_range range;
    for (std::size_t i = 0; i < layout.axes.size(); ++i) {
        const axis& along = layout.axes[i];
        range.origin.push_back(0);
        range.extent.push_back(i < 2 ? along.size() : 1);
        range.stride.push_back(i < 2 ? stride_for(along.size(), most_cells) : 1);
        if (i < 2 && range.stride.back() > 1) data.is_every_cell = false;
        if (i >= 2) {
            data.remarks.push_back(axis_title(along.name, "") + " = " +
                                   short_number(along.values.front()));
        }
    }
    data.across = drawn(layout.axes[0], range.stride[0]);
    data.has_second_axis = layout.axes.size() > 1;
    if (data.has_second_axis) data.up = drawn(layout.axes[1], range.stride[1]);
    if (!data.has_second_axis) data.up.values = {0.0};
    data.values = map.read(data.what.name, range);
    if (!map.problems().empty()) data.remarks.push_back(sentence_about(map.problems()));
    return data;
}

}  // namespace hopscotch::picture
