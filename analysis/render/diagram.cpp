#include "analysis/render/diagram.hpp"

#include "analysis/render/figure.hpp"
#include "analysis/render/image_data.hpp"
#include "analysis/render/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hopscotch::picture {

namespace {

constexpr double width = 1024.0;
constexpr double height = 640.0;
constexpr double dot_radius = 0.8;

/// How an orbit came to its parameter value, see host/run/orbit_diagram.hpp.
enum class origin : std::uint8_t { rising, falling, start };
constexpr std::array<std::string_view, 3> origin_names{"rising parameter", "falling parameter",
                                                       "starts of the grid"};

origin origin_of(double orbit) {
    return orbit == 0.0 ? origin::rising : orbit == 1.0 ? origin::falling : origin::start;
}

rgb colour_of(origin of) {
    return of == origin::start ? no_value : distinct_colour(of == origin::rising ? 0 : 1);
}

/// Recorded states of one orbit: [parameter][sample].
std::vector<double> states_of(const map_reader& map, const std::string& layer,
                              std::uint64_t orbit) {
    const map_layout& layout = map.layout();
    return map.read(layer, {{0, orbit, 0}, {layout.axes[0].size(), 1, layout.axes[2].size()}, {}});
}

struct dots {
    origin from;
    std::vector<double> states;
};

/// Starts first: sweeps are drawn over them.
std::vector<dots> all_dots(const map_reader& map, const std::string& layer) {
    const axis& orbits = map.layout().axes[1];
    std::vector<dots> result;
    for (std::uint64_t i = 0; i < orbits.size(); ++i) {
        result.push_back({origin_of(orbits.values[i]), states_of(map, layer, i)});
    }
    std::stable_sort(result.begin(), result.end(), [](const dots& a, const dots& b) {
        return static_cast<int>(a.from) > static_cast<int>(b.from);
    });
    return result;
}

drawn_axis state_scale(const layer& what, const std::vector<dots>& orbits) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const dots& orbit : orbits) {
        for (const double x : orbit.states) {
            if (!std::isfinite(x)) continue;
            lowest = std::min(lowest, x);
            highest = std::max(highest, x);
        }
    }
    if (!(lowest <= highest)) lowest = 0.0, highest = 1.0;
    const double margin = lowest < highest ? 0.03 * (highest - lowest) : 0.5;
    drawn_axis up;
    up.name = what.name;
    up.unit = what.unit;
    up.lowest = lowest - margin;
    up.highest = highest + margin;
    return up;
}

std::vector<legend_entry> legend_of(const std::vector<dots>& orbits) {
    std::vector<legend_entry> legend;
    for (const origin from : {origin::rising, origin::falling, origin::start}) {
        const bool is_shown = std::any_of(orbits.begin(), orbits.end(),
                                          [&](const dots& orbit) { return orbit.from == from; });
        if (!is_shown) continue;
        legend.push_back(
            {colour_of(from), std::string(origin_names[static_cast<std::size_t>(from)])});
    }
    return legend;
}

void draw_dots(framed_canvas& drawn, const dots& orbit, const drawn_axis& across,
               const drawn_axis& up) {
    const std::size_t n_samples = orbit.states.size() / across.values.size();
    for (std::size_t i = 0; i < across.values.size(); ++i) {
        const double x = drawn.data.left + across.share_of(across.values[i]) * drawn.data.width;
        for (std::size_t sample = 0; sample < n_samples; ++sample) {
            const double state = orbit.states[i * n_samples + sample];
            if (!std::isfinite(state)) continue;
            const double y = drawn.data.bottom() - up.share_of(state) * drawn.data.height;
            drawn.picture.dot({x, y}, dot_radius, colour_of(orbit.from));
        }
    }
}

}  // namespace

bool is_diagram(const map_layout& layout) {
    return layout.axes.size() == 3 && layout.axes[1].name == "orbit" &&
           layout.axes[2].name == "sample";
}

canvas draw_diagram(const map_reader& map, const std::string& layer, const std::string& title) {
    const image_data image = read_image(map, layer, 1 << 20);
    const std::vector<dots> orbits = all_dots(map, image.what.name);
    const drawn_axis up = state_scale(image.what, orbits);
    figure figure;
    figure.width = width;
    figure.height = height;
    figure.title = title;
    figure.subtitle = image.what.long_name;
    figure.across = axis_of(image.across);
    figure.up = axis_of(up);
    figure.legend_title = "orbits";
    figure.legend = legend_of(orbits);
    framed_canvas drawn = draw_frame(figure);
    for (const dots& orbit : orbits) draw_dots(drawn, orbit, image.across, up);
    draw_edges(drawn, figure);
    return std::move(drawn.picture);
}

}  // namespace hopscotch::picture
