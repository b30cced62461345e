// Constants that kernels/passive uses as proofs or as starting points, each checked in 50 digits:
// the least kappa that lets an orbit escape, where D falls, the table of lossless points, the guess
// of the half flight.
#include "kernels/passive/hopper_lane.hpp"
#include "kernels/passive/return_map.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

using namespace passive_truth;

TEST(passive_constants, least_escaping_kappa_is_a_lower_bound_of_the_least_d_up_to_k_200) {
    for (int k = 1; k <= 200; ++k) {
        const real50 point = lossless(k);
        const real50 end = pi50() * (k + 1.0);
        // one minimum (page: checked to k = 20); 30 golden sections place it to 1e-7, its value to
        // 1e-14
        const real50 place = minimise([&](const real50& x) { return escaping_kappa(k, x); },
                                      point + (end - point) * 0.02, end, 30);
        const double least = to_double(escaping_kappa(k, place));
        const double bound = passive::least_escaping_kappa(to_double(point));
        EXPECT_LT(bound, least * (1.0 - 1e-6)) << k;  // and not by an ulp
        EXPECT_GT(bound, least * 0.99) << k;          // nor uselessly far below
    }
}

TEST(passive_constants, least_d_of_the_first_branches_is_that_of_the_page) {
    // thresholds in M of section 4, as kappa
    for (const auto& [k, m] : {std::pair{1, 9.66578}, std::pair{2, 15.5052}}) {
        const double kappa = m / ((1.0 + m) * (1.0 + m));
        EXPECT_NEAR(to_double(escaping_kappa(k, least_escape_place(k))) / kappa, 1.0, 1e-6);
        EXPECT_LT(passive::least_escaping_kappa(to_double(lossless(k))), kappa);
    }
}

TEST(passive_constants, d_falls_from_the_lossless_point_over_the_whole_falling_part_up_to_k_200) {
    for (int k = 1; k <= 200; ++k) {
        const real50 point = lossless(k);
        const real50 last = half_flight_of(point + passive::falling_part).x;
        ASSERT_GE(half_flight(last).alpha() - point, real50(passive::falling_part - 1e-12));
        real50 before;
        const int n = 24;
        for (int i = 0; i <= n; ++i) {
            // the derivative of D has one sign on each side of its only minimum: closely spaced to
            // the end
            const double share = i < n / 2 ? 1.6 * i / n + 1e-3 : 0.8 + 0.2 * (2.0 * i - n) / n;
            const real50 now = escaping_kappa(k, point + (last - point) * share);
            if (i > 0) EXPECT_LT(now, before) << k << " " << i;
            before = now;
        }
        const real50 beyond = escaping_kappa(k, last + (last - point) * 1e-6);
        EXPECT_LT(beyond, before) << k;  // still falling at its end
    }
}

TEST(passive_constants, places_of_the_least_d_lie_where_the_kernel_says) {
    const auto distance = [](int k) {
        return to_double(half_flight(least_escape_place(k)).alpha() - lossless(k));
    };
    EXPECT_NEAR(distance(1), 0.721, 5e-4);
    double before = distance(1);
    for (const int k : {2, 3, 5, 10, 40, 200}) {
        const double now = distance(k);
        EXPECT_LT(now, before);
        EXPECT_GT(now, passive::falling_part);
        before = now;
    }
    EXPECT_NEAR(before, 0.5278, 2e-3);
}

TEST(passive_constants, lossless_table_matches_fifty_digits) {
    for (int k = 0; k < passive::n_tabulated; ++k) {
        const auto point = passive::lossless_from_table(static_cast<double>(k));
        EXPECT_EQ(point.high, to_double(lossless(k))) << k;
        const real50 rest = lossless(k) - point.high;
        EXPECT_EQ(point.low, to_double(rest)) << k;
        const real50 sign(k % 2 == 0 ? 1.0 : -1.0);
        EXPECT_EQ(point.cosine, to_double(sign / sqrt(lossless(k) * lossless(k) + 1.0))) << k;
    }
}

TEST(passive_constants, lossless_points_beyond_the_table_have_two_doubles_of_precision) {
    for (const int k : {64, 65, 100, 1000, 31415, 1000000}) {
        const auto point = passive::lossless_point(static_cast<double>(k));
        const real50 error = real50(point.high) + point.low - lossless(k);
        // one Newton step from a double angle: about 2^-104 relative
        EXPECT_LT(abs(error), lossless(k) * 1e-30) << k;
        EXPECT_EQ(point.high, to_double(lossless(k))) << k;
        const real50 cosine =
            real50(k % 2 == 0 ? 1.0 : -1.0) / sqrt(lossless(k) * lossless(k) + 1.0);
        EXPECT_NEAR(point.cosine / to_double(cosine), 1.0, 4e-16);  // two roundings
    }
}

