// Branch studies by name for the tests of continuation.
#pragma once

#include "analysis/continuation/find_branches.hpp"
#include "tests/analysis/map_points.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace hopscotch::testing_maps {

/// A study over a parameter, or over a column where the section has one of that name.
inline branch_study study_over(const map_point& map, std::string_view variable, double lowest,
                               double highest, const std::vector<sampled_column>& samples) {
    branch_variable over{.lowest = lowest, .highest = highest};
    for (int c = 0; c < map.n_columns(); ++c) {
        if (map.columns_of().columns[static_cast<std::size_t>(c)].name == variable) {
            over.is_column = true;
            over.index = c;
        }
    }
    if (!over.is_column) over.index = index_named(map.model->info->parameters, variable);
    branch_study study{.family = family_of(map, over, samples), .samples = samples};
    study.stations = 5;
    return study;
}

/// Special points of a kind on branches of a period, in the order of their variable.
inline std::vector<special_point> special_points(const std::vector<branch>& branches,
                                                 special_kind kind, int period) {
    std::vector<special_point> points;
    for (const branch& branch : branches) {
        for (const special_point& point : branch.special) {
            if (branch.period == period && point.kind == kind) points.push_back(point);
        }
    }
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.orbit.variable < b.orbit.variable; });
    return points;
}

}  // namespace hopscotch::testing_maps
