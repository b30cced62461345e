// A branch of periodic orbits as it was followed: orbits in order, and the points where its
// stability, its event sequence or the branch itself changes.
#pragma once

#include "analysis/continuation/singular_end.hpp"

#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace hopscotch {

enum class special_kind {
    fold,            // multiplier +1, the branch turns round
    flip,            // multiplier -1, an orbit of twice the period is born
    neimark_sacker,  // a complex pair crosses the unit circle
    branch_point,    // multiplier +1, another branch crosses
    border,          // the order of events changes; the branch goes on, usually with a kink
    birth            // the orbit shrinks to one of half its period
};

std::string_view name_of(special_kind kind);

struct orbit_on_branch {
    Eigen::VectorXd unknowns;  // scaled, of the branch's equation
    double variable = 0.0;
    std::vector<double> state;                      // all columns of the orbit's first point
    std::vector<std::complex<double>> multipliers;  // largest modulus first
    std::string word;                               // its events

    bool is_stable() const { return multipliers.empty() || std::abs(multipliers[0]) < 1.0; }
};

struct special_point {
    special_kind kind = special_kind::fold;
    orbit_on_branch orbit;
    std::size_t position = 0;  // lies between this orbit of the branch and the next one
    std::string detail;        // of a border: what changes
    Eigen::VectorXd tangent;   // of the branch, scaled
};

/// Why a branch was not followed further.
enum class branch_end {
    range,    // of the variable
    failure,  // orbits beyond have another outcome
    border,   // orbits beyond have other events, and none of them is periodic nearby
    root,     // the map has a root there, the multiplier no bound
    closed,
    birth,  // from an orbit of half the period
    lost,
    budget,
    start  // begins at a special point of its parent
};

struct end_of_branch {
    branch_end why = branch_end::lost;
    std::string detail;  // the outcome or the events behind the end
    std::optional<singular_end>
        place;  // variable, then all columns, where a multiplier has no bound
};

std::string text_of(const end_of_branch& end);

struct branch {
    int period = 1;
    std::vector<orbit_on_branch> orbits;
    std::vector<special_point> special;
    end_of_branch first;
    end_of_branch last;
    int parent = -1;  // the branch from which this one was switched to
};

}  // namespace hopscotch
