// P^period(x) = x in the unknowns (free columns, one variable): the variable is a parameter of the
// model, or a state column that the return map conserves. Its solutions are branches of periodic
// orbits.
#pragma once

#include "analysis/continuation/equation.hpp"
#include "analysis/periodic/map_point.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace hopscotch {

/// What a branch runs over.
struct branch_variable {
    bool is_column = false;  // else a parameter
    int index = 0;
    double lowest = 0.0;
    double highest = 1.0;

    std::string_view name(const map_point& map) const;
};

/// One family of branches: the map, the variable, and the columns that are solved for.
struct branch_family {
    map_point map;  // the variable's own value in it is ignored
    branch_variable variable;
    std::vector<int> columns;   // unknown ones
    std::vector<double> state;  // of every column; the unknown ones and the variable are ignored
    std::vector<double> scale;  // of every column

    Eigen::Index n_unknowns() const { return static_cast<Eigen::Index>(columns.size()) + 1; }
};

class branch_equation final : public curve_equation {
public:
    branch_equation(const branch_family& family, int period) : family_(&family), period_(period) {}

    equation_value at(const Eigen::VectorXd& unknowns) const override;

    /// DP^period over the free columns, unscaled; empty where the orbit fails.
    Eigen::MatrixXd derivative_at(const Eigen::VectorXd& unknowns) const;

    /// All columns of the orbit's first point.
    std::vector<double> state_of(const Eigen::VectorXd& unknowns) const;
    double variable_of(const Eigen::VectorXd& unknowns) const;
    map_point map_at(const Eigen::VectorXd& unknowns) const;

    /// Scaled unknowns of a state at a value of the variable.
    Eigen::VectorXd unknowns_of(std::span<const double> state, double variable) const;

    const branch_family& family() const { return *family_; }
    int period() const { return period_; }

private:
    const branch_family* family_;
    int period_;

    double scale_of(Eigen::Index i) const;
};

}  // namespace hopscotch
