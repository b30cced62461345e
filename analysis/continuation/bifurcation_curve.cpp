// The extended system and its continuation.
#include "analysis/continuation/bifurcation_curve.hpp"

#include "analysis/continuation/event_signature.hpp"
#include "analysis/continuation/stability_tests.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

void set(branch_family& family, const branch_variable& variable, double value) {
    const auto i = static_cast<std::size_t>(variable.index);
    (variable.is_column ? family.state[i] : family.map.parameters[i]) = value;
}

double width_of(const branch_variable& variable) { return variable.highest - variable.lowest; }

/// One direction of a curve.
class curve_walker {
public:
    curve_walker(const bifurcation_equation& equation, curve_point from,
                 const follow_limits& limits)
        : equation_(equation), limits_(limits), here_(std::move(from)), step_(limits.step) {
        word_ = equation_.word_of(here_.unknowns);
    }

    std::vector<Eigen::VectorXd> walk() {
        constexpr double least_step = 1e-9;
        std::vector<Eigen::VectorXd> points{here_.unknowns};
        while (static_cast<int>(points.size()) < limits_.most_orbits) {
            const auto next = attempt();
            if (!next) {
                step_ *= 0.5;
                if (step_ < least_step) return points;
                continue;
            }
            if (leaves_the_range(*next)) {
                end = {branch_end::range, ""};
                points.push_back(to_the_range().unknowns);
                return points;
            }
            here_ = *next;
            points.push_back(here_.unknowns);
            if (points.size() > 10 && (here_.unknowns - points[0]).norm() < 0.6 * step_) {
                end = {branch_end::closed, ""};
                return points;
            }
            step_ = std::min(limits_.step, 1.5 * step_);
            end = {branch_end::lost, ""};
        }
        end = {branch_end::budget, ""};
        return points;
    }

    end_of_branch end{branch_end::lost, ""};

private:
    const bifurcation_equation& equation_;
    follow_limits limits_;
    curve_point here_;
    double step_;
    std::string word_;

    std::optional<curve_point> attempt() {
        const step_result made = step_along(equation_, here_.unknowns, here_.tangent, step_);
        if (!made.point) {
            if (made.end != outcome::ok)
                end = {branch_end::failure, std::string(name_of(made.end))};
            return std::nullopt;
        }
        if (made.point->tangent.dot(here_.tangent) < 0.98) return std::nullopt;
        if ((made.point->unknowns - here_.unknowns).norm() > 2.0 * step_) return std::nullopt;
        if (const std::string word = equation_.word_of(made.point->unknowns); word != word_) {
            end = {branch_end::border, word_ + " would become " + word};
            return std::nullopt;
        }
        return made.point;
    }

    /// How far beyond the ranges, in their widths; at most 0 inside.
    double excess(const Eigen::VectorXd& unknowns) const {
        const auto beyond = [](double value, const branch_variable& variable) {
            return std::max(variable.lowest - value, value - variable.highest) / width_of(variable);
        };
        return std::max(beyond(equation_.variable_of(unknowns), equation_.first_variable()),
                        beyond(equation_.second_of(unknowns), equation_.second_variable()));
    }

    bool leaves_the_range(const curve_point& next) const { return excess(next.unknowns) > 0.0; }

    curve_point to_the_range() const {
        const auto last =
            locate(equation_, here_, step_, [&](const curve_point& point) -> std::optional<double> {
                return excess(point.unknowns);
            });
        return last.value_or(here_);
    }
};

}  // namespace

double value_of(const branch_family& family, const branch_variable& variable) {
    const auto i = static_cast<std::size_t>(variable.index);
    return variable.is_column ? family.state[i] : family.map.parameters[i];
}

branch_family bifurcation_equation::with_second(double value) const {
    branch_family family = *family_;
    set(family, second_, value);
    return family;
}

branch_family bifurcation_equation::with_first(double value) const {
    branch_family family = *family_;
    set(family, family_->variable, value);
    family.variable = second_;
    return family;
}

Eigen::VectorXd bifurcation_equation::unknowns_of(const special_point& point, double second) const {
    Eigen::VectorXd unknowns(point.orbit.unknowns.size() + 1);
    unknowns << point.orbit.unknowns, second / width_of(second_);
    return unknowns;
}

double bifurcation_equation::second_of(const Eigen::VectorXd& unknowns) const {
    return unknowns[unknowns.size() - 1] * width_of(second_);
}

double bifurcation_equation::variable_of(const Eigen::VectorXd& unknowns) const {
    return unknowns[unknowns.size() - 2] * width_of(family_->variable);
}

std::vector<double> bifurcation_equation::state_of(const Eigen::VectorXd& unknowns) const {
    const branch_family family = with_second(second_of(unknowns));
    return branch_equation(family, period_).state_of(unknowns.head(unknowns.size() - 1));
}

std::string bifurcation_equation::word_of(const Eigen::VectorXd& unknowns) const {
    const branch_family family = with_second(second_of(unknowns));
    const branch_equation equation(family, period_);
    const Eigen::VectorXd inner = unknowns.head(unknowns.size() - 1);
    return event_signature(equation.map_at(inner), equation.state_of(inner), period_);
}

