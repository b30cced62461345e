// Probes just beyond a wall and takes the first step there along the tangent of the map behind it.
#include "analysis/continuation/border.hpp"

#include "analysis/continuation/describe.hpp"
#include "analysis/continuation/event_signature.hpp"
#include "analysis/continuation/stability_tests.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace hopscotch {
namespace {

constexpr std::array probes{1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};

std::string word_at(const branch_equation& equation, const Eigen::VectorXd& unknowns) {
    return event_signature(equation.map_at(unknowns), equation.state_of(unknowns),
                           equation.period());
}

std::string leading(const orbit_on_branch& orbit) {
    const std::complex<double> mu = orbit.multipliers.front();
    if (mu.imag() == 0.0) return fmt::format("{:.6g}", mu.real());
    return fmt::format("{:.6g}+-{:.6g}i", mu.real(), std::abs(mu.imag()));
}

double leading_modulus(const branch_equation& equation, const curve_point& point) {
    const auto multipliers = multipliers_of(equation.derivative_at(point.unknowns));
    return multipliers.empty() ? 1e300 : std::abs(multipliers.front());
}

std::string described(const branch_equation& equation, const curve_point& last,
                      const curve_point& beyond) {
    const orbit_on_branch before = describe(equation, last);
    const orbit_on_branch after = describe(equation, beyond);
    return fmt::format("{} becomes {}, multiplier {} becomes {}", before.word, after.word,
                       leading(before), leading(after));
}

/// Whether the events stay those behind the wall for a while onward.
bool stays_behind(const branch_equation& equation, const curve_point& first,
                  const std::string& word, double length) {
    for (const double further : {3.0 * length, 30.0 * length}) {
        const auto next = step_along(equation, first.unknowns, first.tangent, further).point;
        if (!next || word_at(equation, next->unknowns) == word) return false;
    }
    return true;
}

/// A converged first step from the wall along the tangent of the map behind it, in the direction in
/// which the events stay those behind.
std::optional<curve_point> first_step(const branch_equation& equation, const curve_point& last,
                                      const std::string& word, const Eigen::VectorXd& tangent,
                                      double length) {
    for (const double sign : {1.0, -1.0}) {
        const Eigen::VectorXd direction = sign * tangent;
        const auto point = step_along(equation, last.unknowns, direction, length).point;
        if (!point || (point->unknowns - last.unknowns).norm() > 1.5 * length) continue;
        if (word_at(equation, point->unknowns) == word) continue;
        if (stays_behind(equation, *point, word, length)) return point;
    }
    return std::nullopt;
}

/// Back from the first orbit behind the wall towards it, as far as the events stay the same.
std::optional<curve_point> back_to_the_wall(const branch_equation& equation,
                                            const curve_point& first, double length) {
    constexpr double least = 1e-13;
    const std::string word = word_at(equation, first.unknowns);
    curve_point nearest{first.unknowns, -first.tangent};
    double walked = 0.0;
    for (double step = length; step > least && walked < 4.0 * length;) {
        const auto next = step_along(equation, nearest.unknowns, nearest.tangent, step).point;
        if (next && word_at(equation, next->unknowns) == word) {
            nearest = *next;
            walked += step;
        } else {
            step *= 0.5;
        }
    }
    if (walked >= 4.0 * length) return std::nullopt;
    return curve_point{nearest.unknowns, -nearest.tangent};
}

}  // namespace

wall_crossing cross_wall(const branch_equation& equation, const curve_point& last,
                         const std::string& word) {
    wall_crossing crossing;
    for (const double probe : probes) {
        const Eigen::VectorXd there = last.unknowns + probe * last.tangent;
        const equation_value value = equation.at(there);
        if (!value.is_ok()) {
            if (crossing.end.why != branch_end::border)
                crossing.end = {branch_end::failure, std::string(name_of(value.end))};
            continue;
        }
        const std::string behind = word_at(equation, there);
        if (behind == word) continue;
        if (crossing.end.why == branch_end::lost)
            crossing.end = {branch_end::border, fmt::format("{} would become {}", word, behind)};
        const Eigen::VectorXd tangent = tangent_of(value.jacobian, last.tangent);
        for (const double length : probes) {
            if (length < probe) continue;
            const auto beyond = first_step(equation, last, word, tangent, length);
            if (!beyond) continue;
            crossing.detail = described(equation, last, *beyond);
            crossing.beyond = beyond;
            crossing.length = length;
            crossing.wall = last;
            // a graze is singular on one side: the regular one gives its place
            const auto behind_it = back_to_the_wall(equation, *beyond, length);
            if (behind_it &&
                leading_modulus(equation, *behind_it) < leading_modulus(equation, last))
                crossing.wall = *behind_it;
            return crossing;
        }
    }
    return crossing;
}

}  // namespace hopscotch
