// The elementary functions on double: errors in ulp against 50 digits, and the special values.
// Bounds are those of the docblocks; the largest errors seen in 10^6 samples lie 0.01 to 0.1 below
// them.
#include "kernels/elementary/elementary.hpp"
#include "tests/kernels/truth_comparison.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hopscotch::inline HOPSCOTCH_TARGET {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double tiny = std::numeric_limits<double>::denorm_min();
constexpr double smallest_normal = std::numeric_limits<double>::min();
constexpr double largest = std::numeric_limits<double>::max();

const auto sine = [](const auto& x) { return sin(x); };
const auto cosine = [](const auto& x) { return cos(x); };
const auto tangent = [](const auto& x) { return tan(x); };
const auto exponential = [](const auto& x) { return exp(x); };
const auto exponential_minus_one = [](const auto& x) { return expm1(x); };
const auto logarithm = [](const auto& x) { return log(x); };
const auto logarithm_of_one_plus = [](const auto& x) { return log1p(x); };
const auto arc_tangent = [](const auto& x) { return atan(x); };
const auto arc_sine = [](const auto& x) { return asin(x); };
const auto arc_cosine = [](const auto& x) { return acos(x); };
const auto hyperbolic_sine = [](const auto& x) { return sinh(x); };
const auto hyperbolic_cosine = [](const auto& x) { return cosh(x); };
const auto hyperbolic_tangent = [](const auto& x) { return tanh(x); };
const auto area_sine = [](const auto& x) { return asinh(x); };
const auto area_tangent = [](const auto& x) { return atanh(x); };
const auto cube_root = [](const auto& x) { return cbrt(x); };

/// Same bits; any NaN equals any other.
void expect_same(double got, double want) {
    if (std::isnan(want)) {
        EXPECT_TRUE(std::isnan(got)) << got;
    } else {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(got), std::bit_cast<std::uint64_t>(want))
            << got << " instead of " << want;
    }
}

TEST(elementary, sine_and_cosine_stay_within_0_9_ulp_up_to_2_to_the_40) {
    argument_source source;
    for (const auto& x : {source.dense(-4.0, 4.0, 6000), source.dense(0.5, 0.8, 6000),
                          source.dense(-1e3, 1e3, 3000), source.magnitudes(1e-8, 0x1p40, 6000),
                          source.magnitudes(1e-300, 1e-3, 300)}) {
        EXPECT_LE(worst_error(sine, x), 0.9);
        EXPECT_LE(worst_error(cosine, x), 0.9);
    }
}

TEST(elementary, sine_and_cosine_keep_relative_accuracy_next_to_every_quarter_turn) {
    const std::vector<double> x = next_to_quarter_turns(6000, 0x1p40);
    EXPECT_LE(worst_error(sine, x), 0.9);
    EXPECT_LE(worst_error(cosine, x), 0.9);
    EXPECT_LE(worst_error(tangent, x), 1.0);
}

TEST(elementary, sine_and_cosine_come_as_the_same_pair) {
    argument_source source;
    for (const double x : source.magnitudes(1e-3, 1e3, 1000)) {
        expect_same(sin(x), sin_cos(x).sin);
        expect_same(cos(x), sin_cos(x).cos);
    }
}

TEST(elementary, sine_keeps_the_sign_of_zero_and_tiny_arguments) {
    for (const double x : {0.0, -0.0, tiny, -tiny, smallest_normal, -smallest_normal, 1e-300}) {
        expect_same(sin(x), x);
        expect_same(tan(x), x);
        expect_same(cos(x), 1.0);
    }
}

TEST(elementary, sine_beyond_2_to_the_40_is_not_a_number) {
    for (const double x : {0x1p40 + 1.0, -0x1p41, 1e300, inf, -inf, nan}) {
        expect_same(sin(x), nan);
        expect_same(cos(x), nan);
        expect_same(tan(x), nan);
    }
    EXPECT_LE(worst_error(sine, {0x1p40, -0x1p40}), 0.9);
}