std::optional<double> bifurcation_equation::test_at(const Eigen::VectorXd& unknowns) const {
    const branch_family family = with_second(second_of(unknowns));
    const Eigen::MatrixXd derivative =
        branch_equation(family, period_).derivative_at(unknowns.head(unknowns.size() - 1));
    if (derivative.size() == 0) return std::nullopt;
    if (kind_ == special_kind::fold) return fold_test(derivative);
    if (kind_ == special_kind::flip) return flip_test(derivative);
    return pair_test(derivative);
}

equation_value bifurcation_equation::at(const Eigen::VectorXd& unknowns) const {
    constexpr double difference = 1e-6;
    const Eigen::Index n = unknowns.size() - 2;
    const branch_family over_first = with_second(second_of(unknowns));
    const branch_family over_second = with_first(variable_of(unknowns));
    Eigen::VectorXd swapped(n + 1);
    swapped << unknowns.head(n), unknowns[n + 1];
    const equation_value first = branch_equation(over_first, period_).at(unknowns.head(n + 1));
    const equation_value second = branch_equation(over_second, period_).at(swapped);
    const auto test = test_at(unknowns);
    equation_value value{.end = first.end};
    if (!first.is_ok() || !second.is_ok() || !test) {
        if (first.is_ok()) value.end = second.is_ok() ? outcome::not_finite : second.end;
        return value;
    }
    value.residual.resize(n + 1);
    value.residual << first.residual, *test;
    value.jacobian.resize(n + 1, n + 2);
    value.jacobian.topLeftCorner(n, n + 1) = first.jacobian;
    value.jacobian.topRightCorner(n, 1) = second.jacobian.rightCols(1);
    for (Eigen::Index j = 0; j < n + 2; ++j) {
        Eigen::VectorXd moved = unknowns;
        moved[j] = unknowns[j] + difference;
        const auto after = test_at(moved);
        moved[j] = unknowns[j] - difference;
        const auto before = test_at(moved);
        if (!after || !before) {
            value.end = outcome::not_finite;
            return value;
        }
        value.jacobian(n, j) = (*after - *before) / (2.0 * difference);
    }
    return value;
}

std::optional<bifurcation_curve> follow_curve(const branch_family& family,
                                              const branch_variable& second, int period,
                                              const special_point& from,
                                              const follow_limits& limits) {
    const bifurcation_equation equation(family, second, period, from.kind);
    const Eigen::VectorXd start = equation.unknowns_of(from, value_of(family, second));
    const Eigen::VectorXd upward = Eigen::VectorXd::Unit(start.size(), start.size() - 1);
    const equation_value value = equation.at(start);
    if (!value.is_ok()) return std::nullopt;
    const curve_point on_curve{start, tangent_of(value.jacobian, upward)};
    curve_walker back(equation, {start, -on_curve.tangent}, limits);
    std::vector<Eigen::VectorXd> points = back.walk();
    std::reverse(points.begin(), points.end());
    curve_walker onward(equation, on_curve, limits);
    const std::vector<Eigen::VectorXd> rest = onward.walk();
    points.insert(points.end(), rest.begin() + 1, rest.end());
    if (points.size() < 3) return std::nullopt;
    bifurcation_curve curve{.kind = from.kind, .period = period};
    curve.first = back.end;
    curve.last = onward.end;
    for (const Eigen::VectorXd& point : points) {
        curve.variable.push_back(equation.variable_of(point));
        curve.second.push_back(equation.second_of(point));
        curve.state.push_back(equation.state_of(point));
    }
    return curve;
}

namespace {

/// Whether a curve of the same kind meets the line on which the branches stand at this point.
bool is_on(const bifurcation_curve& curve, const branch_family& family, double at_second,
           int period, const special_point& point) {
    constexpr double near = 1e-3;  // of the range: chords of a curve
    if (curve.kind != point.kind || curve.period != period) return false;
    for (std::size_t i = 0; i + 1 < curve.second.size(); ++i) {
        const double before = curve.second[i] - at_second;
        const double after = curve.second[i + 1] - at_second;
        if (before * after > 0.0) continue;
        const double share = before == after ? 0.0 : before / (before - after);
        const double there =
            curve.variable[i] + share * (curve.variable[i + 1] - curve.variable[i]);
        if (std::abs(there - point.orbit.variable) < near * width_of(family.variable)) return true;
    }
    return false;
}

}  // namespace

std::vector<bifurcation_curve> curves_through(const branch_family& family,
                                              const branch_variable& second,
                                              const std::vector<branch>& branches,
                                              const follow_limits& limits) {
    std::vector<bifurcation_curve> curves;
    const double at_second = value_of(family, second);
    for (const branch& branch : branches) {
        for (const special_point& point : branch.special) {
            const bool has_curve = point.kind == special_kind::fold ||
                                   point.kind == special_kind::flip ||
                                   point.kind == special_kind::neimark_sacker;
            if (!has_curve) continue;
            const bool is_known = std::any_of(curves.begin(), curves.end(), [&](const auto& curve) {
                return is_on(curve, family, at_second, branch.period, point);
            });
            if (is_known) continue;
            auto curve = follow_curve(family, second, branch.period, point, limits);
            if (curve) curves.push_back(std::move(*curve));
        }
    }
    return curves;
}

}  // namespace hopscotch
