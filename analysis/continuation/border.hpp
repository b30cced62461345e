// What lies behind the point where a branch cannot be followed further: another order of events, on
// which it goes on, or its end.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/corrector.hpp"

#include <optional>
#include <string>

namespace hopscotch {

struct wall_crossing {
    std::optional<curve_point> beyond;  // the first orbit on the other side, tangent onward
    double length = 0.0;                // distance of it from the wall
    curve_point wall;                   // the orbit at the wall, from the more regular side
    std::string detail;                 // events and largest multiplier on both sides
    end_of_branch end;                  // where there is no other side
};

/// \param last  the last orbit before the wall, closer to it than the least step
/// \param word  its events
wall_crossing cross_wall(const branch_equation& equation, const curve_point& last,
                         const std::string& word);

}  // namespace hopscotch
