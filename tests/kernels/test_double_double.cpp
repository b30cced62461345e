// double_double against the 50-digit arithmetic: every operation and elementary function to its
// stated relative error, and the values at the edges.
#include "analysis/truth/decimal.hpp"
#include "tests/kernels/truth_comparison.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

using wide = double_double<double>;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double arithmetic_bound = 4.0 * 0x1p-106;  // a few units of 2^-106 each
constexpr double function_bound = 1e-30;  // the docblocks' figure; 7e-32 is the largest seen

/// A double_double with a random low part.
wide with_low_part(argument_source& source, double high) {
    const double ulp = std::nextafter(std::fabs(high), inf) - std::fabs(high);
    return {high, source.uniform(-0.49, 0.49) * ulp};
}

double relative_error(const wide& got, const real50& want) {
    return to_double(abs(to_real50(got) / want - 1.0));
}

template <class Function>
double worst_relative_error(argument_source& source, const std::vector<double>& arguments,
                            const Function& function) {
    double worst = 0.0;
    for (const double high : arguments) {
        const wide x = with_low_part(source, high);
        const double error = relative_error(function(x), function(to_real50(x)));
        if (!(error <= worst)) worst = error;
    }
    return worst;
}

TEST(double_double, sums_products_and_quotients_are_right_to_a_few_units_of_2_to_the_minus_106) {
    argument_source source;
    for (int i = 0; i < 4000; ++i) {
        const wide a = with_low_part(source, source.magnitude(1e-6, 1e6));
        const wide b = with_low_part(source, source.magnitude(1e-6, 1e6));
        const real50 x = to_real50(a);
        const real50 y = to_real50(b);
        EXPECT_LT(relative_error(a + b, x + y), arithmetic_bound);
        EXPECT_LT(relative_error(a - b, x - y), arithmetic_bound);
        EXPECT_LT(relative_error(a * b, x * y), 2.0 * arithmetic_bound);
        EXPECT_LT(relative_error(a / b, x / y), 3.0 * arithmetic_bound);
        EXPECT_LT(relative_error(sqrt(abs(a)), sqrt(abs(x))), 2.0 * arithmetic_bound);
    }
}

TEST(double_double, sums_stay_right_when_almost_everything_cancels) {
    argument_source source;
    for (int i = 0; i < 2000; ++i) {
        const wide a = with_low_part(source, source.magnitude(0.1, 10.0));
        const wide b{-std::nextafter(a.high, i % 2 == 0 ? inf : a.high),
                     source.uniform(-1e-17, 1e-17)};
        EXPECT_LT(relative_error(a + b, to_real50(a) + to_real50(b)), arithmetic_bound);
    }
}

TEST(double_double, circular_functions_have_thirty_digits) {
    argument_source source;
    for (const auto& x : {source.dense(-7.0, 7.0, 400), source.magnitudes(1e-9, 0x1p40, 400)}) {
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return sin(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return cos(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return tan(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return atan(a); }),
                  function_bound);
    }
    for (const auto& x : {source.dense(-1.0, 1.0, 400), source.magnitudes(1e-9, 1.0, 200),
                          source.dense(0.9999, 1.0, 200)}) {
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return asin(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return acos(a); }),
                  function_bound);
    }
}

TEST(double_double, sine_and_cosine_keep_relative_accuracy_next_to_every_quarter_turn) {
    for (const double x : next_to_quarter_turns(1500, 1e12)) {
        ASSERT_LT(relative_error(sin(wide(x)), sin(real50(x))), function_bound) << x;
        ASSERT_LT(relative_error(cos(wide(x)), cos(real50(x))), function_bound) << x;
    }
    const wide turn =
        pi<wide>();  // its sine is the rest of pi beyond 106 bits: a few digits are left
    EXPECT_LT(relative_error(sin(turn), sin(to_real50(turn))), function_bound);
}

TEST(double_double, angles_have_thirty_digits_in_all_quadrants) {
    argument_source source;
    for (int i = 0; i < 1000; ++i) {
        const wide y = with_low_part(source, source.magnitude(1e-8, 1e8));
        const wide x = with_low_part(source, source.magnitude(1e-8, 1e8));
        ASSERT_LT(relative_error(atan2(y, x), atan2(to_real50(y), to_real50(x))), function_bound);
    }
    EXPECT_TRUE(atan2(wide(0.0), wide(-1.0)) == pi<wide>());
    EXPECT_TRUE(atan2(wide(-2.0), wide(0.0)) == -half_pi<wide>());
    EXPECT_TRUE(atan2(wide(inf), wide(inf)) == quarter_pi<wide>());
    EXPECT_TRUE(atan2(wide(-0.0), wide(-3.0)) == -pi<wide>());
    EXPECT_EQ(atan2(wide(0.0), wide(0.0)).high, 0.0);
}

