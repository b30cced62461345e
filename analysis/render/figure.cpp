#include "analysis/render/figure.hpp"

#include "analysis/render/palette.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch::picture {

namespace {

constexpr rgb soft_ink = rgb::of(0x666666);
constexpr std::size_t most_entries = 24;

/// All distances of a picture, as multiples of its text size.
struct metrics {
    explicit metrics(const figure& figure)
        : text(std::clamp(0.024 * std::max(figure.width, figure.height), 17.0, 26.0)) {}

    double text;
    double line() const { return std::max(1.0, std::round(0.07 * text)); }
    double tick() const { return 0.35 * text; }
    double gap() const { return 0.45 * text; }
    double margin() const { return 0.9 * text; }

    text_style style(double size, align across, rgb colour = ink) const {
        text_style result;
        result.size = size * text;
        result.across = across;
        result.colour = colour;
        return result;
    }
    text_style labels(align across) const { return style(1.0, across); }
    text_style heading() const {
        text_style result = style(1.3, align::start);
        result.weight = 1.25;
        return result;
    }
};

double widest(const std::vector<tick>& ticks, const text_style& style) {
    double width = 0.0;
    for (const tick& each : ticks) width = std::max(width, width_of(each.label, style));
    return width;
}

std::string percent(double share) {
    char text[32];
    const double value = 100.0 * share;
    std::snprintf(text, sizeof text, value >= 0.095 || value == 0.0 ? "%.1f %%" : "%.2f %%", value);
    if (value > 0.0 && value < 0.005) return "< 0.01 %";
    return text;
}

/// The legend's entries that are drawn; the smallest of very many are summed up.
std::vector<legend_entry> shown_entries(const figure& figure) {
    std::vector<legend_entry> entries = figure.legend;
    if (entries.size() <= most_entries) return entries;
    legend_entry rest{white, std::to_string(entries.size() - most_entries + 1) + " more", 0.0};
    for (std::size_t i = most_entries - 1; i < entries.size(); ++i) rest.share += entries[i].share;
    entries.resize(most_entries - 1);
    entries.push_back(rest);
    return entries;
}

std::vector<tick> bar_ticks(const colouring& bar) {
    return bar.is_log() ? log_ticks(bar.lowest(), bar.highest(), 6)
                        : linear_ticks(bar.lowest(), bar.highest(), 6);
}

struct legend_widths {
    double names = 0.0;
    double shares = 0.0;
};

legend_widths widths_of(const std::vector<legend_entry>& entries, const metrics& m) {
    legend_widths widths;
    for (const legend_entry& each : entries) {
        widths.names = std::max(widths.names, width_of(each.name, m.labels(align::start)));
        if (each.share >= 0.0) {
            widths.shares =
                std::max(widths.shares, width_of(percent(each.share), m.labels(align::start)));
        }
    }
    return widths;
}

double right_margin(const figure& figure, const metrics& m) {
    if (figure.bar != nullptr) {
        return 1.3 * m.text + 1.2 * m.text + m.tick() + m.gap() +
               widest(bar_ticks(*figure.bar), m.labels(align::start)) + 1.9 * m.text + m.margin();
    }
    if (figure.legend.empty()) return 1.6 * m.margin();
    const legend_widths widths = widths_of(shown_entries(figure), m);
    const double entries = 1.5 * m.text + widths.names + m.text + widths.shares;
    return 1.3 * m.text + std::max(entries, width_of(figure.legend_title, m.labels(align::start))) +
           m.margin();
}

double left_margin(const figure& figure, const metrics& m) {
    if (figure.up.ticks.empty()) return 1.6 * m.margin();
    return m.margin() + 1.5 * m.text + widest(figure.up.ticks, m.labels(align::end)) + m.gap() +
           m.tick();
}

/// The largest style, at most the given one, in which the text fits.
text_style fitting(text_style style, const std::string& text, double width) {
    const double needed = width_of(text, style);
    if (needed > width) style.size *= width / needed;
    return style;
}

void draw_titles(canvas& picture, const figure& figure, const box& data, const metrics& m) {
    const double room = picture.width() - data.left - m.margin();
    const double lift = figure.subtitle.empty() ? 0.75 : 1.95;
    picture.text({data.left, data.top - lift * m.text}, figure.title,
                 fitting(m.heading(), figure.title, room));
    picture.text({data.left, data.top - 0.7 * m.text}, figure.subtitle,
                 fitting(m.style(0.95, align::start, soft_ink), figure.subtitle, room));
}

void draw_across(canvas& picture, const figure_axis& axis, const box& data, const metrics& m) {
    double last_right = -1e9;
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const double x = data.left + axis.shares[i] * data.width;
        const double half = 0.5 * width_of(axis.ticks[i].label, m.labels(align::middle));
        if (axis.ticks[i].label.empty() || x - half < last_right + m.gap()) continue;
        picture.text({x, data.bottom() + m.tick() + 0.95 * m.text}, axis.ticks[i].label,
                     m.labels(align::middle));
        last_right = x + half;
    }
    picture.text({data.left + 0.5 * data.width, data.bottom() + m.tick() + 2.5 * m.text},
                 axis.title, m.style(1.1, align::middle));
}

