// Dual numbers: derivatives against central differences in the 50-digit arithmetic, values bit for
// bit those of the primal, and the derivative of a root.
#include "kernels/lanes/double_double.hpp"
#include "kernels/lanes/dual.hpp"
#include "tests/kernels/truth_comparison.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

/// Derivative of a smooth generic function at x: central difference of order 2 with step 1e-16 |x|.
/// Its truncation error is about 1e-32, its rounding error about 1e-46, both relative to f / x.
template <class Function>
real50 central_difference(const Function& function, const real50& x) {
    const real50 step = abs(x) * real50("1e-16");
    return (function(x + step) - function(x - step)) / (step * 2.0);
}

/// Compares value and derivative in double and in 50 digits.
template <class Function>
void expect_derivative(const char* name, double x, const Function& function) {
    const real50 truth = central_difference(function, real50(x));
    const auto precise = function(dual<real50, 1>::variable(real50(x), 0));
    const auto quick = function(dual<double, 2>::variable(x, 1));
    const real50 scale = abs(truth) + abs(function(real50(x))) / abs(real50(x));
    EXPECT_LT(abs(precise.slope[0] - truth), scale * 1e-29) << name << " at " << x;
    // a handful of roundings of 1.1e-16 each
    EXPECT_LT(abs(real50(quick.slope[1]) - truth), scale * 3e-15) << name << " at " << x;
    EXPECT_EQ(quick.slope[0], 0.0) << name;
    EXPECT_EQ(quick.value, function(x)) << name << " at " << x;
}

TEST(dual, elementary_functions_carry_their_derivatives) {
    for (const double x : {0.05, 0.3, 0.77, 0.95}) {
        for (const double y : {x, -x}) {
            expect_derivative("sin", y, [](const auto& a) { return sin(a); });
            expect_derivative("cos", y, [](const auto& a) { return cos(a); });
            expect_derivative("tan", y, [](const auto& a) { return tan(a); });
            expect_derivative("exp", y, [](const auto& a) { return exp(a); });
            expect_derivative("expm1", y, [](const auto& a) { return expm1(a); });
            expect_derivative("log1p", y, [](const auto& a) { return log1p(a); });
            expect_derivative("atan", y, [](const auto& a) { return atan(a); });
            expect_derivative("asin", y, [](const auto& a) { return asin(a); });
            expect_derivative("acos", y, [](const auto& a) { return acos(a); });
            expect_derivative("sinh", y, [](const auto& a) { return sinh(a); });
            expect_derivative("cosh", y, [](const auto& a) { return cosh(a); });
            expect_derivative("tanh", y, [](const auto& a) { return tanh(a); });
            expect_derivative("asinh", y, [](const auto& a) { return asinh(a); });
            expect_derivative("atanh", y, [](const auto& a) { return atanh(a); });
            expect_derivative("cbrt", y, [](const auto& a) { return cbrt(a); });
            expect_derivative("abs", y, [](const auto& a) { return abs(a); });
        }
        expect_derivative("log", x, [](const auto& a) { return log(a); });
        expect_derivative("sqrt", x, [](const auto& a) { return sqrt(a); });
    }
}

TEST(dual, compositions_follow_product_quotient_and_chain_rule) {
    for (const double x : {0.4, -1.7, 3.2, 12.5}) {
        expect_derivative("rational", x, [](const auto& a) {
            return (a * a - 3.0 * a + 1.0) / (2.0 + a * a) - 1.0 / a + (-a);
        });
        expect_derivative("fma", x, [](const auto& a) { return fma(a, sin(a), a * a); });
        expect_derivative("turning pair", x, [](const auto& a) {
            const auto turn = sin_cos(a * 1.3);
            return turn.sin * turn.cos + turn.cos;
        });
        expect_derivative("angle", x, [](const auto& a) { return atan2(a * a - 1.0, a + 0.3); });
        expect_derivative("selection", x, [](const auto& a) {
            return select(a < 0.0, exp(a), log(abs(a) + 1.0)) + copysign(a * a, a);
        });
        expect_derivative("compound", x, [](auto a) {
            auto sum = a;
            sum += a * a;
            sum *= cos(a);
            sum -= 2.0 * a;
            return sum;
        });
    }
}