TEST(elementary, tangent_stays_within_1_ulp) {
    argument_source source;
    EXPECT_LE(worst_error(tangent, source.dense(-4.0, 4.0, 6000)), 1.0);
    EXPECT_LE(worst_error(tangent, source.dense(0.6, 0.9, 6000)), 1.0);
    EXPECT_LE(worst_error(tangent, source.magnitudes(1e-8, 0x1p40, 6000)), 1.0);
}

TEST(elementary, exponential_stays_within_0_7_ulp_where_the_result_is_normal) {
    argument_source source;
    EXPECT_LE(worst_error(exponential, source.dense(-708.3, 709.7, 6000)), 0.7);
    EXPECT_LE(worst_error(exponential, source.dense(-1.0, 1.0, 6000)), 0.7);
    EXPECT_LE(worst_error(exponential, source.magnitudes(1e-20, 1.0, 1000)), 0.7);
}

TEST(elementary, exponential_underflows_gradually_and_overflows_to_infinity) {
    argument_source source;
    // rounded to 53 bits and then to the denormal's fewer
    EXPECT_LE(worst_error(exponential, source.dense(-746.0, -708.3, 3000)), 1.0);
    expect_same(exp(709.782712893384), exponential(709.782712893384));
    EXPECT_TRUE(exp(709.782712893384) <= largest);
    expect_same(exp(709.782712893385), inf);
    expect_same(exp(-745.2), 0.0);
    expect_same(exp(inf), inf);
    expect_same(exp(-inf), 0.0);
    expect_same(exp(nan), nan);
    expect_same(exp(-0.0), 1.0);
}

TEST(elementary, exponential_minus_one_stays_within_1_2_ulp) {
    argument_source source;
    EXPECT_LE(worst_error(exponential_minus_one, source.dense(-1.0, 1.0, 6000)), 1.2);
    EXPECT_LE(worst_error(exponential_minus_one, source.dense(0.345, 0.37, 6000)), 1.2);
    EXPECT_LE(worst_error(exponential_minus_one, source.magnitudes(1e-20, 709.7, 6000)), 1.2);
    for (const double x : {0.0, -0.0, tiny, -tiny, smallest_normal}) expect_same(expm1(x), x);
    expect_same(expm1(inf), inf);
    expect_same(expm1(710.0), inf);
    expect_same(expm1(-inf), -1.0);
    expect_same(expm1(-1e9), -1.0);
    expect_same(expm1(nan), nan);
}

TEST(elementary, logarithm_stays_within_0_9_ulp_denormals_included) {
    argument_source source;
    EXPECT_LE(worst_error(logarithm, source.dense(0.5, 2.0, 6000)), 0.9);
    EXPECT_LE(worst_error(logarithm, source.dense(1.38, 1.4143, 6000)), 0.9);
    EXPECT_LE(worst_error(logarithm, source.dense(0.999, 1.001, 2000)), 0.9);
    std::vector<double> any = source.magnitudes(1e-307, 1e307, 3000);
    for (double& x : any) x = std::fabs(x);
    EXPECT_LE(worst_error(logarithm, any), 0.9);
    EXPECT_LE(worst_error(logarithm, {tiny, 3.0 * tiny, 1e-310, smallest_normal, largest, 1.0}),
              0.9);
}

TEST(elementary, logarithm_of_zero_negative_and_infinite_numbers) {
    for (const double zero : {0.0, -0.0}) expect_same(log(zero), -inf);
    for (const double x : {-1.0, -tiny, -inf, nan}) expect_same(log(x), nan);
    expect_same(log(inf), inf);
    expect_same(log(1.0), 0.0);
}

