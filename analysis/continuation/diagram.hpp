// What pictures of branches and of curves share: axes of variables, colours of special points.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/render/figure.hpp"

#include <map>
#include <string>

namespace hopscotch {

/// A variable over its range.
picture::drawn_axis drawn_axis_of(const branch_family& family, const branch_variable& variable);

/// A figure of the size of diagrams, without legend.
picture::figure empty_diagram(const std::string& title, const picture::drawn_axis& across,
                              const picture::drawn_axis& up);

picture::point place_in(const picture::box& data, const picture::drawn_axis& across,
                        const picture::drawn_axis& up, double x, double y);

std::map<special_kind, picture::rgb> colours_of_kinds();

}  // namespace hopscotch