void draw_up(canvas& picture, const figure_axis& axis, const box& data, const metrics& m) {
    if (axis.ticks.empty()) return;
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const double y = data.bottom() - axis.shares[i] * data.height;
        picture.text({data.left - m.tick() - m.gap(), y + 0.29 * m.text}, axis.ticks[i].label,
                     m.labels(align::end));
    }
    text_style style = m.style(1.1, align::middle);
    style.is_upward = true;
    picture.text({m.margin() + 0.7 * m.text, data.top + 0.5 * data.height}, axis.title, style);
}

void draw_legend(canvas& picture, const figure& figure, const box& data, const metrics& m) {
    if (figure.legend.empty()) return;
    const std::vector<legend_entry> entries = shown_entries(figure);
    const legend_widths widths = widths_of(entries, m);
    const double left = data.right() + 1.3 * m.text;
    const double names = left + 1.5 * m.text;
    const double shares = names + widths.names + m.text + widths.shares;
    double y = data.top + 0.8 * m.text;
    text_style title = m.labels(align::start);
    title.weight = 1.25;
    picture.text({left, y}, figure.legend_title, title);
    for (const legend_entry& each : entries) {
        y += 1.55 * m.text;
        const box swatch{left, y - 0.74 * m.text, 0.9 * m.text, 0.9 * m.text};
        picture.fill(swatch, each.colour);
        picture.text({names, y}, each.name, m.labels(align::start));
        if (each.share < 0.0) continue;
        picture.text({shares, y}, percent(each.share), m.style(1.0, align::end, soft_ink));
    }
}

/// A pointed end: cells lie beyond the scale.
void draw_arrow(canvas& picture, const box& bar, bool is_up, rgb colour) {
    const double height = 0.6 * bar.width;
    for (int i = 0; i < static_cast<int>(height); ++i) {
        const double half = 0.5 * bar.width * (1.0 - (i + 0.5) / height);
        const double y = is_up ? bar.top - 1.0 - i : bar.bottom() + i;
        picture.fill({bar.left + 0.5 * bar.width - half, y, 2.0 * half, 1.0}, colour);
    }
}

