// Curves of folds, flips and Neimark-Sacker points over two variables.
//
// The extended system is P^period(x) = x with det(DP - 1) = 0, det(DP + 1) = 0 or the product of
// (mu_i mu_j - 1) = 0 in the unknowns (x, variable, second variable). Its first rows have exact
// Jacobians; the gradient of the last one is a central difference of exact derivatives (step 1e-6
// of the scale), which bounds the speed of Newton's method but not the accuracy of its result.
#pragma once

#include "analysis/continuation/branch.hpp"
#include "analysis/continuation/branch_equation.hpp"
#include "analysis/continuation/corrector.hpp"
#include "analysis/continuation/follow.hpp"

#include <optional>
#include <vector>

namespace hopscotch {

struct bifurcation_curve {
    special_kind kind = special_kind::fold;
    int period = 1;
    std::vector<double> variable;
    std::vector<double> second;
    std::vector<std::vector<double>> state;  // all columns of the orbit's first point
    end_of_branch first;
    end_of_branch last;
};

class bifurcation_equation final : public curve_equation {
public:
    /// \param kind  fold, flip or neimark_sacker
    bifurcation_equation(const branch_family& family, const branch_variable& second, int period,
                         special_kind kind)
        : family_(&family), second_(second), period_(period), kind_(kind) {}

    equation_value at(const Eigen::VectorXd& unknowns) const override;

    /// Scaled unknowns of a special point at a value of the second variable, and back.
    Eigen::VectorXd unknowns_of(const special_point& point, double second) const;
    double second_of(const Eigen::VectorXd& unknowns) const;
    double variable_of(const Eigen::VectorXd& unknowns) const;
    std::vector<double> state_of(const Eigen::VectorXd& unknowns) const;
    std::string word_of(const Eigen::VectorXd& unknowns) const;

    const branch_variable& first_variable() const { return family_->variable; }
    const branch_variable& second_variable() const { return second_; }
    int period() const { return period_; }
    special_kind kind() const { return kind_; }

private:
    const branch_family* family_;
    branch_variable second_;
    int period_;
    special_kind kind_;

    branch_family with_second(double value) const;
    branch_family with_first(double value) const;
    std::optional<double> test_at(const Eigen::VectorXd& unknowns) const;
};

/// The value of `second` that a family's map stands at.
double value_of(const branch_family& family, const branch_variable& variable);

/// The curve through a special point, both ways to the ends of both variables' ranges, a change of
/// events or a failing orbit; none where Newton's method does not converge on the point.
std::optional<bifurcation_curve> follow_curve(const branch_family& family,
                                              const branch_variable& second, int period,
                                              const special_point& from,
                                              const follow_limits& limits = {});

/// The curves through all folds, flips and Neimark-Sacker points of the branches, each once.
std::vector<bifurcation_curve> curves_through(const branch_family& family,
                                              const branch_variable& second,
                                              const std::vector<branch>& branches,
                                              const follow_limits& limits = {});

}  // namespace hopscotch
