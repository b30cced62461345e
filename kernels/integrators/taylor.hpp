// The one integrator of all flows without closed form: Taylor series of fixed order, one step per
// call, lane by lane. The step's polynomial is its own dense output, and events are isolated on it
// over the whole step (kernels/integrators/first_zero.hpp). A flow brings its right-hand side as
// recurrences on coefficients; polynomial right-hand sides cost one Cauchy product per
// multiplication.
//
// Why a Taylor series and not an embedded Runge-Kutta pair of order 8. Steps per stance of the
// spring-mass runner for a lift-off error of 1e-12 (models/slip.md, section 10): series of order 22
// 4-6, DOP853 12-16 with 12 right-hand sides each and three more for its dense output, which has
// order 7 only. Measured here (linear spring, kt 2-12, one AVX-512 core, 8 lanes a register; CPU
// time per stance, median error):
//   order 16, tolerance 2^-47: 11.1 steps, 1.6 us, 4e-16      order 24: 5.4 steps, 1.04 us, 6e-16
//   order 20:                   7.1 steps, 1.4 us, 4e-16      order 28: 4.5 steps, 1.04 us, 1e-15
//   order 22:                   6.1 steps, 1.04 us, 4e-16     order 22, 2^-40: 5.0 steps, 0.87 us,
//   7e-14
// so full precision costs 20 % more than 1e-13, and the same code serves 31 and 50 digits by its
// order.
//
// What a tolerance means: a step is as long as the last two terms of every series that it carries
// stay below tolerance * (floor + |value|), floor 1/4 unless the flow says otherwise; what the step
// leaves out is of that size (half of it at 1e-10, twice at 1e-4). Measured against 50 digits,
// error of one return's state x over 1/4 + |x|, 200 starts each of slip, slip_pitching (both
// springs), raibert_pneumatic and relief_valve, in units of the tolerance: median 0.04 to 0.7 and
// worst 1 to 13 for 1e-12 ... 1e-6. Hence the user's default of 1e-10: a return is wrong by 1e-9 at
// most, an orbit is decided wrongly only within 1e-8 of a boundary
// (tests/models/test_tolerance.cpp), for 30 to 34 % fewer steps than the arithmetic's own
// tolerance. Beyond 1e-2 a step would leave the radius of convergence.
#pragma once

#include "kernels/cuda/thread_workspace.hpp"
#include "kernels/elementary/elementary.hpp"
#include "kernels/events/bracketed_root.hpp"
#include "kernels/lanes/implicit_root.hpp"