void draw_bar(canvas& picture, const figure& figure, const box& data, const metrics& m) {
    if (figure.bar == nullptr) return;
    const colouring& bar = *figure.bar;
    const double arrow = 0.8 * m.text;
    const double top = bar.has_cells_above() ? arrow : 0.0;
    const double bottom = bar.has_cells_below() ? arrow : 0.0;
    const box area{std::round(data.right() + 1.3 * m.text), data.top + top,
                   std::round(1.2 * m.text), data.height - top - bottom};
    const auto value_at = [&](double share) {
        return bar.is_log() ? bar.lowest() * std::pow(bar.highest() / bar.lowest(), share)
                            : bar.lowest() + share * (bar.highest() - bar.lowest());
    };
    for (double y = 0.0; y < area.height; y += 1.0) {
        const double share = 1.0 - (y + 0.5) / area.height;
        picture.fill({area.left, area.top + y, area.width, 1.0}, bar.of(value_at(share)));
    }
    if (top > 0.0) draw_arrow(picture, area, true, bar.of(bar.highest()));
    if (bottom > 0.0) draw_arrow(picture, area, false, bar.of(bar.lowest()));
    if (top + bottom == 0.0) picture.frame(area, m.line(), ink);
    for (const tick& each : bar_ticks(bar)) {
        const double share =
            bar.is_log()
                ? std::log(each.value / bar.lowest()) / std::log(bar.highest() / bar.lowest())
                : (each.value - bar.lowest()) / (bar.highest() - bar.lowest());
        const double y = std::round(area.bottom() - share * area.height);
        const double length = (each.label.empty() ? 0.5 : 1.0) * m.tick();
        picture.fill({area.right(), y - 0.5 * m.line(), length, m.line()}, ink);
        picture.text({area.right() + m.tick() + m.gap(), y + 0.29 * m.text}, each.label,
                     m.labels(align::start));
    }
    text_style style = m.style(1.1, align::middle);
    style.is_upward = true;
    picture.text({picture.width() - m.margin(), data.top + 0.5 * data.height}, figure.legend_title,
                 style);
}

}  // namespace

figure_axis axis_of(const drawn_axis& axis) {
    figure_axis result;
    result.title = axis_title(axis.name, axis.unit);
    result.ticks = axis.is_log ? log_ticks(axis.lowest, axis.highest, 7)
                               : linear_ticks(axis.lowest, axis.highest, 7);
    for (const tick& each : result.ticks) result.shares.push_back(axis.share_of(each.value));
    return result;
}

framed_canvas draw_frame(const figure& figure) {
    const metrics m(figure);
    const double top = m.margin() + (figure.subtitle.empty() ? 1.7 : 2.9) * m.text;
    const double bottom = m.tick() + 2.7 * m.text + m.margin();
    const double legend_height =
        static_cast<double>(std::min(figure.legend.size(), most_entries) + 1) * 1.55 * m.text;
    const box data{std::round(left_margin(figure, m)), std::round(top), figure.width,
                   figure.height};
    const double height = std::max(data.bottom() + bottom, data.top + legend_height + m.margin());
    canvas picture(static_cast<int>(data.right() + right_margin(figure, m)),
                   static_cast<int>(height));
    draw_titles(picture, figure, data, m);
    draw_across(picture, figure.across, data, m);
    draw_up(picture, figure.up, data, m);
    draw_legend(picture, figure, data, m);
    draw_bar(picture, figure, data, m);
    return {std::move(picture), data};
}

void draw_edges(framed_canvas& drawn, const figure& figure) {
    const metrics m(figure);
    const box& data = drawn.data;
    drawn.picture.frame(data, m.line(), ink);
    for (std::size_t i = 0; i < figure.across.ticks.size(); ++i) {
        const double x = std::round(data.left + figure.across.shares[i] * data.width);
        const double length = (figure.across.ticks[i].label.empty() ? 0.5 : 1.0) * m.tick();
        drawn.picture.fill({x - std::floor(0.5 * m.line()), data.bottom(), m.line(), length}, ink);
    }
    for (std::size_t i = 0; i < figure.up.ticks.size(); ++i) {
        const double y = std::round(data.bottom() - figure.up.shares[i] * data.height);
        const double length = (figure.up.ticks[i].label.empty() ? 0.5 : 1.0) * m.tick();
        drawn.picture.fill({data.left - length, y - std::floor(0.5 * m.line()), length, m.line()},
                           ink);
    }
}

}  // namespace hopscotch::picture
