#include "analysis/render/canvas.hpp"

#include "analysis/render/glyphs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace hopscotch::picture {

namespace {

double distance_to(const point& p, const point& a, const point& b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double length = dx * dx + dy * dy;
    const double t =
        length > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Reads a glyph's path; see glyphs.hpp.
class path_reader {
public:
    explicit path_reader(std::string_view path) : rest_(path) {}

    std::vector<polyline> lines() {
        while (!rest_.empty()) {
            const char command = rest_.front();
            rest_.remove_prefix(1);
            switch (command) {
                case 'M':
                    move();
                    break;
                case 'L':
                    append({number(), number()});
                    break;
                case 'Q':
                    curve();
                    break;
                default:
                    arc();
                    break;
            }
        }
        return lines_;
    }

private:
    double number() {
        while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
        std::size_t used = 0;
        const double value = std::stod(std::string(rest_.substr(0, 12)), &used);
        rest_.remove_prefix(used);
        return value;
    }
    void move() {
        const double x = number();
        const double y = number();
        lines_.push_back({{x, y}});
    }
    void append(point next) {
        if (lines_.empty()) lines_.emplace_back();
        lines_.back().push_back(next);
    }
    void curve() {
        const point from = lines_.back().back();
        const point control{number(), number()};
        const point to{number(), number()};
        for (int i = 1; i <= 12; ++i) {
            const double t = i / 12.0;
            const double s = 1.0 - t;
            append({s * s * from.x + 2 * s * t * control.x + t * t * to.x,
                    s * s * from.y + 2 * s * t * control.y + t * t * to.y});
        }
    }
    void arc() {
        const point centre{number(), number()};
        const point radius{number(), number()};
        const double from = number();
        const double to = number();
        const int steps = std::max(4, static_cast<int>(std::abs(to - from) / 10.0));
        if (lines_.empty() || is_full_turn(from, to)) lines_.emplace_back();
        for (int i = 0; i <= steps; ++i) {
            const double angle = (from + (to - from) * i / steps) * std::numbers::pi / 180.0;
            append({centre.x + radius.x * std::cos(angle), centre.y + radius.y * std::sin(angle)});
        }
    }
    static bool is_full_turn(double from, double to) { return std::abs(to - from) >= 360.0; }

    std::string_view rest_;
    std::vector<polyline> lines_;
};

struct placed_character {
    char32_t character;
    bool is_exponent;
};

char32_t next_character(std::string_view& text) {
    const auto byte = static_cast<unsigned char>(text.front());
    const std::size_t length = byte < 0x80 ? 1 : byte < 0xe0 ? 2 : byte < 0xf0 ? 3 : 4;
    char32_t character = length == 1 ? byte : byte & (0x7fU >> length);
    for (std::size_t i = 1; i < length && i < text.size(); ++i) {
        character = (character << 6) | (static_cast<unsigned char>(text[i]) & 0x3fU);
    }
    text.remove_prefix(std::min(length, text.size()));
    return character;
}

std::vector<placed_character> characters_of(std::string_view text) {
    std::vector<placed_character> characters;
    bool is_exponent = false;
    while (!text.empty()) {
        if (!is_exponent && text.starts_with("^{")) {
            is_exponent = true;
            text.remove_prefix(2);
        } else if (is_exponent && text.front() == '}') {
            is_exponent = false;
            text.remove_prefix(1);
        } else {
            characters.push_back({next_character(text), is_exponent});
        }
    }
    return characters;
}

constexpr double exponent_size = 0.72;
constexpr double exponent_lift = 5.6;

double advance_of(const placed_character& each) {
    const double width =
        each.character == U' ' ? space_width : glyph_of(each.character).width + letter_gap;
    return each.is_exponent ? exponent_size * width : width;
}

double width_in_units(const std::vector<placed_character>& characters) {
    double width = characters.empty() ? 0.0 : -letter_gap;
    for (const placed_character& each : characters) width += advance_of(each);
    return width;
}

}  // namespace

canvas::canvas(int width, int height, rgb background)
    : width_(width),
      height_(height),
      pixels_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    fill({0, 0, static_cast<double>(width), static_cast<double>(height)}, background);
}

std::span<const std::uint8_t> canvas::row(int y) const {
    const std::size_t bytes = 3 * static_cast<std::size_t>(width_);
    return {pixels_.data() + static_cast<std::size_t>(y) * bytes, bytes};
}

