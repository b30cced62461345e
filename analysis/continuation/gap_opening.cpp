// The minimum of a return map and the zero of its square.
#include "analysis/continuation/gap_opening.hpp"

#include "analysis/periodic/return_equation.hpp"

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

/// P, its slope and its derivative by the variable.
struct map_value {
    double value = 0.0;
    double slope = 0.0;
    double by_variable = 0.0;
};

std::optional<map_value> value_at(const branch_family& family, double state, double variable) {
    const auto column = static_cast<std::size_t>(family.columns[0]);
    std::vector<double> x = family.state;
    x[column] = state;
    const branch_equation equation(family, 1);
    const Eigen::VectorXd unknowns = equation.unknowns_of(x, variable);
    const return_value value =
        evaluate_return(equation.map_at(unknowns), equation.state_of(unknowns), 1, family.columns,
                        family.variable.is_column ? -1 : family.variable.index);
    if (!value.is_ok()) return std::nullopt;
    return map_value{state + value.gap[0], value.derivative(0, 0),
                     family.variable.is_column ? value.by_column(0, family.variable.index)
                                               : value.by_parameter[0]};
}

/// The lowest minimum of P strictly between two states.
std::optional<double> minimum_of(const branch_family& family, double variable, double lowest,
                                 double highest) {
    constexpr int n_samples = 400;
    double best = 1e300;
    double left = 0.0;
    double right = 0.0;
    const auto sample = [&](int i) { return lowest + (highest - lowest) * i / n_samples; };
    auto before = value_at(family, sample(0), variable);
    for (int i = 1; i <= n_samples; ++i) {
        const auto here = value_at(family, sample(i), variable);
        const bool turns = before && here && before->slope < 0.0 && here->slope >= 0.0;
        if (turns && std::min(before->value, here->value) < best) {
            best = std::min(before->value, here->value);
            left = sample(i - 1);
            right = sample(i);
        }
        before = here;
    }
    if (best == 1e300) return std::nullopt;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (left + right);
        const auto here = value_at(family, middle, variable);
        if (!here) return std::nullopt;
        (here->slope < 0.0 ? left : right) = middle;
    }
    return 0.5 * (left + right);
}

/// How many starts have a return at a value of the variable.
int n_returns(const branch_study& study, const sampled_column& starts, double variable) {
    int n = 0;
    for (int i = 0; i < starts.n_samples; ++i) {
        if (value_at(study.family, starts.sample(i), variable)) ++n;
    }
    return n;
}

bool is_among(const std::vector<gap_opening>& gaps, const gap_opening& gap) {
    constexpr double same = 1e-9;
    return std::any_of(gaps.begin(), gaps.end(), [&](const gap_opening& other) {
        return std::abs(other.variable - gap.variable) <= same * std::abs(gap.variable);
    });
}

/// Whether the start at the minimum fails on one side of the opening only.
bool is_opening(const branch_family& family, const gap_opening& gap) {
    constexpr double aside = 1e-9;
    const auto has_return = [&](double share) {
        return value_at(family, gap.state, gap.variable * share).has_value();
    };
    return has_return(1.0 - aside) != has_return(1.0 + aside);
}

}  // namespace

std::optional<gap_opening> find_gap_opening(const branch_family& family, double from, double lowest,
                                            double highest, double edge) {
    constexpr double careful = 0.99;  // of Newton's step: the map fails beyond the root
    constexpr int most_steps = 60;
    double good = from;
    double move = 0.0;
    for (int i = 0; i < most_steps; ++i) {
        const double variable = good + move;
        const bool is_inside =
            variable >= family.variable.lowest && variable <= family.variable.highest;
        const auto state = is_inside ? minimum_of(family, variable, lowest, highest) : std::nullopt;
        const auto here = state ? value_at(family, *state, variable) : std::nullopt;
        if (!here) {
            if (move == 0.0) return std::nullopt;
            move *= 0.5;
            continue;
        }
        const double step = -0.5 * (here->value - edge) / here->by_variable;  // of (P - edge)^2
        if (std::abs(step) <= 1e-12 * std::abs(variable))
            return gap_opening{variable + step, *state};
        good = variable;
        move = careful * step;
    }
    return std::nullopt;
}

std::vector<gap_opening> find_gap_openings(const branch_study& study) {
    const branch_family& family = study.family;
    if (family.columns.size() != 1) return {};
    const auto column = static_cast<std::size_t>(family.columns[0]);
    const sampled_column& starts = study.samples[column];
    const branch_variable& over = family.variable;
    std::vector<gap_opening> gaps;
    double before = 0.0;
    int n_before = 0;
    for (int i = 0; i < study.stations + 2; ++i) {  // the ends of the range and the stations
        const double share = std::clamp((i - 0.5) / study.stations, 0.0, 1.0);
        const double here = over.lowest + share * (over.highest - over.lowest);
        const int n_here = n_returns(study, starts, here);
        if (i > 0 && n_here != n_before) {
            const auto gap = find_gap_opening(family, n_here > n_before ? here : before,
                                              starts.lowest, starts.highest);
            if (gap && is_opening(family, *gap) && !is_among(gaps, *gap)) gaps.push_back(*gap);
        }
        before = here;
        n_before = n_here;
    }
    return gaps;
}

}  // namespace hopscotch
