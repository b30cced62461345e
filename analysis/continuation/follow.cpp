// Step control, special points on the way, and what to do at walls.
#include "analysis/continuation/follow.hpp"

#include "analysis/continuation/border.hpp"
#include "analysis/continuation/describe.hpp"
#include "analysis/continuation/stability_tests.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace hopscotch {
namespace {

enum class trial { good, bad, sharp };  // sharp: converged, but the curve bends too much

class walker {
public:
    walker(const branch_equation& equation, const curve_point& from, const follow_limits& limits)
        : equation_(equation), limits_(limits), here_(from), step_(0.1 * limits.step) {
        path_.period = equation.period();
        orbit_ = describe(equation_, here_);
        tests_ = tests_at(equation_, here_);
        half_ = half_gap(here_);
    }

    branch walk() {
        path_.orbits.push_back(orbit_);
        const curve_point start = here_;
        while (true) {
            if (static_cast<int>(path_.orbits.size()) >= limits_.most_orbits)
                return end({branch_end::budget, ""});
            const curve_point before = here_;
            if (!advance()) return end(stop_);
            if (path_.orbits.size() > 3 && has_passed(before, start))
                return end({branch_end::closed, ""});
            if (here_.unknowns.cwiseAbs().maxCoeff() > limits_.farthest)
                return end({branch_end::lost, ""});
        }
    }

private:
    const branch_equation& equation_;
    follow_limits limits_;
    curve_point here_;
    orbit_on_branch orbit_;
    std::optional<test_values> tests_;
    std::optional<Eigen::VectorXd> half_;
    double step_;
    branch path_;
    end_of_branch stop_;
    std::vector<approach> way_;  // of every step: variable, columns and largest multiplier

    /// Whether the last step led through the start, in the start's direction.
    bool has_passed(const curve_point& before, const curve_point& start) const {
        const Eigen::VectorXd step = here_.unknowns - before.unknowns;
        const Eigen::VectorXd to_start = start.unknowns - before.unknowns;
        const double share = to_start.dot(step) / step.squaredNorm();
        if (share < 0.0 || share > 1.0 || start.tangent.dot(before.tangent) < 0.9) return false;
        return (to_start - share * step).norm() < 0.02 * step.norm();
    }

    branch end(end_of_branch why) {
        if (path_.orbits.back().unknowns != here_.unknowns) path_.orbits.push_back(orbit_);
        path_.last = std::move(why);
        return std::move(path_);
    }

    /// One step forward, or over a border; false where the branch ends (`stop_`).
    bool advance() {
        curve_point next;
        orbit_on_branch orbit;
        while (true) {
            const trial made = attempt(next, orbit);
            if (made == trial::good) break;
            if (made == trial::sharp && step_ < 1e-9) break;  // a kink without an event
            step_ *= 0.5;
            if (step_ < limits_.least_step) return over_the_wall();
        }
        const double length = step_;
        const branch_variable& variable = equation_.family().variable;
        if (orbit.variable < variable.lowest || orbit.variable > variable.highest)
            return to_the_range(length);
        if (shrinks_to_half(next)) {
            stop_ = {branch_end::birth, ""};
            return false;
        }
        note_special_points(next, length);
        move_to(next, orbit);
        step_ = std::min(limits_.step, 1.5 * length);
        return true;
    }

    void move_to(const curve_point& next, const orbit_on_branch& orbit) {
        constexpr double dense = 1e-4;  // of the longest step: closer orbits are not kept
        here_ = next;
        orbit_ = orbit;
        way_.push_back({{orbit_.variable}, std::abs(orbit_.multipliers.front())});
        way_.back().numbers.insert(way_.back().numbers.end(), orbit_.state.begin(),
                                   orbit_.state.end());
        tests_ = tests_at(equation_, here_);
        half_ = half_gap(here_);
        const double apart = (here_.unknowns - path_.orbits.back().unknowns).norm();
        if (apart > dense * limits_.step) path_.orbits.push_back(orbit_);
    }

    trial attempt(curve_point& next, orbit_on_branch& orbit) const {
        const step_result result = step_along(equation_, here_.unknowns, here_.tangent, step_);
        if (!result.point) return trial::bad;
        next = *result.point;
        if ((next.unknowns - here_.unknowns).norm() > 2.0 * step_) return trial::bad;
        orbit = describe(equation_, next);
        if (orbit.multipliers.empty() || orbit.word != orbit_.word) return trial::bad;
        if (next.tangent.dot(here_.tangent) < 0.98) return trial::sharp;
        if (step_ > 1e-3 * limits_.step && change_of_multipliers(orbit) > 0.3) return trial::bad;
        return trial::good;
    }