TEST(elementary, logarithm_of_one_plus_stays_within_0_9_ulp) {
    argument_source source;
    EXPECT_LE(worst_error(logarithm_of_one_plus, source.dense(-0.9999, 3.0, 6000)), 0.9);
    EXPECT_LE(worst_error(logarithm_of_one_plus, source.dense(-0.31, -0.27, 3000)), 0.9);
    EXPECT_LE(worst_error(logarithm_of_one_plus, source.dense(0.38, 0.43, 3000)), 0.9);
    EXPECT_LE(worst_error(logarithm_of_one_plus, source.magnitudes(1e-20, 0.99, 3000)), 0.9);
    std::vector<double> large = source.magnitudes(1.0, 1e300, 2000);
    for (double& x : large) x = std::fabs(x);
    EXPECT_LE(worst_error(logarithm_of_one_plus, large), 0.9);
    for (const double x : {0.0, -0.0, tiny, -tiny, smallest_normal}) expect_same(log1p(x), x);
    expect_same(log1p(-1.0), -inf);
    for (const double x : {-1.5, -inf, nan}) expect_same(log1p(x), nan);
    expect_same(log1p(inf), inf);
}

TEST(elementary, arc_tangent_stays_within_0_85_ulp) {
    argument_source source;
    EXPECT_LE(worst_error(arc_tangent, source.dense(-3.0, 3.0, 6000)), 0.85);
    EXPECT_LE(worst_error(arc_tangent, source.dense(0.35, 0.55, 6000)), 0.85);
    EXPECT_LE(worst_error(arc_tangent, source.magnitudes(1e-20, 1e20, 3000)), 0.85);
    for (const double x : {0.0, -0.0, tiny, -tiny, smallest_normal}) expect_same(atan(x), x);
    for (const double x : {1e20, 1e300, largest, inf}) {
        expect_same(atan(x), half_pi<double>());
        expect_same(atan(-x), -half_pi<double>());
    }
    expect_same(atan(nan), nan);
}

TEST(elementary, two_argument_arc_tangent_stays_within_0_85_ulp_in_all_quadrants) {
    argument_source source;
    double worst = 0.0;
    for (int i = 0; i < 12000; ++i) {
        const double size = i < 6000 ? 1.0 : source.magnitude(1e-200, 1e200);
        const double y = size * source.uniform(-1.0, 1.0);
        const double x =
            i % 3 == 0 ? size * source.magnitude(1e-9, 1e9) : size * source.uniform(-1.0, 1.0);
        worst = std::fmax(worst, error_in_ulp(atan2(y, x), atan2(real50(y), real50(x))));
    }
    EXPECT_LE(worst, 0.85);
}

TEST(elementary, two_argument_arc_tangent_on_axes_zeros_and_infinities) {
    const double turn = pi<double>();
    const double quarter = half_pi<double>();
    for (const double x : {0.0, 1.0, inf}) expect_same(atan2(0.0, x), 0.0);
    for (const double x : {0.0, 1.0, inf}) expect_same(atan2(-0.0, x), -0.0);
    for (const double x : {-0.0, -1.0, -inf}) expect_same(atan2(0.0, x), turn);
    for (const double x : {-0.0, -1.0, -inf}) expect_same(atan2(-0.0, x), -turn);
    for (const double y : {tiny, 1.0, inf}) expect_same(atan2(y, 0.0), quarter);
    for (const double y : {tiny, 1.0, inf}) expect_same(atan2(-y, -0.0), -quarter);
    expect_same(atan2(1.0, inf), 0.0);
    expect_same(atan2(1.0, -inf), turn);
    expect_same(atan2(-inf, 1e308), -quarter);
    expect_same(atan2(inf, inf), quarter_pi<double>());
    expect_same(atan2(inf, -inf), 3.0 * quarter_pi<double>());
    expect_same(atan2(-inf, -inf), -3.0 * quarter_pi<double>());
    for (const double other : {0.0, 1.0, inf}) {
        expect_same(atan2(nan, other), nan);
        expect_same(atan2(other, nan), nan);
    }
    for (const double size : {tiny, smallest_normal, largest}) {
        expect_same(atan2(size, size), quarter_pi<double>());
    }
    expect_same(atan2(smallest_normal, largest), 0.0);
}

