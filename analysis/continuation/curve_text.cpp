// Writes and draws curves.
#include "analysis/continuation/curve_text.hpp"

#include "analysis/continuation/diagram.hpp"
#include "analysis/render/figure.hpp"
#include "analysis/render/png_file.hpp"
#include "host/run/json.hpp"

#include <fmt/format.h>

namespace hopscotch {

std::string csv_of(const branch_family& family, const branch_variable& second,
                   const std::vector<bifurcation_curve>& curves) {
    const auto columns = family.map.columns_of().columns;
    std::string text = fmt::format("curve,kind,period,{},{}", family.variable.name(family.map),
                                   second.name(family.map));
    for (const int column : family.columns)
        text += fmt::format(",{}", columns[static_cast<std::size_t>(column)].name);
    text += "\n";
    for (std::size_t c = 0; c < curves.size(); ++c) {
        const bifurcation_curve& curve = curves[c];
        for (std::size_t i = 0; i < curve.variable.size(); ++i) {
            text += fmt::format("{},{},{},{:.17g},{:.17g}", c, name_of(curve.kind), curve.period,
                                curve.variable[i], curve.second[i]);
            for (const int column : family.columns)
                text += fmt::format(",{:.17g}", curve.state[i][static_cast<std::size_t>(column)]);
            text += "\n";
        }
    }
    return text;
}

std::string json_of(const branch_family& family, const branch_variable& second,
                    const std::vector<bifurcation_curve>& curves) {
    std::string text = "[";
    for (std::size_t c = 0; c < curves.size(); ++c) {
        const bifurcation_curve& curve = curves[c];
        text += fmt::format(
            "{}\n  {{\"kind\": {}, \"period\": {}, \"first\": {}, \"last\": {},\n   {}: {},\n   "
            "{}: {}}}",
            c == 0 ? "" : ",", json_text(name_of(curve.kind)), curve.period,
            json_text(text_of(curve.first)), json_text(text_of(curve.last)),
            json_text(family.variable.name(family.map)), json_numbers(curve.variable),
            json_text(second.name(family.map)), json_numbers(curve.second));
    }
    return text + "]";
}

std::vector<std::vector<std::string>> rows_of(const branch_family& family,
                                              const branch_variable& second,
                                              const std::vector<bifurcation_curve>& curves) {
    const std::string_view across = family.variable.name(family.map);
    const std::string_view up = second.name(family.map);
    std::vector<std::vector<std::string>> rows{{"curve", "period", "what", "points",
                                                fmt::format("from ({}, {})", across, up),
                                                fmt::format("to ({}, {})", across, up)}};
    for (std::size_t c = 0; c < curves.size(); ++c) {
        const bifurcation_curve& curve = curves[c];
        const auto end = [&](double x, double y, const end_of_branch& why) {
            return fmt::format("({:.9g}, {:.9g}) {}", x, y, text_of(why));
        };
        rows.push_back({fmt::format("{}", c), fmt::format("{}", curve.period),
                        std::string(name_of(curve.kind)), fmt::format("{}", curve.variable.size()),
                        end(curve.variable.front(), curve.second.front(), curve.first),
                        end(curve.variable.back(), curve.second.back(), curve.last)});
    }
    return rows;
}

void draw_curves(const branch_family& family, const branch_variable& second,
                 const std::vector<bifurcation_curve>& curves, const std::string& title,
                 const std::filesystem::path& png) {
    using namespace picture;
    const drawn_axis across = drawn_axis_of(family, family.variable);
    const drawn_axis up = drawn_axis_of(family, second);
    figure figure = empty_diagram(title, across, up);
    figure.legend_title = "curves";
    for (const auto& [kind, colour] : colours_of_kinds()) {
        for (const bifurcation_curve& curve : curves) {
            if (curve.kind != kind) continue;
            figure.legend.push_back({colour, std::string(name_of(kind))});
            break;
        }
    }
    framed_canvas drawn = draw_frame(figure);
    for (const bifurcation_curve& curve : curves) {
        polyline line;
        for (std::size_t i = 0; i < curve.variable.size(); ++i) {
            line.push_back(place_in(drawn.data, across, up, curve.variable[i], curve.second[i]));
        }
        drawn.picture.stroke(std::span(&line, 1), 2.6, colours_of_kinds().at(curve.kind));
    }
    draw_edges(drawn, figure);
    write_png(png, drawn.picture);
}

}  // namespace hopscotch
