// First steps along eigenvectors: of -1 at a flip, of the second null direction at a branch point.
#include "analysis/continuation/switching.hpp"

#include "analysis/continuation/describe.hpp"

#include <array>
#include <cmath>

#include <Eigen/SVD>

namespace hopscotch {
namespace {

constexpr std::array first_steps{0.3, 0.1, 0.03, 0.01, 1e-3};  // of the longest step

/// Scaled right singular vector of the smallest singular value.
Eigen::VectorXd null_vector(const Eigen::MatrixXd& matrix) {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(matrix, Eigen::ComputeFullV).matrixV().rightCols(1);
}

/// A first orbit on the branch that crosses, on one side of the known one: looked for perpendicular
/// to it and at slants.
std::optional<curve_point> first_across(const branch_equation& equation,
                                        const Eigen::VectorXd& from, const Eigen::VectorXd& across,
                                        const Eigen::VectorXd& along, const follow_limits& limits) {
    constexpr std::array slants{0.0, 0.6, -0.6, 1.1, -1.1};  // radians
    for (const double share : first_steps) {
        const double length = share * limits.step;
        for (const double slant : slants) {
            const Eigen::VectorXd direction = std::cos(slant) * across + std::sin(slant) * along;
            const auto point = step_along(equation, from, direction, length).point;
            if (!point) continue;
            const Eigen::VectorXd moved = point->unknowns - from;
            const bool is_off = moved.dot(across) > 0.3 * length;  // the known branch
            if (is_off && moved.norm() < 2.0 * length) return point;
        }
    }
    return std::nullopt;
}

/// Direction in the unknowns in which the two points of the doubled orbit part.
Eigen::VectorXd parting_direction(const branch_equation& equation, const special_point& flip) {
    const Eigen::VectorXd& unknowns = flip.orbit.unknowns;
    const Eigen::Index n = unknowns.size() - 1;
    // DP + 1 in the scaled unknowns, from the scaled Jacobian of P - 1
    const Eigen::MatrixXd jacobian = equation.at(unknowns).jacobian.leftCols(n);
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(n + 1);
    direction.head(n) = null_vector(jacobian + 2.0 * Eigen::MatrixXd::Identity(n, n));
    return direction;
}

}  // namespace

std::optional<branch> doubled_branch(const branch_family& family, int period,
                                     const special_point& flip, const follow_limits& limits) {
    const branch_equation single(family, period);
    const branch_equation doubled(family, 2 * period);
    const Eigen::VectorXd& from = flip.orbit.unknowns;
    const Eigen::VectorXd direction = parting_direction(single, flip);
    for (const double share : first_steps) {
        const double length = share * limits.step;
        const auto point = step_along(doubled, from, direction, length).point;
        if (!point || (point->unknowns - from).norm() > 2.0 * length) continue;
        const equation_value half = single.at(point->unknowns);
        if (!half.is_ok() || half.residual.norm() < length)
            continue;  // the orbit of half the period
        branch found = follow(doubled, *point, limits);
        found.orbits.insert(found.orbits.begin(), describe(doubled, {from, direction}));
        for (special_point& special : found.special) ++special.position;
        found.first = {branch_end::start, ""};
        return found;
    }
    return std::nullopt;
}

std::vector<branch> crossing_branches(const branch_family& family, int period,
                                      const special_point& crossing, const follow_limits& limits) {
    std::vector<branch> found;
    const branch_equation equation(family, period);
    const Eigen::VectorXd& from = crossing.orbit.unknowns;
    const equation_value value = equation.at(from);
    if (!value.is_ok()) return found;
    const Eigen::Index n = from.size();
    Eigen::MatrixXd bordered(n, n);
    bordered << value.jacobian, crossing.tangent.transpose();
    const Eigen::VectorXd across = null_vector(bordered);
    for (const double sign : {1.0, -1.0}) {
        const auto point = first_across(equation, from, sign * across, crossing.tangent, limits);
        if (!point) continue;
        branch piece = follow(equation, *point, limits);
        piece.first = {branch_end::start, ""};
        found.push_back(std::move(piece));
    }
    return found;
}

}  // namespace hopscotch
