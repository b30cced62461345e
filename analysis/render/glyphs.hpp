// The font of all pictures: letters as strokes, drawn by this project, so that pictures need no
// font file. Units: baseline 0, small letters 9 high, capitals and digits 13, descent -4.
#pragma once

#include <string_view>

namespace hopscotch::picture {

/// Strokes in a small path language: `M x y` move, `L x y` line, `Q cx cy x y` quadratic curve,
/// `O cx cy rx ry from to` arc of an ellipse in degrees, joined to the point before unless after
/// `M`.
struct glyph {
    double width;  // of its ink; letters stand `letter_gap` apart
    std::string_view path;
};

inline constexpr double letter_gap = 3.1;
inline constexpr double space_width = 5.0;
inline constexpr double line_units = 22.0;    // a line of text, in glyph units
inline constexpr double stroke_units = 1.55;  // regular stroke width

/// The glyph of a Unicode character; a small box where the font has none.
const glyph& glyph_of(char32_t character);

}  // namespace hopscotch::picture
