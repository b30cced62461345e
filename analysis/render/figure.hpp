// The frame around the data: axes with ticks and names, title, legend, colour bar. Knows pixels and
// words, not maps.
#pragma once

#include "analysis/render/canvas.hpp"
#include "analysis/render/colouring.hpp"
#include "analysis/render/ticks.hpp"

#include <string>
#include <vector>

namespace hopscotch::picture {

/// One axis as words and positions.
struct figure_axis {
    std::string title;
    std::vector<tick> ticks;
    std::vector<double> shares;  // position of every tick, 0 to 1 along the axis
};

figure_axis axis_of(const drawn_axis& axis);

struct figure {
    double width = 0.0;  // of the data area, in pixels
    double height = 0.0;
    std::string title;
    std::string subtitle;
    figure_axis across;
    figure_axis up;  // no ticks: none is drawn
    std::string legend_title;
    std::vector<legend_entry> legend;
    const colouring* bar = nullptr;  // a colour bar is drawn for it
};

/// An empty picture of the right size, and where the data go.
struct framed_canvas {
    canvas picture;
    box data;
};

/// Draws everything but the data.
framed_canvas draw_frame(const figure& figure);

/// Ticks and frame once more over the data, whose edge cells may have covered them.
void draw_edges(framed_canvas& drawn, const figure& figure);

}  // namespace hopscotch::picture
