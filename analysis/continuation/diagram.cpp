// Axes and colours of diagrams.
#include "analysis/continuation/diagram.hpp"

namespace hopscotch {

using namespace picture;

drawn_axis drawn_axis_of(const branch_family& family, const branch_variable& variable) {
    const auto i = static_cast<std::size_t>(variable.index);
    drawn_axis axis;
    axis.name = variable.name(family.map);
    axis.unit = variable.is_column ? family.map.columns_of().columns[i].unit
                                   : family.map.model->info->parameters[i].unit;
    axis.lowest = variable.lowest;
    axis.highest = variable.highest;
    return axis;
}

figure empty_diagram(const std::string& title, const drawn_axis& across, const drawn_axis& up) {
    figure figure;
    figure.width = 1000.0;
    figure.height = 680.0;
    figure.title = title;
    figure.across = axis_of(across);
    figure.up = axis_of(up);
    return figure;
}

point place_in(const box& data, const drawn_axis& across, const drawn_axis& up, double x,
               double y) {
    return {data.left + across.share_of(x) * data.width,
            data.bottom() - up.share_of(y) * data.height};
}

std::map<special_kind, rgb> colours_of_kinds() {
    return {{special_kind::fold, rgb::of(0xd55e00)},
            {special_kind::flip, rgb::of(0x009e73)},
            {special_kind::neimark_sacker, rgb::of(0xcc79a7)},
            {special_kind::branch_point, rgb::of(0x000000)},
            {special_kind::border, rgb::of(0xe69f00)},
            {special_kind::birth, rgb::of(0x56b4e9)}};
}

}  // namespace hopscotch
