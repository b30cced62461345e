// The arithmetic of proofs holds what it claims: values and derivatives of random functions over
// random sets of starts lie inside, judged by 50 digits; masks say what is not decided.
#include "analysis/truth/enclosure.hpp"
#include "analysis/truth/interval_matrix.hpp"
#include "analysis/truth/real50.hpp"
#include "kernels/lanes/dual.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hopscotch {
namespace {

using truth = dual<real50, 2>;

bool holds(const interval& bounds, const real50& x) {
    return real50(bounds.low) <= x && x <= real50(bounds.high);
}

/// Every operation that models use, on arguments about 1.
struct every_operation {
    static constexpr int n = 30;
    template <class Real>
    static Real at(int which, const Real& x, const Real& y) {
        const Real one(1.0);
        switch (which) {
            case 0:
                return x + y;
            case 1:
                return x - y * x;
            case 2:
                return x * y * (x - y);
            case 3:
                return (x + one) / (y * y + one);
            case 4:
                return fma(x, y, -(x * x));
            case 5:
                return sqrt(x * x + y);
            case 6:
                return abs(x - y);
            case 7:
                return sin(x * Real(3.0)) * cos(y);
            case 8:
                return tan(x - y * Real(0.3));
            case 9:
                return exp(x - y);
            case 10:
                return expm1(x * y * Real(0.01));
            case 11:
                return log(x * x + y);
            case 12:
                return log1p(x * y);
            case 13:
                return atan(x / y);
            case 14:
                return atan2(x, y);
            case 15:
                return atan2(-x, -y);
            case 16:
                return asin(x * Real(0.2)) + acos(y * Real(0.3));
            case 17:
                return sinh(x) - cosh(y);
            case 18:
                return tanh(x * y);
            case 19:
                return asinh(x - y);
            case 20:
                return atanh(x * y * Real(0.1));
            case 21:
                return cbrt(x - Real(5.0));
            case 22:
                return larger(x, y) * smaller(x, one);
            case 23:
                return select(x < Real(100.0), x * y, y);
            case 24:
                return copysign(x * x, -y);
            case 25:
                return x * x * x - (x - y) * (x + y) / (x * x + y * y);
            case 26:
                return nearest(x * Real(1e-3)) + floor(y * Real(1e-3)) + x;
            case 27:
                return negate_where(y > Real(-1.0), x) * pi<Real>();
            case 28:
                return x - (x - x * y) / sqrt2<Real>();
            default:
                return select_form(x < y, x * (y + one), x * y + x);
        }
    }
};

/// A random set of starts, its points and what is to be compared.
struct random_set {
    double centre[2];
    double frame[2][2];
    start_set set;

