// A picture in memory: rectangles, anti-aliased strokes and text. Knows nothing of maps.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hopscotch::picture {

struct rgb {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;

    static constexpr rgb of(std::uint32_t hex) {
        return {static_cast<std::uint8_t>(hex >> 16), static_cast<std::uint8_t>(hex >> 8),
                static_cast<std::uint8_t>(hex)};
    }
    friend constexpr bool operator==(rgb, rgb) = default;
};

inline constexpr rgb white = rgb::of(0xffffff);
inline constexpr rgb ink = rgb::of(0x222222);

/// Pixels; x to the right, y downward, the centre of the first pixel at (0.5, 0.5).
struct point {
    double x = 0.0;
    double y = 0.0;
};

struct box {
    double left = 0.0;
    double top = 0.0;
    double width = 0.0;
    double height = 0.0;

    double right() const { return left + width; }
    double bottom() const { return top + height; }
};

using polyline = std::vector<point>;

enum class align : std::uint8_t { start, middle, end };

struct text_style {
    double size = 20.0;   // height of a line in pixels; capitals are 0.58 of it
    double weight = 1.0;  // stroke width relative to the regular one
    rgb colour = ink;
    align across = align::start;
    bool is_upward = false;  // rotated by 90 degrees to read from bottom to top
};

class canvas {
public:
    canvas(int width, int height, rgb background = white);

    int width() const { return width_; }
    int height() const { return height_; }
    std::span<const std::uint8_t> row(int y) const;  // red, green, blue of every pixel

    void set(int x, int y, rgb colour);
    void fill(const box& area, rgb colour);  // edges rounded to whole pixels
    void frame(const box& area, double width, rgb colour);
    void line(point from, point to, double width, rgb colour);
    void dot(point centre, double radius, rgb colour);

    /// Strokes with round ends; where they overlap the colour is laid on once.
    void stroke(std::span<const polyline> lines, double width, rgb colour);

    /// One line of text; `at` is on its baseline. `^{...}` is set as an exponent.
    void text(point at, std::string_view characters, const text_style& style);

private:
    void blend(int x, int y, rgb colour, double cover);

    int width_;
    int height_;
    std::vector<std::uint8_t> pixels_;
};

double width_of(std::string_view characters, const text_style& style);

}  // namespace hopscotch::picture