TEST(passive_constants, lossless_points_of_every_arithmetic_solve_x_equal_tan_x) {
    using wide = double_double<double>;
    for (const int k : {1, 2, 7, 63, 64, 500}) {
        const auto fifty = passive::lossless_point(real50(static_cast<double>(k)));
        EXPECT_LT(abs(fifty.high - lossless(k)), lossless(k) * 1e-60);
        const auto doubled = passive::lossless_point(wide(static_cast<double>(k)));
        const real50 got = real50(doubled.high.high) + doubled.high.low;
        EXPECT_LT(abs(got - lossless(k)), lossless(k) * 1e-30) << k;
    }
}

TEST(passive_constants, the_guess_is_within_three_permille) {
    double worst = 0.0;
    for (const int k : {0, 1, 2, 3, 5, 8, 20, 63}) {
        const double point = to_double(lossless(k));
        const double left = k * M_PI;
        const double right = (k + 1) * M_PI;
        for (int i = 0; i < 60; ++i) {
            // on both sides, from next to the point to the cell's ends
            const double share = i < 20 ? std::pow(10.0, -1.0 - 0.5 * i) : (i - 19.5) / 40.5;
            for (const bool is_right : {true, false}) {
                if (k == 0 && !is_right) continue;
                const double beta = is_right ? (right - point) * share : (left - point) * share;
                const passive::launch<double> from{point, to_double(cos(lossless(k))), beta, 0.0};
                const real50 x = half_flight_of(lossless(k) + beta).x;
                const double xi = to_double(x - lossless(k));
                const double error = std::abs(passive::lift_off_guess(from) / xi - 1.0);
                EXPECT_LT(error, 3.2e-3) << k << " " << beta;  // 0.3 % as printed with one digit
                worst = std::max(worst, error);
            }
        }
    }
    EXPECT_GT(worst, 1e-4);  // the comparison is not vacuous
}

TEST(passive_constants, terms_of_the_half_flight_have_no_cancellation_next_to_the_triple_root) {
    for (const int k : {0, 1, 2, 9}) {
        for (int j = 0; j <= 12; ++j) {
            for (const double side : {1.0, -1.0}) {
                const double xi = side * 1.3 * std::pow(10.0, -j);
                if (k == 0 && side < 0.0) continue;
                const real50 x = lossless(k) + xi;
                const half_flight truth(x);
                const real50 point = k == 0 ? real50(0.0) : lossless(k);
                const auto table = passive::lossless_point(static_cast<double>(k));
                const passive::launch<double> from{table.high, table.cosine, 0.0, 0.0};
                const auto at = passive::terms_at(from, xi);
                // the centre's rounding (an ulp of 30) enters p through sin xi, relatively
                EXPECT_NEAR(at.p / to_double(truth.p), 1.0, 1e-14) << k << " " << xi;
                EXPECT_NEAR(at.q / to_double(truth.q), 1.0, 1e-14) << k << " " << xi;
                const real50 beta = truth.alpha() - point;
                EXPECT_NEAR(at.residual / to_double(beta * truth.q), 1.0, 1e-13) << k << " " << xi;
            }
        }
    }
}

TEST(passive_constants, cells_are_told_apart_with_the_low_part_of_pi) {
    for (int m = 1; m <= 100000; m = m < 300 ? m + 1 : m * 3) {
        const real50 edge = pi50() * static_cast<double>(m);
        double alpha = to_double(edge) * (1.0 - 1e-15);
        for (int i = 0; i < 16; ++i) {
            const double expected = real50(alpha) <= edge ? m - 1.0 : m;
            EXPECT_EQ(passive::cell_of(alpha), expected) << m << " " << i;
            alpha = std::nextafter(alpha, 1e300);
        }
    }
    EXPECT_EQ(passive::cell_of(0.0), 0.0);
    EXPECT_EQ(passive::cell_of(-3.0), 0.0);
}

TEST(passive_constants, bounces_next_to_m_pi_are_bracketed_on_their_own_side) {
    // H(m pi; eta) = m pi for every eta: a launch at the double next to m pi lands at x next to m
    // pi
    for (int m = 1; m <= 40; ++m) {
        for (const double eta : {0.01, 0.567, 3.0}) {
            double speed = to_double(pi50() * static_cast<double>(m)) * (1.0 - 4e-16);
            for (int i = 0; i < 6; ++i) {
                const passive::launch<double> from{0.0, 1.0, speed, eta};
                const auto at = passive::first_contact(from, 0.0, true, true);
                // dx/dV = q^2 / (2 p r) = m pi / (2 m pi) there: a few ulp stay a few ulp
                EXPECT_NEAR(at.x, m * M_PI, 1e-15 * 8.0 * m) << m << " " << eta << " " << i;
                speed = std::nextafter(speed, 1e300);
            }
        }
    }
}

}  // namespace
}  // namespace hopscotch
