// The integrator's event search on polynomials whose zeros are known: nothing is missed inside a
// step.
#include "kernels/integrators/first_zero.hpp"

#include "analysis/truth/real50.hpp"
#include "kernels/lanes/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

namespace hopscotch {
namespace {

using taylor::divide_out_zeros;
using taylor::first_zero;
using taylor::series;

/// scale times the product of (root - t), lowest power first.
template <class Real>
series<Real> with_roots(std::initializer_list<double> roots, double scale = 1.0) {
    series<Real> a;
    for (Real& c : a.c) c = Real(0.0);
    a.c[0] = Real(scale);
    int degree = 0;
    for (const double root : roots) {
        for (int n = ++degree; n >= 0; --n) {
            a.c[n] = Real(root) * a.c[n] - (n > 0 ? a.c[n - 1] : Real(0.0));
        }
    }
    return a;
}

TEST(first_zero, resolves_zeros_of_third_order_and_close_triples) {
    // the curvature's bound alone would take 1e5 steps to come within 1e-5 of them
    for (const double gap : {0.0, 1e-9, 1e-6, 1e-4}) {
        for (const double next : {1.9, 40.0}) {
            const series<double> guard =
                with_roots<double>({1.3, 1.3 + gap, 1.3 + 2.0 * gap, next});
            const auto answer = first_zero(guard, 2.0, true);
            EXPECT_TRUE(answer.found) << gap;
            EXPECT_FALSE(answer.unresolved) << gap;
            EXPECT_NEAR(answer.time, 1.3, 1e-4) << gap;  // cube root of the value's noise
        }
    }
    const auto wide = first_zero(with_roots<real50>({1.3, 1.3, 1.3, 1.9}), real50(2.0), true);
    EXPECT_TRUE(wide.found);
    EXPECT_LT(std::abs(to_double(wide.time - real50(1.3))), 1e-15);
}

TEST(first_zero, finds_the_first_of_two_crossings_inside_one_step) {
    const auto answer = first_zero(with_roots<double>({0.3, 0.3001, 2.0}), 1.0, true);
    EXPECT_TRUE(answer.found);
    EXPECT_NEAR(answer.time, 0.3, 1e-11);  // rounding of the coefficients over the small slope 2e-4
}

TEST(first_zero, sees_a_touch_and_passes_a_near_miss) {
    EXPECT_TRUE(first_zero(with_roots<double>({0.5, 0.5}), 1.0, true).found);
    series<double> miss = with_roots<double>({0.5, 0.5});
    miss.c[0] += 1e-14;
    const auto answer = first_zero(miss, 1.0, true);
    EXPECT_FALSE(answer.found);
    EXPECT_FALSE(answer.unresolved);
}

TEST(first_zero, finds_an_event_at_the_last_ulp_of_the_step_and_leaves_one_after_it) {
    EXPECT_TRUE(first_zero(with_roots<double>({0.75}), 0.75, true).found);
    EXPECT_TRUE(first_zero(with_roots<double>({std::nextafter(0.75, 0.0)}), 0.75, true).found);
    EXPECT_FALSE(first_zero(with_roots<double>({std::nextafter(0.75, 1.0)}), 0.75, true).found);
}

TEST(first_zero, reports_an_event_that_the_last_step_left_behind) {
    const auto answer = first_zero(with_roots<double>({-1e-16, 3.0}), 1.0, true);
    EXPECT_TRUE(answer.found);
    EXPECT_EQ(answer.time, 0.0);
}

TEST(first_zero, does_not_fire_again_on_the_zero_it_starts_from) {
    // guard = t (0.4 - t): just fired at 0, fires again at 0.4, whole arc inside the step
    series<double> guard = with_roots<double>({0.0, 0.4}, -1.0);
    divide_out_zeros(guard, 1.0);
    const auto answer = first_zero(guard, 1.0, true);
    EXPECT_TRUE(answer.found);
    EXPECT_NEAR(answer.time, 0.4, 1e-15);
    series<double> short_arc = with_roots<double>({0.0, 1e-9}, -1.0);
    divide_out_zeros(short_arc, 1.0);
    EXPECT_NEAR(first_zero(short_arc, 1.0, true).time, 1e-9, 1e-24);
}

TEST(first_zero, ignores_guards_that_rise_from_positive) {
    EXPECT_FALSE(first_zero(with_roots<double>({-0.5}, -1.0), 1.0, true).found);
}

TEST(first_zero, finds_the_zero_of_a_guard_that_falls_all_the_time_however_flat_it_is_there) {
    // (1 - t)((t - 1)^2 + d^2): slope -d^2 at its only zero, 3 + d^2 at the start
    for (const double d : {1.0, 0.5, 0.1, 1e-2, 1e-3}) {
        series<double> guard{};
        guard.c[0] = 1.0 + d * d;
        guard.c[1] = -(3.0 + d * d);
        guard.c[2] = 3.0;
        guard.c[3] = -1.0;
        // of the value, four roundings of its terms, over the slope
        const double rounding = 32.0 * 0x1p-53 / (d * d);
        for (const double horizon : {1.0 + 1e-3, 1.3, 1.9}) {
            const auto answer = first_zero(guard, horizon, true);
            EXPECT_TRUE(answer.found) << d << " " << horizon;
            EXPECT_NEAR(answer.time, 1.0, rounding) << d << " " << horizon;
        }
        EXPECT_FALSE(first_zero(guard, 1.0 - 1e-3, true).found) << d;
    }
}

TEST(first_zero, sees_two_crossings_that_bounds_cannot_exclude) {
    // falls at both ends of the step and rises between: only the first zero counts
    const auto answer = first_zero(with_roots<double>({0.2, 0.25, 0.9}), 1.0, true);
    EXPECT_TRUE(answer.found);
    EXPECT_NEAR(answer.time, 0.2, 1e-14);
    // from above zero back to above zero
    const auto pair = first_zero(with_roots<double>({0.6, 0.6001}), 1.0, true);
    EXPECT_TRUE(pair.found);
    EXPECT_NEAR(pair.time, 0.6, 1e-11);
}

TEST(first_zero, comes_to_an_end_on_what_is_not_a_number) {
    series<double> guard = with_roots<double>({0.5});
    guard.c[3] = std::nan("");
    EXPECT_FALSE(first_zero(guard, 1.0, true).unresolved);
    EXPECT_FALSE(first_zero(with_roots<double>({0.5}), std::nan(""), false).found);
}

TEST(first_zero, carries_the_derivative_of_the_event_time) {
    using number = dual<double, 1>;
    series<number> guard = with_roots<number>({0.5, 3.0});  // (0.5 - t)(3 - t) + epsilon
    guard.c[0].slope[0] = 1.0;
    const auto answer = first_zero(guard, 1.0, true);
    EXPECT_NEAR(answer.time.value, 0.5, 1e-15);
    EXPECT_NEAR(answer.time.slope[0], 1.0 / 2.5, 1e-14);  // -1 / (dguard/dt) = 1 / (3 - 0.5)
}

TEST(first_zero, keeps_fifty_digits) {
    const auto answer = first_zero(with_roots<real50>({0.3, 0.75, 3.0}), real50(1.0), true);
    EXPECT_TRUE(answer.found);
    EXPECT_TRUE(abs(answer.time - real50(0.3)) < real50(1e-55));
}

TEST(taylor_step, has_no_length_where_a_coefficient_is_not_finite) {
    series<double> a = with_roots<double>({0.5});
    a.c[taylor::order<double>] = std::nan("");
    taylor::step_length<double> size;
    size.watch(a);
    const double length = size.length(1e-14, 1.0);
    EXPECT_FALSE(length >= 0.0);
}

}  // namespace
}  // namespace hopscotch