TEST(double_double, exponentials_and_logarithms_have_thirty_digits) {
    argument_source source;
    for (const auto& x : {source.dense(-600.0, 700.0, 400), source.magnitudes(1e-9, 1.0, 400)}) {
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return exp(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return expm1(a); }),
                  function_bound);
    }
    const auto log_of_size = [](const auto& a) { return log(abs(a)); };
    for (const auto& x : {source.magnitudes(1e-250, 1e250, 400), source.dense(0.5, 2.0, 400),
                          source.dense(0.9999, 1.0001, 200)}) {
        EXPECT_LT(worst_relative_error(source, x, log_of_size), function_bound);
    }
    // where the double's logarithm of the reduced argument is just about half of ln 2
    for (const double power : {1.0, 2.0, 0x1p-30}) {
        for (const double x : {0x1.6a09e667f3bcbp+0, 0x1.6a09e667f3bccp+0, 0x1.6a09e667f3bcdp+0,
                               0x1.6a09e667f3bcep+0, 0x1.6a09e667f3bcfp+0}) {
            EXPECT_LT(relative_error(log(wide(x * power)), log(real50(x * power))), function_bound);
            EXPECT_LT(relative_error(exp(log(wide(x))), real50(x)), function_bound);
        }
    }
    for (const auto& x : {source.magnitudes(1e-9, 0.999, 400), source.dense(0.0, 9.0, 400)}) {
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return log1p(a); }),
                  function_bound);
    }
}

TEST(double_double, hyperbolic_functions_and_cube_root_have_thirty_digits) {
    argument_source source;
    for (const auto& x : {source.magnitudes(1e-9, 700.0, 400), source.dense(-2.0, 2.0, 400)}) {
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return sinh(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return cosh(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return tanh(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return asinh(a); }),
                  function_bound);
        EXPECT_LT(worst_relative_error(source, x, [](const auto& a) { return cbrt(a); }),
                  function_bound);
    }
    EXPECT_LT(worst_relative_error(source, source.magnitudes(1e-9, 0.9999, 400),
                                   [](const auto& a) { return atanh(a); }),
              function_bound);
}

TEST(double_double, rounds_to_integers_by_both_parts) {
    EXPECT_TRUE(floor(wide(3.0, -1e-20)) == wide(2.0));
    EXPECT_TRUE(floor(wide(3.0, 1e-20)) == wide(3.0));
    EXPECT_TRUE(floor(wide(-2.5, 1e-20)) == wide(-3.0));
    EXPECT_TRUE(floor(wide(0x1p60, -0.25)) == wide(0x1p60, -1.0));
    EXPECT_TRUE(nearest(wide(2.5, 1e-20)) == wide(3.0));
    EXPECT_TRUE(nearest(wide(2.5, 0.0)) == wide(2.0));
    EXPECT_TRUE(nearest(wide(3.5, -1e-20)) == wide(3.0));
    EXPECT_TRUE(nearest(wide(-2.5, -1e-20)) == wide(-3.0));
    EXPECT_TRUE(nearest(wide(0x1p60, 0.75)) == wide(0x1p60, 1.0));
}

TEST(double_double, orders_by_both_parts) {
    const wide low(1.0, -1e-20);
    const wide high(1.0, 1e-20);
    EXPECT_TRUE((low < high) & (low <= high) & (high > low) & (high >= low));
    EXPECT_FALSE((low == high) | (high < low) | (high <= low));
    EXPECT_TRUE(abs(wide(-1.0, 1e-20)) == wide(1.0, -1e-20));
    EXPECT_TRUE(copysign(wide(1.0, 1e-20), wide(-3.0)) == wide(-1.0, -1e-20));
    EXPECT_TRUE(select(low < high, low, high) == low);
    EXPECT_EQ(to_double(high), 1.0);
}

TEST(double_double, infinities_stay_infinite_instead_of_turning_into_nan) {
    const wide never(inf);
    for (const wide& x :
         {never + 1.0, never * 2.0, never - 5.0, wide(1.0) / wide(0.0), sqrt(never), exp(never),
          exp(wide(1000.0)), log(never), sinh(wide(800.0)), cosh(-never), floor(never),
          nearest(never), abs(-never), asinh(never), cbrt(never), expm1(never), atanh(wide(1.0)),
          -log(wide(0.0)), -log1p(wide(-1.0))}) {
        EXPECT_EQ(x.high, inf);
        EXPECT_EQ(x.low, 0.0);
    }
    for (const wide& x : {wide(1.0) / never, exp(-never), sqrt(wide(0.0)), cbrt(wide(0.0)),
                          wide(0.0) / wide(3.0), acos(wide(1.0)), sin(wide(0.0)), log(wide(1.0))}) {
        EXPECT_EQ(x.high, 0.0);
        EXPECT_EQ(x.low, 0.0);
    }
    EXPECT_TRUE(tanh(never) == wide(1.0));
    EXPECT_TRUE(atan(never) == half_pi<wide>());
    EXPECT_TRUE(expm1(-never) == wide(-1.0));
    for (const wide& x :
         {sqrt(wide(-1.0)), log(wide(-1.0)), sin(never), acos(wide(2.0)), never - never}) {
        EXPECT_TRUE(std::isnan(x.high));
    }
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET
