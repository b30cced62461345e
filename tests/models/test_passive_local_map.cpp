// The return map next to a lossless motion (model page, sections 4, 5 and 9 H1): a cube-root event
// in alpha, a 4/3-power law in beta, algebraic attraction from the right only, and what an added
// speed makes of it.
#include "tests/models/passive_lane.hpp"
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_lane::hand_stepped;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;

double kappa_of(double mass_ratio) {
    return mass_ratio / ((1.0 + mass_ratio) * (1.0 + mass_ratio));
}

/// Coefficient of beta^(4/3) on the right; ten times that on the left.
double right_coefficient(int k, double mass_ratio) {
    const double a = to_double(lossless(k));
    return kappa_of(mass_ratio) * (a / 8.0) * std::pow(12.0 * a * a / (1.0 + a * a), 4.0 / 3.0);
}
double cubic_coefficient(int k) {
    const double a = to_double(lossless(k));
    return (2.0 / 3.0) * (1.0 + a * a) / (a * a);
}

TEST(passive_local_map, coefficients_at_mass_ratio_1_are_those_of_the_page) {
    EXPECT_NEAR(right_coefficient(1, 1.0), 3.61694979460, 5e-12);
    EXPECT_NEAR(right_coefficient(2, 1.0), 6.48706985793, 5e-12);
}

TEST(passive_local_map, next_distance_has_full_relative_accuracy_from_1e_2_to_1e_14) {
    struct site {
        int k;
        double mass_ratio;
    };
    for (const site& at : {site{1, 1.0}, site{2, 1.0}, site{5, 1.0}, site{1, 20.0}}) {
        const simulator hopper({.mass_ratio = at.mass_ratio});
        for (int j = 2; j <= 14; ++j) {
            for (const double side : {1.0, -1.0}) {
                const double beta = side * std::pow(10.0, -j);
                const history truth = hopper.from_lift_off(lossless(at.k) + beta);
                hand_stepped orbit(at.k, beta, at.mass_ratio);
                const bool lifts = orbit.hop();
                ASSERT_EQ(lifts, truth.lifts) << at.k << " " << beta;
                EXPECT_EQ(orbit.lane.bounces, truth.impacts - 1.0);
                if (!lifts) continue;
                const real50 next = truth.speed - lossless(at.k);
                // The loss is a few dozen rounded operations. On the left its second impact repeats
                // them on a small difference of the first; far from the point that is conditioned
                // by f' < 100.
                const double allowed = side > 0.0 ? 1e-14 : 1e-13;
                const double truth_loss = to_double(truth.loss);
                EXPECT_NEAR(orbit.lane.total_loss / truth_loss, 1.0, allowed * (j < 4 ? 10.0 : 1.0))
                    << at.k << " " << beta;
                const double left_cell =
                    passive::lift_off_speed(orbit.lane) - to_double(truth.speed);
                EXPECT_LE(std::abs(left_cell), 1e-13);
                if (orbit.lane.cell != at.k) continue;
                EXPECT_NEAR(orbit.lane.beta, to_double(next),
                            4e-16 * std::abs(beta) + allowed * truth_loss)
                    << at.k << " " << beta;
            }
        }
    }
}

TEST(passive_local_map, lift_off_speeds_as_doubles_next_to_a_lossless_speed_give_its_map_value) {
    // the same through the ordinary section: the start is alpha rounded, the truth starts from that
    // double
    for (const int k : {1, 2, 3}) {
        const simulator hopper({});
        for (int j = 2; j <= 14; j += 2) {
            for (const double side : {1.0, -1.0}) {
                const double alpha = to_double(lossless(k)) + side * std::pow(10.0, -j);
                const history truth = hopper.from_lift_off(alpha);
                const auto one = hop(alpha, 1.0);
                ASSERT_EQ(one.end == outcome::ok, truth.lifts);
                // result rounded to double (1 ulp at 11) and, at 1e-2, the slope's few dozen ulp
                if (truth.lifts)
                    EXPECT_NEAR(one.speed, to_double(truth.speed), j <= 2 ? 1e-13 : 4e-15) << alpha;
                EXPECT_EQ(one.bounces, truth.impacts - 1.0);
            }
        }
    }
}

TEST(passive_local_map, four_thirds_power_law_holds_on_both_sides_with_a_ratio_of_ten) {
    struct site {
        int k;
        double mass_ratio;
    };
    for (const site& at : {site{1, 1.0}, site{2, 1.0}, site{1, 0.05}, site{3, 20.0}}) {
        const double c = right_coefficient(at.k, at.mass_ratio);
        const double a = to_double(lossless(at.k));
        for (const double size : {1e-18, 1e-15, 1e-12}) {
            const double root = std::cbrt(size / cubic_coefficient(at.k));
            hand_stepped right(at.k, size, at.mass_ratio);
            hand_stepped left(at.k, -size, at.mass_ratio);
            ASSERT_TRUE(right.hop());
            ASSERT_TRUE(left.hop());
            // loss = (alpha + f)(alpha - f) = 2 alpha* (1 + O(size)) times the step
            const double right_step = right.lane.total_loss / (2.0 * a);
            const double left_step = left.lane.total_loss / (2.0 * a);
            const double power = std::pow(size, 4.0 / 3.0);
            // next order is root^2 with a coefficient of a few
            const double rest = 8.0 * root * root + 1e-13;
            EXPECT_NEAR(right_step / (c * power) - 1.0, 2.0 / a * root, rest)
                << at.k << " " << size;
            EXPECT_NEAR(left_step / (10.0 * c * power) - 1.0, -2.0 / a * root, rest) << at.k;
        }
    }
}

TEST(passive_local_map, left_landing_is_followed_by_a_bounce_of_three_times_the_shift_and_speed) {
    const simulator hopper({});
    for (const double size : {1e-9, 1e-12}) {
        const real50 alpha = lossless(1) - size;
        const motion start = hopper.lift_off_state(alpha);
        const real50 first = hopper.first_contact(start, passive_truth::launch::lift_off);
        const double shift = to_double(lossless(1) * 2.0 - first);
        const double shift_here = 2.0 * std::cbrt(size / cubic_coefficient(1));
        EXPECT_NEAR(shift / shift_here, 1.0, shift_here);
        hand_stepped orbit(1, -size, 1.0);
        unwatched watch;
        passive_hopper::step<passive_lane::plastic_variant>(orbit.lane, true, watch);
        const double first_time = orbit.lane.time;
        const double first_loss = orbit.lane.total_loss;
        EXPECT_NEAR(first_time, to_double(first),
                    1e-13);  // exact to rounding although the root is triple
        orbit.hop();
        // second impact three times as fast: nine times the loss
        EXPECT_NEAR((orbit.lane.total_loss - first_loss) / first_loss, 9.0, 20.0 * shift);
    }
}

TEST(passive_local_map, distance_falls_like_27_over_the_cube_of_the_hops) {
    for (const int k : {1, 2}) {
        const double c = right_coefficient(k, 1.0);
        hand_stepped orbit(k, 1e-3, 1.0);
        double error_before = 1.0;
        double n = 0.0;
        for (const double stop : {1e3, 1e4, 1e5, 1e6}) {
            while (n < stop) {
                const double before = orbit.lane.beta;
                ASSERT_TRUE(orbit.hop());
                ASSERT_LT(orbit.lane.beta, before);  // never stalls, never crosses
                ASSERT_GT(orbit.lane.beta, 0.0);
                n += 1.0;
            }
            const double error = std::abs(orbit.lane.beta * std::pow(c * n / 3.0, 3) - 1.0);
            EXPECT_LT(error, error_before);
            error_before = error;
        }
        // what is left at n = 1e6: 3 (start offset + log n) / n
        EXPECT_LT(error_before, 1e-3);
        EXPECT_EQ(orbit.lane.bounces, 0.0);
    }
}

/// Hops from alpha*_k + reach down to alpha*_k - reach.
double passage(int k, double increment, double reach) {
    hand_stepped orbit(k, reach, 1.0, increment);
    double hops = 0.0;
    while (orbit.lane.beta > -reach && orbit.lane.cell == k) {
        if (!orbit.hop()) break;
        hops += 1.0;
    }
    return hops;
}

TEST(passive_local_map, ghost_of_a_lossless_motion_delays_by_the_fourth_root_of_the_decrement) {
    for (const int k : {1, 2}) {
        const double c = right_coefficient(k, 1.0);
        const double constant = 3.3322 * (std::pow(c, -0.75) + std::pow(10.0 * c, -0.75));
        const double near = passage(k, -1e-8, 1e-3);
        const double nearer = passage(k, -1e-12, 1e-3);
        const double nearest = passage(k, -1e-16, 1e-3);
        // N = A |eps|^(-1/4) + B + ...: B (the way to and from +-1e-3) drops out of differences
        EXPECT_NEAR((nearest - nearer) / (nearer - near), 10.0, 0.05);
        EXPECT_NEAR((nearest - nearer) / (1e4 - 1e3) / constant, 1.0, 2e-3);
    }
}

