// Stations, starts not yet on a known branch, and generations of doubled branches.
#include "analysis/continuation/find_branches.hpp"

#include "analysis/continuation/describe.hpp"
#include "analysis/continuation/switching.hpp"
#include "analysis/periodic/return_equation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace hopscotch {
namespace {

/// Whether the branch passes through the orbit: from the chord between two of its orbits that
/// enclose the value of the variable, Newton's method leads to it.
bool passes_through(const branch& known, const branch_family& family, const periodic_orbit& orbit,
                    double variable) {
    constexpr double same = 1e-6;  // in the columns' scale
    if (known.period != orbit.period) return false;
    const branch_equation equation(family, known.period);
    const Eigen::Index last = family.n_unknowns() - 1;
    const Eigen::VectorXd upright = Eigen::VectorXd::Unit(last + 1, last);
    for (std::size_t i = 0; i + 1 < known.orbits.size(); ++i) {
        const double before = known.orbits[i].variable - variable;
        const double after = known.orbits[i + 1].variable - variable;
        if (before * after > 0.0 || before == after) continue;
        const double share = before / (before - after);
        const Eigen::VectorXd& a = known.orbits[i].unknowns;
        const Eigen::VectorXd& b = known.orbits[i + 1].unknowns;
        const auto there = step_along(equation, a + share * (b - a), upright, 0.0).point;
        if (!there) continue;
        const std::vector<double> state = equation.state_of(there->unknowns);
        const map_point map = equation.map_at(there->unknowns);
        for (int k = 0; k < orbit.period; ++k) {
            if (distance_of(map, state, orbit.point(k), family.scale) < same) return true;
        }
    }
    return false;
}

bool is_known(const std::vector<branch>& branches, const branch_family& family,
              const periodic_orbit& orbit, double variable) {
    return std::any_of(branches.begin(), branches.end(), [&](const branch& known) {
        return passes_through(known, family, orbit, variable);
    });
}

void follow_from(std::vector<branch>& branches, const branch_study& study,
                 const periodic_orbit& orbit, double variable) {
    const branch_equation equation(study.family, orbit.period);
    const Eigen::VectorXd unknowns = equation.unknowns_of(orbit.point(0), variable);
    const equation_value value = equation.at(unknowns);
    if (!value.is_ok()) return;
    const Eigen::VectorXd upward = Eigen::VectorXd::Unit(unknowns.size(), unknowns.size() - 1);
    branch found =
        follow_both_ways(equation, {unknowns, tangent_of(value.jacobian, upward)}, study.limits);
    // an equilibrium that passes for an orbit stands alone
    if (found.orbits.size() > 1) branches.push_back(std::move(found));
}

void add_branches_from_starts(std::vector<branch>& branches, const branch_study& study) {
    const branch_variable& variable = study.family.variable;
    for (int period = 1; period <= study.most_period; ++period) {
        for (int i = 0; i < study.stations; ++i) {
            const double share = (i + 0.5) / study.stations;
            const double value = variable.lowest + share * (variable.highest - variable.lowest);
            for (const periodic_orbit& orbit :
                 start_orbits(study.family, value, study.samples, period, study.settling)) {
                if (!is_known(branches, study.family, orbit, value))
                    follow_from(branches, study, orbit, value);
            }
        }
    }
}

/// Whether an orbit in the middle of the branch lies on one of those known.
bool is_known(const std::vector<branch>& branches, const branch_family& family,
              const branch& found) {
    const orbit_on_branch& inner = found.orbits[found.orbits.size() / 2];
    periodic_orbit orbit{.period = found.period, .n_columns = family.map.n_columns()};
    for (const auto& point : points_of(family, found.period, inner))
        orbit.points.insert(orbit.points.end(), point.begin(), point.end());
    if (static_cast<int>(orbit.points.size()) < orbit.period * orbit.n_columns) return true;
    return is_known(branches, family, orbit, inner.variable);
}

/// Branches from the flips of one generation; an orbit of twice the period that is known already is
/// not followed again.
void add_doubled(std::vector<branch>& branches, const branch_study& study, std::size_t parent,
                 const follow_limits& limits) {
    const branch from = branches[parent];
    for (const special_point& special : from.special) {
        if (special.kind != special_kind::flip) continue;
        auto found = doubled_branch(study.family, from.period, special, limits);
        if (!found || found->orbits.size() < 2) continue;
        if (is_known(branches, study.family, *found)) continue;
        found->parent = static_cast<int>(parent);
        branches.push_back(std::move(*found));
    }
}

void add_crossing(std::vector<branch>& branches, const branch_study& study, std::size_t parent) {
    const branch from = branches[parent];
    for (const special_point& special : from.special) {
        if (special.kind != special_kind::branch_point) continue;
        for (branch& found : crossing_branches(study.family, from.period, special, study.limits)) {
            if (found.orbits.size() < 2 || is_known(branches, study.family, found)) continue;
            found.parent = static_cast<int>(parent);
            branches.push_back(std::move(found));
        }
    }
}

}  // namespace

std::vector<int> conserved_columns_of(const map_point& map,
                                      const std::vector<sampled_column>& samples) {
    const std::vector<double> starts = grid_of_starts(samples);
    for (std::size_t i = 0; i < starts.size(); i += samples.size()) {
        const auto start = std::span(starts).subspan(i, samples.size());
        if (map.jet(start.data()).end == outcome::ok) return conserved_columns(map, start);
    }
    return {};
}

branch_family family_of(const map_point& map, const branch_variable& variable,
                        const std::vector<sampled_column>& samples) {
    branch_family family{.map = map, .variable = variable};
    map_point middle = map;
    if (!variable.is_column) {
        middle.parameters[static_cast<std::size_t>(variable.index)] =
            0.5 * (variable.lowest + variable.highest);
    }
    const std::vector<int> conserved = conserved_columns_of(middle, samples);
    const auto is_conserved = [&](int c) {
        return std::find(conserved.begin(), conserved.end(), c) != conserved.end();
    };
    if (variable.is_column && !is_conserved(variable.index)) {
        throw std::invalid_argument(fmt::format("{} is not conserved by the return map of {}",
                                                variable.name(map), map.model->info->name));
    }
    for (int c = 0; c < map.n_columns(); ++c) {
        const sampled_column& sampled = samples[static_cast<std::size_t>(c)];
        if (!is_conserved(c)) family.columns.push_back(c);
        family.state.push_back(0.5 * (sampled.lowest + sampled.highest));
        const double width = sampled.highest - sampled.lowest;
        const double size = std::abs(sampled.highest);
        family.scale.push_back(width > 0.0 ? width : size > 0.0 ? size : 1.0);
    }
    return family;
}

std::vector<branch> find_branches(const branch_study& study) {
    std::vector<branch> branches;
    add_branches_from_starts(branches, study);
    const std::size_t n_from_starts = branches.size();
    for (std::size_t i = 0; i < n_from_starts; ++i) add_crossing(branches, study, i);
    follow_limits limits = study.limits;
    std::size_t begin = 0;
    for (int generation = 0; generation < study.doublings; ++generation) {
        const std::size_t end = branches.size();
        for (std::size_t i = begin; i < end; ++i) add_doubled(branches, study, i, limits);
        begin = end;
        limits.step /= 2.5;  // how cascades shrink
    }
    return branches;
}

}  // namespace hopscotch