    double change_of_multipliers(const orbit_on_branch& orbit) const {
        double change = 0.0;
        for (std::size_t i = 0; i < orbit.multipliers.size(); ++i) {
            const double before = std::abs(orbit_.multipliers[i]);
            change = std::max(change,
                              std::abs(std::abs(orbit.multipliers[i]) - before) / (1.0 + before));
        }
        return change;
    }

    bool to_the_range(double length) {
        const branch_variable& variable = equation_.family().variable;
        const double width = variable.highest - variable.lowest;
        for (const double bound : {variable.lowest, variable.highest}) {
            const auto beyond = [&](const curve_point& point) -> std::optional<double> {
                return (equation_.variable_of(point.unknowns) - bound) / width;
            };
            const auto last = locate(equation_, here_, length, beyond);
            if (!last) continue;
            note_special_points(*last, (last->unknowns - here_.unknowns).dot(here_.tangent));
            here_ = *last;
            orbit_ = describe(equation_, here_);
            break;
        }
        stop_ = {branch_end::range, ""};
        return false;
    }

    bool over_the_wall() {
        const wall_crossing crossing = cross_wall(equation_, here_, orbit_.word);
        if (!crossing.beyond) {
            stop_ = crossing.end;
            stop_.place = find_singular_end(way_);
            if (stop_.why == branch_end::lost && stop_.place) stop_.why = branch_end::root;
            return false;
        }
        special_point special{.kind = special_kind::border,
                              .orbit = describe(equation_, crossing.wall)};
        special.position = path_.orbits.size();  // between the two orbits pushed here
        special.detail = crossing.detail;
        special.tangent = here_.tangent;
        path_.orbits.push_back(orbit_);
        path_.special.push_back(std::move(special));
        here_ = *crossing.beyond;
        orbit_ = describe(equation_, here_);
        tests_ = tests_at(equation_, here_);
        half_ = half_gap(here_);
        path_.orbits.push_back(orbit_);
        step_ = std::max(crossing.length, 1e-3 * limits_.step);
        return true;
    }

    void note_special_points(const curve_point& next, double length) {
        const auto after = tests_at(equation_, next);
        if (!tests_ || !after) return;
        for (int i = 0; i < static_cast<int>(after->size()); ++i) {
            const auto test = static_cast<std::size_t>(i);
            if ((*tests_)[test] * (*after)[test] >= 0.0) continue;
            const auto zero = locate(equation_, here_, length, [&](const curve_point& point) {
                const auto values = tests_at(equation_, point);
                return values ? std::optional((*values)[test]) : std::nullopt;
            });
            if (!zero) continue;
            special_point special{.orbit = describe(equation_, *zero)};
            const auto kind = kind_of_zero(i, special.orbit.multipliers);
            if (!kind) continue;
            special.kind = *kind;
            special.position = path_.orbits.size() - 1;
            // where branches cross, the Jacobian of the point itself has no one tangent
            special.tangent = special.kind == special_kind::branch_point
                                  ? (next.unknowns - here_.unknowns).normalized()
                                  : zero->tangent;
            path_.special.push_back(std::move(special));
        }
    }

    /// P^(period/2)(x) - x of an orbit of even period, scaled.
    std::optional<Eigen::VectorXd> half_gap(const curve_point& point) const {
        if (equation_.period() % 2 != 0) return std::nullopt;
        const branch_equation half(equation_.family(), equation_.period() / 2);
        const equation_value value = half.at(point.unknowns);
        return value.is_ok() ? std::optional(value.residual) : std::nullopt;
    }

    /// Whether the two halves of the orbit change places within the step.
    bool shrinks_to_half(const curve_point& next) const {
        const auto after = half_gap(next);
        constexpr double rounding = 1e-9;  // both halves are one orbit throughout
        if (!half_ || !after || half_->norm() < rounding || after->norm() < rounding) return false;
        return half_->dot(*after) < 0.0;
    }
};

}  // namespace

branch follow(const branch_equation& equation, const curve_point& from,
              const follow_limits& limits) {
    return walker(equation, from, limits).walk();
}

branch follow_both_ways(const branch_equation& equation, const curve_point& from,
                        const follow_limits& limits) {
    branch forward = follow(equation, from, limits);
    if (forward.last.why == branch_end::closed) {
        forward.first = forward.last;
        return forward;
    }
    branch result = follow(equation, {from.unknowns, -from.tangent}, limits);
    std::reverse(result.orbits.begin(), result.orbits.end());
    std::reverse(result.special.begin(), result.special.end());
    const std::size_t n = result.orbits.size();
    for (special_point& special : result.special) special.position = n - 2 - special.position;
    result.first = result.last;
    result.last = forward.last;
    for (special_point& special : forward.special) special.position += n - 1;
    result.orbits.insert(result.orbits.end(), forward.orbits.begin() + 1, forward.orbits.end());
    result.special.insert(result.special.end(), forward.special.begin(), forward.special.end());
    return result;
}

}  // namespace hopscotch