TEST(passive_local_map, small_increments_split_the_semi_stable_point_into_two_fixed_points) {
    const double c = right_coefficient(1, 1.0);
    const double a = to_double(lossless(1));
    for (const double increment : {1e-10, 1e-8}) {
        hand_stepped orbit(1, std::pow(increment / c, 0.75) * 1.2, 1.0, increment);
        double before = 0.0;
        double ratio = 0.0;
        const double multiplier = 1.0 - (4.0 / 3.0) * std::pow(c, 0.75) * std::pow(increment, 0.25);
        const int hops = static_cast<int>(40.0 / (1.0 - multiplier));
        for (int i = 0; i < hops; ++i) {
            const double step_before = orbit.lane.beta - before;
            before = orbit.lane.beta;
            ASSERT_TRUE(orbit.hop());
            if (i == hops / 4) ratio = (orbit.lane.beta - before) / step_before;
        }
        const double root = std::cbrt(orbit.lane.beta / cubic_coefficient(1));
        const double balance = c * std::pow(orbit.lane.beta, 4.0 / 3.0) * (1.0 + 2.0 / a * root);
        EXPECT_NEAR(balance / increment, 1.0, 2.0 * root * root + 1e-12);
        EXPECT_NEAR(orbit.lane.beta / std::pow(increment / c, 0.75), 1.0, root);
        EXPECT_NEAR((1.0 - ratio) / (1.0 - multiplier), 1.0, 3.0 * root);
        // below: what the map takes at alpha_u is what the increment gives, and it repels
        const double unstable = -std::pow(increment / (10.0 * c), 0.75);
        const double lost_root = std::cbrt(-unstable / cubic_coefficient(1));
        hand_stepped above(1, unstable * (1.0 - 2.0 * lost_root), 1.0, increment);
        hand_stepped below(1, unstable * (1.0 + 2.0 * lost_root), 1.0, increment);
        const double above_start = above.lane.beta;
        const double below_start = below.lane.beta;
        ASSERT_TRUE(above.hop());
        ASSERT_TRUE(below.hop());
        EXPECT_GT(above.lane.beta, above_start);
        EXPECT_LT(below.lane.beta, below_start);
    }
}

TEST(passive_local_map, fixed_point_loses_stability_at_the_page_s_increment) {
    // M = 1, k = 1: f' = -1 on the single-impact branch, f f' = alpha + 4 kappa S p (x + S p / q)
    const auto slope_plus_one = [](const real50& x) {
        const half_flight there(x);
        const real50 alpha = there.alpha();
        const real50 f = sqrt(alpha * alpha - there.toll() * 0.25);
        return (alpha + there.sine * there.p * (there.x + there.sine * there.p / there.q)) / f +
               1.0;
    };
    const real50 x = bisect(slope_plus_one, lossless(1) + 1e-6, lossless(1) + 0.6);
    const half_flight there(x);
    const real50 alpha = there.alpha();
    const real50 critical = alpha - sqrt(alpha * alpha - there.toll() * 0.25);
    EXPECT_NEAR(to_double(alpha), 4.5417632729, 5e-11);
    EXPECT_NEAR(to_double(critical), 0.0715873841, 5e-11);

    const double eps = to_double(critical);
    EXPECT_NEAR(hop(to_double(alpha), 1.0, 0.0, 0.0, eps).speed, to_double(alpha), 4e-15);
    const auto after = [](double start, double increment, std::uint32_t returns) {
        return run({.columns = {{start}}, .increment = {increment}, .returns = returns});
    };
    // 1 % below: multiplier about -0.99 or nearer to 0; 1 % above: period two
    const double calm = after(4.54, 0.97 * eps, 4000).speed[0];
    EXPECT_NEAR(after(4.54, 0.97 * eps, 4001).speed[0], calm, 1e-12);
    const double beat = after(4.54, 1.03 * eps, 4000).speed[0];
    EXPECT_GT(std::abs(after(4.54, 1.03 * eps, 4001).speed[0] - beat), 1e-3);
    EXPECT_NEAR(after(4.54, 1.03 * eps, 4002).speed[0], beat, 1e-12);

    // basin edges: the repelling fixed point and its preimage to the right (eight digits printed)
    const double left = 4.48134195;
    const double right = 4.58889950;
    EXPECT_NEAR(right - left, 0.107558, 6e-7);
    const auto outside_left = after(left - 1e-6, eps, 300);
    const auto outside_right = after(right + 1e-6, eps, 300);
    const auto inside_left = after(left + 1e-6, eps, 300);
    const auto inside_right = after(right - 1e-6, eps, 300);
    for (const auto& stays : {inside_left, inside_right}) {
        EXPECT_EQ(stays.end[0], outcome::ok);
        EXPECT_NEAR(stays.speed[0], to_double(alpha), 0.02);  // algebraic approach at f' = -1
    }
    for (const auto& leaves : {outside_left, outside_right})
        EXPECT_TRUE(leaves.end[0] == outcome::stuck || leaves.speed[0] < left);
}

TEST(passive_local_map, chaotic_increments_reproduce_the_first_ten_hops) {
    const double eps = 0.13;  // H10: between the period doublings and the crisis of the page
    const simulator hopper({});
    real50 truth(4.55);
    for (std::uint32_t n = 1; n <= 10; ++n) {
        truth = hopper.from_lift_off(truth).speed + eps;
        const auto orbit = run({.columns = {{4.55}}, .increment = {eps}, .returns = n});
        // an ulp grows by at most |f'| < 6 per hop on this attractor: 6^10 4e-16 = 2.4e-8
        EXPECT_NEAR(orbit.speed[0], to_double(truth), 4e-15 * std::pow(6.0, n)) << n;
    }
}

}  // namespace
}  // namespace hopscotch