    template <class Generator>
    random_set(Generator& random, double size) {
        std::uniform_real_distribution<double> place(0.5, 2.0);
        std::uniform_real_distribution<double> entry(-size, size);
        for (int i = 0; i < 2; ++i) {
            centre[i] = place(random);
            for (int j = 0; j < 2; ++j) frame[i][j] = entry(random);
        }
        set.n_columns = 2;
        set.is_ball = random() % 2 == 0;
        set.radius = 1.0;
        set.reach.fill(1.0);
    }
    enclosure column(int i) const {
        return enclosure::of_start(interval::point(centre[i]), frame[i]);
    }
    truth column(int i, const double (&v)[2]) const {
        truth x(real50(centre[i]) + real50(frame[i][0]) * real50(v[0]) +
                real50(frame[i][1]) * real50(v[1]));
        x.slope[0] = real50(frame[i][0]);
        x.slope[1] = real50(frame[i][1]);
        return x;
    }
    template <class Generator>
    void draw(Generator& random, double (&v)[2]) const {
        std::uniform_real_distribution<double> any(-1.0, 1.0);
        do {
            v[0] = any(random);
            v[1] = any(random);
        } while (set.is_ball && v[0] * v[0] + v[1] * v[1] > 1.0);
    }
};

TEST(enclosure, holds_values_and_derivatives_of_random_functions_over_random_sets) {
    std::mt19937_64 random(20);
    for (int round = 0; round < 40; ++round) {
        for (int which = 0; which < every_operation::n; ++which) {
            const double size = std::pow(10.0, -(round % 8) - 1.0);
            const random_set starts(random, size);
            const enclosing scope(starts.set);
            const enclosure f = every_operation::at(which, starts.column(0), starts.column(1));
            for (int k = 0; k < 8; ++k) {
                double v[2];
                starts.draw(random, v);
                const truth t =
                    every_operation::at(which, starts.column(0, v), starts.column(1, v));
                ASSERT_TRUE(holds(f.range, t.value)) << which << " size " << size;
                for (std::size_t j = 0; j < 2; ++j)
                    ASSERT_TRUE(holds(f.slope[j], t.slope[j])) << which << " slope " << j;
            }
            const double zero[2] = {0.0, 0.0};
            const truth centre =
                every_operation::at(which, starts.column(0, zero), starts.column(1, zero));
            ASSERT_TRUE(holds(f.centre, centre.value)) << which;
        }
    }
}

TEST(enclosure, bounds_shrink_with_the_square_of_the_set) {
    // mean-value form: what a range has too much is of second order
    double excess[2];
    for (int k = 0; k < 2; ++k) {
        const double size = k == 0 ? 1e-2 : 1e-3;
        start_set set{.n_columns = 1, .n = 1, .is_ball = true, .radius = 1.0};
        const enclosing scope(set);
        const enclosure x = enclosure::of_start(interval::point(1.0), &size);
        const enclosure f = x * x - x * enclosure(2.0);
        excess[k] = f.range.high - f.range.low;
    }
    EXPECT_LT(excess[1], 0.011 * excess[0]);  // derivative 0 at 1: nothing of first order
}

TEST(enclosure, the_root_of_an_event_function_is_held_with_its_derivatives) {
    // Kepler's equation t - x sin t = y: anomaly t of mean anomaly y and eccentricity x
    std::mt19937_64 random(21);
    const auto solve = [](const auto& x, const auto& y) {
        using Real = std::remove_cvref_t<decltype(x)>;
        using plain = primal_of<Real>;
        const auto rising = [&](const plain& t) {
            const auto turn = sin_cos(t);
            return value_and_slope<plain>{t - primal(x) * turn.sin - primal(y),
                                          plain(1.0) - primal(x) * turn.cos};
        };
        const plain root =
            bracketed_root<plain>(rising, {plain(-10.0), plain(10.0)}, primal(y), true);
        const Real residual = Real(root) - x * sin(Real(root)) - y;
        return implicit_root(root, residual, rising(root).slope);
    };
    for (int round = 0; round < 60; ++round) {
        random_set starts(random, std::pow(10.0, -(round % 6) - 1.5));
        starts.centre[0] *= 0.3;
        const enclosing scope(starts.set);
        const enclosure t = solve(starts.column(0), starts.column(1));
        for (int k = 0; k < 8; ++k) {
            double v[2];
            starts.draw(random, v);
            const truth exact = solve(starts.column(0, v), starts.column(1, v));
            ASSERT_TRUE(holds(t.range, exact.value)) << round;
            for (std::size_t j = 0; j < 2; ++j)
                ASSERT_TRUE(holds(t.slope[j], exact.slope[j])) << round << " slope " << j;
        }
    }
}

TEST(enclosure, a_root_that_not_every_start_has_is_not_unique) {
    const double size = 0.1;
    start_set set{.n_columns = 1, .n = 1, .is_ball = true, .radius = 1.0};
    const enclosing scope(set);
    const enclosure y = enclosure::of_start(interval::point(0.05), &size);  // -0.05 ... 0.15
    const auto rising = [&](const enclosure& t) {
        return value_and_slope<enclosure>{t * t - y, t + t};
    };
    const bracket<enclosure> within{enclosure(0.3), enclosure(0.4)};
    EXPECT_THROW(bracketed_root<enclosure>(rising, within, enclosure(0.3), true), doubtful);
    // where some starts do not ask for it, nothing is known of it
    const enclosure_mask some = y > enclosure(0.1);
    EXPECT_TRUE(bracketed_root<enclosure>(rising, within, enclosure(0.3), some).range.is_entire());
}

TEST(enclosure, a_triple_root_is_bounded_but_has_no_derivative) {
    const double size = 1e-3;
    start_set set{.n_columns = 1, .n = 1, .is_ball = true, .radius = 1.0};
    const enclosing scope(set);
    const enclosure y = enclosure::of_start(interval::point(0.0), &size);
    const auto rising = [&](const enclosure& t) {
        return value_and_slope<enclosure>{t * t * t - y, enclosure(3.0) * t * t};
    };
    const enclosure root =
        bracketed_root<enclosure>(rising, {enclosure(-1.0), enclosure(1.0)}, enclosure(0.5), true);
    EXPECT_LE(root.range.low, -0.1);  // +-1e-3 to the third
    EXPECT_GE(root.range.high, 0.1);
    EXPECT_LT(root.range.high - root.range.low, 0.6);
    EXPECT_FALSE(root.slope[0].is_bounded());
}

TEST(enclosure, a_comparison_that_differs_within_the_set_is_neither_true_nor_false) {
    const double size = 0.5;
    start_set set{.n_columns = 1, .n = 1, .is_ball = true, .radius = 1.0};
    const enclosing scope(set);
    const enclosure x = enclosure::of_start(interval::point(1.0), &size);
    EXPECT_FALSE((x < enclosure(1.2)).is_certain());
    EXPECT_TRUE((x < enclosure(1.6)).is_certain());
    EXPECT_TRUE(all(x * x + enclosure(1.0) > x * enclosure(0.5)));
    // correlated sides: x < x + 0.01 although their ranges overlap
    EXPECT_TRUE(all(x < x + enclosure(0.01)));
    const enclosure chosen = select(x < enclosure(1.2), enclosure(1.0), enclosure(3.0));
    EXPECT_LE(chosen.range.low, 1.0);
    EXPECT_GE(chosen.range.high, 3.0);
    EXPECT_FALSE(chosen.slope[0].is_bounded());  // a jump has no derivative
    const enclosure formed = select_form(x < enclosure(1.2), x + x, enclosure(2.0) * x);
    EXPECT_TRUE(formed.slope[0].holds(1.0));
    EXPECT_LT(formed.slope[0].high, 1.0 + 1e-12);
}

TEST(enclosure, counters_and_flags_stay_exact) {
    start_set set;
    const enclosing scope(set);
    enclosure events(0.0);
    for (int i = 0; i < 1000; ++i) events = events + enclosure(1.0);
    EXPECT_TRUE(events.range.is_point());
    EXPECT_EQ(events.range.low, 1000.0);
    EXPECT_TRUE((enclosure(3.0) * enclosure(0.5)).range.is_point());
    EXPECT_FALSE((enclosure(1.0) / enclosure(3.0)).range.is_point());
}

TEST(interval_matrix, norm_bounds_are_above_the_norm_and_close_to_it) {
    std::mt19937_64 random(22);
    std::normal_distribution<double> entry;
    for (int n = 1; n <= 5; ++n) {
        for (int round = 0; round < 50; ++round) {
            small_matrix m{.n = n};
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) m(i, j) = entry(random);
            }
            const double bound = norm_bound(interval_matrix::of(m));
            double attained = 0.0;  // from below: |M x| of many x, x improved by M^T M
            for (int k = 0; k < 10; ++k) {
                double x[most_columns];
                for (int i = 0; i < n; ++i) x[i] = entry(random);
                for (int step = 0; step < 300; ++step) {
                    double y[most_columns] = {};
                    double z[most_columns] = {};
                    double x_square = 0.0;
                    double y_square = 0.0;
                    for (int i = 0; i < n; ++i) {
                        for (int j = 0; j < n; ++j) y[i] += m(i, j) * x[j];
                        x_square += x[i] * x[i];
                        y_square += y[i] * y[i];
                    }
                    attained = std::max(attained, std::sqrt(y_square / x_square));
                    for (int j = 0; j < n; ++j) {
                        for (int i = 0; i < n; ++i) z[j] += m(i, j) * y[i];
                    }
                    for (int j = 0; j < n; ++j) x[j] = z[j] / y_square;
                }
            }
            ASSERT_GE(bound, attained * (1.0 - 1e-15));
            ASSERT_LE(bound, attained * (1.0 + 1e-6));
        }
    }
}

}  // namespace
}  // namespace hopscotch