namespace hopscotch::inline HOPSCOTCH_TARGET::taylor {

/// Order of the series: high enough that a step spans a good part of the radius of convergence at
/// the arithmetic's own tolerance.
template <class Real>
inline constexpr int order = lane_traits<Real>::rounding > 0x1p-60    ? 22
                             : lane_traits<Real>::rounding > 0x1p-110 ? 36
                                                                      : 60;

/// The tolerance of full precision: 2^-47 (7e-15) in double,
/// 2^-95 (2.5e-29) in double-double, 2^-170 (7e-52) in 50 digits.
template <class Real>
inline constexpr double default_tolerance = lane_traits<Real>::rounding > 0x1p-60    ? 0x1p-47
                                            : lane_traits<Real>::rounding > 0x1p-110 ? 0x1p-95
                                                                                     : 0x1p-170;

/// The tolerance that an arithmetic works to: in double the one asked for, 0 for its own. The wider
/// arithmetics keep theirs, for they are the truth that double is measured against.
template <class Real>
HOPSCOTCH_DEVICE constexpr double tolerance_for(double asked) {
    constexpr bool is_binary64_wide = lane_traits<Real>::rounding > 0x1p-60;
    return is_binary64_wide && asked > 0.0 ? asked : default_tolerance<Real>;
}

/// Coefficients of t^0 ... t^order. A GPU thread has no stack for them where they carry
/// derivatives.
template <class Real>
struct series {
    Real c[order<Real> + 1];
};
template <class Real>
requires(lanes_are_threads && !without_derivatives<Real>) struct series<Real> {
    workspace_array<Real, order<Real> + 1> c;
};

/// The most series that are alive at once in a step of any model.
inline constexpr int most_series = 16;

/// What they take of a GPU thread's workspace.
template <class Real>
inline constexpr std::size_t workspace_bytes =
    thread_workspace<Real>::bytes(most_series*(order<Real> + 1));

/// Coefficient n of the product a b.
template <class Real>
HOPSCOTCH_DEVICE inline Real product(const series<Real>& a, const series<Real>& b, int n) {
    Real sum = a.c[0] * b.c[n];
    for (int i = 1; i <= n; ++i) sum = fma(a.c[i], b.c[n - i], sum);
    return sum;
}

/// Coefficients n and n + 1 of the product a b, as far as they are known with a and b up to n.
template <class Real>
struct two_coefficients {
    Real first;
    Real rest;  // of the second: without a_0 b_{n+1} and a_{n+1} b_0
};

/// Both sums in one pass, which loads every coefficient once for two fused operations.
///
/// \param n  even
template <class Real>
HOPSCOTCH_DEVICE inline two_coefficients<Real> products(const series<Real>& a,
                                                        const series<Real>& b, int n) {
    Real later = b.c[n];
    two_coefficients<Real> sum{a.c[0] * later, Real(0.0)};
    for (int i = 1; i <= n; ++i) {
        const Real ai = a.c[i];
        const Real now = b.c[n - i];
        sum.first = fma(ai, now, sum.first);
        sum.rest = fma(ai, later, sum.rest);
        later = now;
    }
    return sum;
}

/// Coefficient n of the product, where `rest` is what `products` left of it.
template <class Real>
HOPSCOTCH_DEVICE inline Real completed(const Real& rest, const series<Real>& a,
                                       const series<Real>& b, int n) {
    return fma(a.c[n], b.c[0], fma(a.c[0], b.c[n], rest));
}

/// Coefficient n of a^2.
template <class Real>
HOPSCOTCH_DEVICE inline Real square(const series<Real>& a, int n) {
    if (n == 0) return a.c[0] * a.c[0];
    Real sum = a.c[0] * a.c[n];
    for (int i = 1; 2 * i < n; ++i) sum = fma(a.c[i], a.c[n - i], sum);
    const Real twice = sum + sum;
    return n % 2 == 0 ? fma(a.c[n / 2], a.c[n / 2], twice) : twice;
}

/// 1/n, n = 0 ... 22: divisions of single numbers would hold a pack up.
HOPSCOTCH_DEVICE inline double reciprocal(int n) {
    static constexpr double reciprocals[] = {
        0.0,        1.0,        1.0 / 2.0,  1.0 / 3.0,  1.0 / 4.0,  1.0 / 5.0,
        1.0 / 6.0,  1.0 / 7.0,  1.0 / 8.0,  1.0 / 9.0,  1.0 / 10.0, 1.0 / 11.0,
        1.0 / 12.0, 1.0 / 13.0, 1.0 / 14.0, 1.0 / 15.0, 1.0 / 16.0, 1.0 / 17.0,
        1.0 / 18.0, 1.0 / 19.0, 1.0 / 20.0, 1.0 / 21.0, 1.0 / 22.0};
    return reciprocals[n];
}

/// x / n for the recurrences a_n = x / n.
template <class Real>
HOPSCOTCH_DEVICE inline Real over(const Real& x, int n) {
    if constexpr (lane_traits<Real>::rounding > 0x1p-60) {
        return x * Real(reciprocal(n));
    } else {
        return x / Real(static_cast<double>(n));
    }
}

/// The polynomial at t.
template <class Real, class Time>
HOPSCOTCH_DEVICE inline Real evaluate(const series<Real>& a, const Time& t) {
    const Real at(t);
    Real sum = a.c[order<Real>];
    for (int n = order<Real> - 1; n >= 0; --n) sum = fma(sum, at, a.c[n]);
    return sum;
}

/// What a polynomial adds to its value at 0, over t.
template <class Real, class Time>
HOPSCOTCH_DEVICE inline Real mean_rate(const series<Real>& a, const Time& t) {
    const Real at(t);
    Real sum = a.c[order<Real>];
    for (int n = order<Real> - 1; n >= 1; --n) sum = fma(sum, at, a.c[n]);
    return sum;
}

/// The same polynomial without derivatives.
template <without_derivatives Real>
HOPSCOTCH_DEVICE inline const series<Real>& primal_series(const series<Real>& a) {
    return a;
}
template <class Real>
HOPSCOTCH_DEVICE inline series<primal_of<Real>> primal_series(const series<Real>& a) {
    series<primal_of<Real>> result;
    for (int n = 0; n <= order<Real>; ++n) result.c[n] = primal(a.c[n]);
    return result;
}

/// x^(1/n), good to 2e-4: the length of a step need not be better known.
///
/// \param x  > 0; 0 and infinity give a number below 2^-40 and above 2^40 for n < 24
template <class Real>
HOPSCOTCH_DEVICE inline Real rough_root(const Real& x, int n) {
    if constexpr (binary64_lane<Real>) {
        // cubics through log2 on (1, 2) and 2^x on (0, 1), errors 8e-4 and 1.1e-4
        const Real logarithm =
            exponent(x) + polynomial(mantissa(x), -2.136232, 3.011162, -1.026805, 0.1527003);
        const Real power = over(logarithm, n);
        const Real whole = floor(power);
        return polynomial(power - whole, 0.9999003, 0.6963248, 0.2246932, 0.07896726) *
               power_of_two(whole);
    } else {
        return exp(over(log(x), n));
    }
}

/// Collects the tails of the series that a step carries and turns them into its length.
template <class Real>
class step_length {
public:
    /// Takes account of a variable; its error is measured against floor + |value at the start|.
    HOPSCOTCH_DEVICE void watch(const series<Real>& a, double floor = 0.25) {
        const plain per_scale = plain(1.0) / (plain(floor) + abs(primal(a.c[0])));
        const plain last = abs(primal(a.c[order<Real>]));
        const plain before_last = abs(primal(a.c[order<Real> - 1]));
        last_ = larger(last_, last * per_scale);
        before_last_ = larger(before_last_, before_last * per_scale);
        doubtful_ = doubtful_ + (last + before_last) * plain(0.0);
    }

    /// The longest step whose last two terms stay below the tolerance, at most `longest`; NaN where
    /// a coefficient is not finite.
    HOPSCOTCH_DEVICE primal_of<Real> length(const primal_of<Real>& tolerance,
                                            const primal_of<Real>& longest) const {
        // proofs do not hold the remainder
        if constexpr (requires { note_truncation(tolerance); }) note_truncation(tolerance);
        const plain from_last = rough_root(tolerance / last_, order<Real>);
        const plain from_before = rough_root(tolerance / before_last_, order<Real> - 1);
        const plain shorter = smaller(from_before, from_last);
        return select(shorter < longest, shorter, longest) + doubtful_;
    }

private:
    using plain = primal_of<Real>;

    plain last_ = plain(0.0);
    plain before_last_ = plain(0.0);
    plain doubtful_ = plain(0.0);  // 0, or NaN
};

}  // namespace hopscotch::inline HOPSCOTCH_TARGET::taylor
