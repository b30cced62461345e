// Scaling of unknowns, and the equation from jets of the return map.
#include "analysis/continuation/branch_equation.hpp"

#include "analysis/periodic/return_equation.hpp"

namespace hopscotch {

std::string_view branch_variable::name(const map_point& map) const {
    const auto i = static_cast<std::size_t>(index);
    return is_column ? map.columns_of().columns[i].name : map.model->info->parameters[i].name;
}

double branch_equation::scale_of(Eigen::Index i) const {
    const auto index = static_cast<std::size_t>(i);
    if (index == family_->columns.size()) {
        return family_->variable.highest - family_->variable.lowest;
    }
    return family_->scale[static_cast<std::size_t>(family_->columns[index])];
}

double branch_equation::variable_of(const Eigen::VectorXd& unknowns) const {
    const Eigen::Index last = unknowns.size() - 1;
    return unknowns[last] * scale_of(last);
}

std::vector<double> branch_equation::state_of(const Eigen::VectorXd& unknowns) const {
    std::vector<double> state = family_->state;
    const branch_variable& variable = family_->variable;
    if (variable.is_column) state[static_cast<std::size_t>(variable.index)] = variable_of(unknowns);
    for (std::size_t i = 0; i < family_->columns.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        state[static_cast<std::size_t>(family_->columns[i])] = unknowns[at] * scale_of(at);
    }
    return state;
}

map_point branch_equation::map_at(const Eigen::VectorXd& unknowns) const {
    map_point map = family_->map;
    const branch_variable& variable = family_->variable;
    if (!variable.is_column) {
        map.parameters[static_cast<std::size_t>(variable.index)] = variable_of(unknowns);
    }
    return map;
}

Eigen::VectorXd branch_equation::unknowns_of(std::span<const double> state, double variable) const {
    Eigen::VectorXd unknowns(family_->n_unknowns());
    for (std::size_t i = 0; i < family_->columns.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        unknowns[at] = state[static_cast<std::size_t>(family_->columns[i])] / scale_of(at);
    }
    const Eigen::Index last = unknowns.size() - 1;
    unknowns[last] = variable / scale_of(last);
    return unknowns;
}

equation_value branch_equation::at(const Eigen::VectorXd& unknowns) const {
    const branch_variable& variable = family_->variable;
    const return_value value =
        evaluate_return(map_at(unknowns), state_of(unknowns), period_, family_->columns,
                        variable.is_column ? -1 : variable.index);
    equation_value result{.end = value.end};
    if (!value.is_ok()) return result;
    const Eigen::Index n = unknowns.size() - 1;
    result.residual.resize(n);
    result.jacobian.resize(n, n + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
        result.residual[i] = value.gap[i] / scale_of(i);
        for (Eigen::Index j = 0; j < n; ++j) {
            const double slope = value.derivative(i, j) - (i == j ? 1.0 : 0.0);
            result.jacobian(i, j) = slope * scale_of(j) / scale_of(i);
        }
        const double slope =
            variable.is_column ? value.by_column(i, variable.index) : value.by_parameter[i];
        result.jacobian(i, n) = slope * scale_of(n) / scale_of(i);
    }
    if (!result.jacobian.allFinite()) result.end = outcome::not_finite;
    return result;
}

Eigen::MatrixXd branch_equation::derivative_at(const Eigen::VectorXd& unknowns) const {
    const return_value value =
        evaluate_return(map_at(unknowns), state_of(unknowns), period_, family_->columns);
    return value.is_ok() ? value.derivative : Eigen::MatrixXd();
}

}  // namespace hopscotch