void canvas::set(int x, int y, rgb colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    std::uint8_t* pixel =
        &pixels_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x))];
    pixel[0] = colour.red;
    pixel[1] = colour.green;
    pixel[2] = colour.blue;
}

void canvas::blend(int x, int y, rgb colour, double cover) {
    if (cover <= 0.0 || x < 0 || y < 0 || x >= width_ || y >= height_) return;
    const std::uint8_t* old =
        &pixels_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x))];
    const auto mix = [cover](std::uint8_t below, std::uint8_t above) {
        return static_cast<std::uint8_t>(std::lround(below + cover * (above - below)));
    };
    set(x, y, {mix(old[0], colour.red), mix(old[1], colour.green), mix(old[2], colour.blue)});
}

void canvas::fill(const box& area, rgb colour) {
    const int right = static_cast<int>(std::lround(area.right()));
    const int bottom = static_cast<int>(std::lround(area.bottom()));
    for (int y = static_cast<int>(std::lround(area.top)); y < bottom; ++y) {
        for (int x = static_cast<int>(std::lround(area.left)); x < right; ++x) set(x, y, colour);
    }
}

void canvas::frame(const box& area, double width, rgb colour) {
    fill({area.left - width, area.top - width, area.width + 2 * width, width}, colour);
    fill({area.left - width, area.bottom(), area.width + 2 * width, width}, colour);
    fill({area.left - width, area.top, width, area.height}, colour);
    fill({area.right(), area.top, width, area.height}, colour);
}

void canvas::line(point from, point to, double width, rgb colour) {
    const polyline single{from, to};
    stroke({&single, 1}, width, colour);
}

void canvas::dot(point centre, double radius, rgb colour) {
    line(centre, centre, 2.0 * radius, colour);
}

void canvas::stroke(std::span<const polyline> lines, double width, rgb colour) {
    const double reach = 0.5 * width + 0.5;
    double left = width_;
    double right = 0.0;
    double top = height_;
    double bottom = 0.0;
    for (const polyline& each : lines) {
        for (const point& p : each) {
            left = std::min(left, p.x - reach);
            right = std::max(right, p.x + reach);
            top = std::min(top, p.y - reach);
            bottom = std::max(bottom, p.y + reach);
        }
    }
    for (int y = std::max(0, static_cast<int>(top)); y <= std::min(height_ - 1.0, bottom); ++y) {
        for (int x = std::max(0, static_cast<int>(left)); x <= std::min(width_ - 1.0, right); ++x) {
            double nearest = reach;
            for (const polyline& each : lines) {
                for (std::size_t i = 0; i + 1 < each.size(); ++i) {
                    nearest =
                        std::min(nearest, distance_to({x + 0.5, y + 0.5}, each[i], each[i + 1]));
                }
            }
            blend(x, y, colour, std::clamp(reach - nearest, 0.0, 1.0) * std::min(width, 1.0));
        }
    }
}

void canvas::text(point at, std::string_view characters, const text_style& style) {
    const std::vector<placed_character> placed = characters_of(characters);
    const double unit = style.size / line_units;
    double x = 0.0;
    if (style.across == align::middle) x = -0.5 * width_in_units(placed);
    if (style.across == align::end) x = -width_in_units(placed);
    for (const placed_character& each : placed) {
        if (each.character != U' ') {
            const double scale = each.is_exponent ? exponent_size : 1.0;
            const double lift = each.is_exponent ? exponent_lift : 0.0;
            std::vector<polyline> lines = path_reader(glyph_of(each.character).path).lines();
            for (polyline& line : lines) {
                for (point& p : line) {
                    const double along = unit * (x + scale * p.x);
                    const double above = unit * (lift + scale * p.y);
                    p = style.is_upward ? point{at.x - above, at.y - along}
                                        : point{at.x + along, at.y - above};
                }
            }
            stroke(lines, stroke_units * unit * style.weight * (each.is_exponent ? 0.9 : 1.0),
                   style.colour);
        }
        x += advance_of(each);
    }
}

double width_of(std::string_view characters, const text_style& style) {
    return width_in_units(characters_of(characters)) * style.size / line_units;
}

}  // namespace hopscotch::picture
