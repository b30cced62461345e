// Lines, dashes and dots of a bifurcation diagram.
#include "analysis/continuation/branch_picture.hpp"

#include "analysis/continuation/describe.hpp"
#include "analysis/continuation/diagram.hpp"
#include "analysis/render/figure.hpp"
#include "analysis/render/palette.hpp"
#include "analysis/render/png_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hopscotch {
namespace {

using namespace picture;

constexpr rgb unstable = rgb::of(0x8a8a8a);

/// One point of an orbit over the variable.
struct spot {
    double across;
    double up;
    bool is_stable;
};

struct curve {
    int period;
    std::vector<spot> spots;
};

/// One curve for every point of every branch's orbits.
std::vector<curve> curves_of(const branch_family& family, const std::vector<branch>& branches,
                             int column) {
    std::vector<curve> curves;
    for (const branch& branch : branches) {
        std::vector<curve> phases(static_cast<std::size_t>(branch.period),
                                  curve{branch.period, {}});
        for (const orbit_on_branch& orbit : branch.orbits) {
            const auto points = points_of(family, branch.period, orbit);
            for (std::size_t i = 0; i < points.size(); ++i) {
                phases[i].spots.push_back({orbit.variable,
                                           points[i][static_cast<std::size_t>(column)],
                                           orbit.is_stable()});
            }
        }
        curves.insert(curves.end(), phases.begin(), phases.end());
    }
    return curves;
}

drawn_axis up_of(const branch_family& family, const std::vector<curve>& curves, int column) {
    double lowest = 1e300;
    double highest = -1e300;
    for (const curve& each : curves) {
        for (const spot& spot : each.spots) {
            lowest = std::min(lowest, spot.up);
            highest = std::max(highest, spot.up);
        }
    }
    if (!(lowest < highest)) {
        lowest -= 0.5;
        highest = lowest + 1.0;
    }
    const double margin = 0.05 * (highest - lowest);
    const column_info& what = family.map.columns_of().columns[static_cast<std::size_t>(column)];
    drawn_axis axis;
    axis.name = what.name;
    axis.unit = what.unit;
    axis.lowest = lowest - margin;
    axis.highest = highest + margin;
    return axis;
}

/// A line's dashes; `along` carries the pattern from one piece to the next.
void add_dashes(std::vector<polyline>& dashes, point from, point to, double& along) {
    constexpr double on = 8.0;
    constexpr double period = 13.0;
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const auto at = [&](double s) {
        return point{from.x + (to.x - from.x) * s / length, from.y + (to.y - from.y) * s / length};
    };
    for (double s = 0.0; s < length;) {
        const double phase = std::fmod(along, period);
        const double next = std::min(length, s + (phase < on ? on : period) - phase + 1e-9);
        if (phase < on) dashes.push_back({at(s), at(next)});
        along += next - s;
        s = next;
    }
}

class diagram {
public:
    diagram(canvas& picture, const box& data, const drawn_axis& across, const drawn_axis& up)
        : picture_(&picture), data_(data), across_(&across), up_(&up) {}

    point place_of(double across, double up) const {
        return place_in(data_, *across_, *up_, across, up);
    }

    void draw(const curve& curve, rgb colour) const {
        constexpr double jump = 0.5;  // of the picture's height: a phase that wraps
        std::vector<polyline> solid;
        std::vector<polyline> dashes;
        double along = 0.0;
        for (std::size_t i = 1; i < curve.spots.size(); ++i) {
            const spot& a = curve.spots[i - 1];
            const spot& b = curve.spots[i];
            const point from = place_of(a.across, a.up);
            const point to = place_of(b.across, b.up);
            if (std::abs(to.y - from.y) > jump * data_.height) continue;
            if (a.is_stable && b.is_stable)
                solid.push_back({from, to});
            else
                add_dashes(dashes, from, to, along);
        }
        picture_->stroke(dashes, 1.6, unstable);
        picture_->stroke(solid, 3.2, colour);
    }

    void mark(double across, double up, rgb colour) const {
        const point place = place_of(across, up);
        picture_->dot(place, 7.0, white);
        picture_->dot(place, 5.5, colour);
    }

private:
    canvas* picture_;
    box data_;
    const drawn_axis* across_;
    const drawn_axis* up_;
};

std::map<int, rgb> colours_of_periods(const std::vector<branch>& branches) {
    constexpr rgb colours[] = {rgb::of(0x0072b2), rgb::of(0x7f5fa8), rgb::of(0x8c6d3f),
                               rgb::of(0x56b4e9), rgb::of(0x66a61e), rgb::of(0xcc79a7)};
    std::map<int, rgb> result;
    for (const branch& branch : branches) result[branch.period];
    std::size_t i = 0;
    for (auto& [period, colour] : result) colour = colours[i++ % std::size(colours)];
    return result;
}

std::vector<legend_entry> legend_of(const std::vector<branch>& branches) {
    std::vector<legend_entry> legend;
    for (const auto& [period, colour] : colours_of_periods(branches))
        legend.push_back({colour, "period " + std::to_string(period)});
    legend.push_back({unstable, "unstable"});
    for (const auto& [kind, colour] : colours_of_kinds()) {
        const bool is_met = std::any_of(branches.begin(), branches.end(), [&](const branch& each) {
            return std::any_of(each.special.begin(), each.special.end(),
                               [&](const special_point& point) { return point.kind == kind; });
        });
        if (is_met) legend.push_back({colour, std::string(name_of(kind))});
    }
    return legend;
}

}  // namespace

void draw_branches(const branch_family& family, const std::vector<branch>& branches, int column,
                   const std::string& title, const std::filesystem::path& png) {
    const std::vector<curve> curves = curves_of(family, branches, column);
    const drawn_axis across = drawn_axis_of(family, family.variable);
    const drawn_axis up = up_of(family, curves, column);
    figure figure = empty_diagram(title, across, up);
    figure.legend_title = "periodic orbits";
    figure.legend = legend_of(branches);
    framed_canvas drawn = draw_frame(figure);
    const diagram diagram(drawn.picture, drawn.data, across, up);
    const auto colours = colours_of_periods(branches);
    for (const curve& each : curves) diagram.draw(each, colours.at(each.period));
    const auto kinds = colours_of_kinds();
    for (const branch& branch : branches) {
        for (const special_point& special : branch.special) {
            for (const auto& point : points_of(family, branch.period, special.orbit)) {
                diagram.mark(special.orbit.variable, point[static_cast<std::size_t>(column)],
                             kinds.at(special.kind));
            }
        }
    }
    draw_edges(drawn, figure);
    write_png(png, drawn.picture);
}

}  // namespace hopscotch