TEST(elementary, arc_sine_and_arc_cosine_stay_within_1_ulp) {
    argument_source source;
    for (const auto& x : {source.dense(-1.0, 1.0, 6000), source.dense(0.35, 0.45, 3000),
                          source.dense(0.9, 0.95, 3000), source.dense(0.999, 1.0, 2000),
                          source.magnitudes(1e-20, 1.0, 3000)}) {
        EXPECT_LE(worst_error(arc_sine, x), 1.0);
        EXPECT_LE(worst_error(arc_cosine, x), 1.0);
    }
    for (const double x : {0.0, -0.0, tiny, -tiny}) expect_same(asin(x), x);
    expect_same(asin(1.0), half_pi<double>());
    expect_same(asin(-1.0), -half_pi<double>());
    expect_same(acos(1.0), 0.0);
    expect_same(acos(-1.0), pi<double>());
    expect_same(acos(0.0), half_pi<double>());
    for (const double x : {std::nextafter(1.0, 2.0), -2.0, inf, nan}) {
        expect_same(asin(x), nan);
        expect_same(acos(x), nan);
    }
}

TEST(elementary, hyperbolic_functions_stay_within_1_ulp) {
    argument_source source;
    for (const auto& x : {source.dense(-3.0, 3.0, 4000), source.dense(0.15, 0.4, 4000),
                          source.magnitudes(1e-20, 710.4, 4000)}) {
        EXPECT_LE(worst_error(hyperbolic_sine, x), 1.0);
        EXPECT_LE(worst_error(hyperbolic_cosine, x), 0.7);
        EXPECT_LE(worst_error(hyperbolic_tangent, x), 1.0);
    }
    for (const double x : {0.0, -0.0, tiny, -tiny}) {
        expect_same(sinh(x), x);
        expect_same(tanh(x), x);
        expect_same(cosh(x), 1.0);
    }
    for (const double x : {711.0, inf}) {
        expect_same(sinh(x), inf);
        expect_same(sinh(-x), -inf);
        expect_same(cosh(-x), inf);
        expect_same(tanh(-x), -1.0);
    }
    for (const double result : {sinh(nan), cosh(nan), tanh(nan)}) expect_same(result, nan);
}

TEST(elementary, inverse_hyperbolic_functions_stay_within_0_9_ulp) {
    argument_source source;
    for (const auto& x : {source.dense(-3.0, 3.0, 4000), source.dense(0.2, 0.4, 4000),
                          source.magnitudes(1e-20, 1e300, 4000)}) {
        EXPECT_LE(worst_error(area_sine, x), 0.9);
    }
    for (const auto& x : {source.dense(-1.0, 1.0, 4000), source.dense(0.1, 0.22, 4000),
                          source.magnitudes(1e-20, 1.0, 4000)}) {
        EXPECT_LE(worst_error(area_tangent, x), 0.9);
    }
    for (const double x : {0.0, -0.0, tiny, -tiny}) {
        expect_same(asinh(x), x);
        expect_same(atanh(x), x);
    }
    expect_same(asinh(-inf), -inf);
    expect_same(atanh(1.0), inf);
    expect_same(atanh(-1.0), -inf);
    for (const double result : {asinh(nan), atanh(nan), atanh(1.5)}) expect_same(result, nan);
}

TEST(elementary, cube_root_stays_within_0_51_ulp_denormals_included) {
    argument_source source;
    EXPECT_LE(worst_error(cube_root, source.dense(-8.0, 8.0, 6000)), 0.51);
    EXPECT_LE(worst_error(cube_root, source.magnitudes(1e-307, 1e308, 6000)), 0.51);
    EXPECT_LE(worst_error(cube_root, {tiny, -3.0 * tiny, 1e-310, smallest_normal, largest}), 0.51);
    for (const double root : {1.0, 2.0, 3.0, -5.0, 1e5})
        expect_same(cbrt(root * root * root), root);
    for (const double x : {0.0, -0.0, inf, -inf, nan}) expect_same(cbrt(x), x);
}

}  // namespace
}  // namespace hopscotch::inline HOPSCOTCH_TARGET