TEST(dual, two_argument_arc_tangent_depends_on_both) {
    using number = dual<real50, 2>;
    const double y = -0.7;
    const double x = -0.4;
    const number angle = atan2(number::variable(real50(y), 0), number::variable(real50(x), 1));
    const real50 square = real50(y) * y + real50(x) * x;
    EXPECT_LT(abs(angle.slope[0] - real50(x) / square), real50(1e-48));
    EXPECT_LT(abs(angle.slope[1] + real50(y) / square), real50(1e-48));
}

TEST(dual, steps_have_no_derivative) {
    const auto x = dual<double, 1>::variable(2.7, 0);
    EXPECT_EQ(floor(x).value, 2.0);
    EXPECT_EQ(floor(x).slope[0], 0.0);
    EXPECT_EQ(nearest(x).value, 3.0);
    EXPECT_EQ(nearest(x).slope[0], 0.0);
}

TEST(dual, a_constant_keeps_zero_slope_where_the_derivative_is_infinite) {
    const dual<double, 2> zero(0.0);
    EXPECT_EQ(sqrt(zero).slope[0], 0.0);
    EXPECT_EQ(cbrt(zero).slope[1], 0.0);
    EXPECT_EQ(acos(dual<double, 2>(1.0)).slope[0], 0.0);
    EXPECT_TRUE(sqrt(dual<double, 1>::variable(0.0, 0)).slope[0] ==
                std::numeric_limits<double>::infinity());
}

TEST(dual, comparisons_and_primal_look_at_the_value_alone) {
    const auto a = dual<double, 1>::variable(1.0, 0);
    const dual<double, 1> b(1.0);
    EXPECT_TRUE(a == b);
    EXPECT_TRUE((a <= b) & (a >= b));
    EXPECT_FALSE((a < b) | (a > b));
    EXPECT_EQ(primal(a), 1.0);
    EXPECT_EQ((pi<dual<double, 3>>().value), pi<double>());
}

/// Kepler's equation E - e sin E = M: the root's derivatives are 1 / (1 - e cos E) by M and
/// sin E / (1 - e cos E) by e.
TEST(implicit_root, carries_the_derivatives_of_the_root_and_keeps_its_value) {
    using number = dual<double, 2>;
    const number mean = number::variable(1.1, 0);
    const number eccentricity = number::variable(0.6, 1);
    double root = 1.1;
    for (int i = 0; i < 50; ++i) root -= (root - 0.6 * sin(root) - 1.1) / (1.0 - 0.6 * cos(root));
    const number residual = number(root) - eccentricity * sin(number(root)) - mean;
    const double slope = 1.0 - 0.6 * cos(root);
    const number anomaly = implicit_root(root, residual, slope);
    EXPECT_EQ(anomaly.value, root);
    EXPECT_NEAR(anomaly.slope[0], 1.0 / (1.0 - 0.6 * std::cos(root)), 1e-15);
    EXPECT_NEAR(anomaly.slope[1], std::sin(root) / (1.0 - 0.6 * std::cos(root)), 1e-15);
}

TEST(implicit_root, returns_the_root_unchanged_in_arithmetics_without_derivatives) {
    EXPECT_EQ(implicit_root(1.25, 1e-17, 2.0), 1.25);
    EXPECT_TRUE(implicit_root(real50(1.25), real50(0.0), real50(2.0)) == real50(1.25));
    using wide = double_double<double>;
    EXPECT_TRUE(implicit_root(wide(1.25), wide(0.0), wide(2.0)) == wide(1.25));
}

TEST(implicit_root, serves_generic_code_of_every_arithmetic) {
    // time at which a body thrown at speed v under gravity g comes down: 2 v / g
    const auto landing = []<class Real>(const Real& speed, const Real& gravity) {
        const primal_of<Real> time = primal(speed) * 2.0 / primal(gravity);
        const Real residual = speed - gravity * Real(time) * 0.5;
        return implicit_root(time, residual, -primal(gravity) * 0.5);
    };
    using number = dual<real50, 2>;
    const number time =
        landing(number::variable(real50(3.0), 0), number::variable(real50(9.81), 1));
    const real50 gravity(9.81);
    EXPECT_LT(abs(time.slope[0] - real50(2.0) / gravity), real50(1e-50));
    EXPECT_LT(abs(time.slope[1] + real50(6.0) / (gravity * gravity)), real50(1e-50));
    EXPECT_EQ(landing(3.0, 9.81), 3.0 * 2.0 / 9.81);
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET
