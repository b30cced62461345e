// n equations in n + 1 scaled unknowns, whose solutions form curves: what continuation follows.
#pragma once

#include "kernels/contract/outcome.hpp"

#include <Eigen/Core>

namespace hopscotch {

struct equation_value {
    outcome end = outcome::ok;  // the numbers below mean nothing unless it is ok
    Eigen::VectorXd residual;   // n
    Eigen::MatrixXd jacobian;   // n x (n + 1)

    bool is_ok() const { return end == outcome::ok; }
};

class curve_equation {
public:
    virtual ~curve_equation() = default;

    /// Unknowns are scaled so that steps of the same length mean about the same everywhere.
    virtual equation_value at(const Eigen::VectorXd& unknowns) const = 0;
};

}  // namespace hopscotch
