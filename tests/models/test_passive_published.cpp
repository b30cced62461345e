// The numbers that Chatterjee, Pratap, Reddy and Ruina (2002) print for the passive hopper and
// juggler, and the page's own reference points: section 10 of the model page, row by row.
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include "kernels/passive/lossless_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;

constexpr double inf = std::numeric_limits<double>::infinity();

/// Half a unit of the last digit printed.
constexpr double printed(int digits_after_point) {
    double unit = 0.5;
    for (int i = 0; i < digits_after_point; ++i) unit *= 0.1;
    return unit * 1.0001;
}

TEST(passive_published, lossless_speeds_are_those_of_the_paper) {
    const double page[] = {4.493409457909, 7.725251836938, 10.904121659429};
    const double paper[] = {4.493409, 7.725251, 10.90412};
    for (int k = 1; k <= 3; ++k) {
        const double point = passive::lossless_point(static_cast<double>(k)).high;
        EXPECT_NEAR(point, page[k - 1], printed(12));
        // the paper truncates: less than one unit of its last digit above
        EXPECT_GE(point, paper[k - 1]);
        EXPECT_LT(point, paper[k - 1] + (k == 3 ? 1e-5 : 1e-6));
        EXPECT_NEAR(point, to_double(lossless(k)), 2e-15);  // one ulp at 11
    }
}

TEST(passive_published, lossless_landing_has_y1_1_and_minus_the_speed_after_twice_the_speed) {
    const simulator hopper({});
    for (int k = 1; k <= 12; ++k) {
        const real50 point = lossless(k);
        const motion landing = hopper.at(hopper.lift_off_state(point), point * 2.0);
        // zeros of the equations of motion themselves, in 64 digits
        EXPECT_LT(abs(landing.spring - 1.0), real50(1e-55));
        EXPECT_LT(abs(landing.spring_rate + point), real50(1e-55));
        EXPECT_LT(abs(landing.gap), real50(1e-55));
        EXPECT_LT(abs(landing.gap_rate), real50(1e-55));
        for (int i = 1; i < 2000; ++i) {  // clear of the ground in between
            const real50 t = point * (2.0 * i / 2000.0);
            EXPECT_GT(hopper.at(hopper.lift_off_state(point), t).gap, real50(0.0)) << k << " " << i;
        }
    }
}

TEST(passive_published, hops_next_to_the_lossless_speeds_last_twice_the_speed_and_the_contact) {
    for (int k = 1; k <= 12; ++k) {
        const double point = to_double(lossless(k));
        const auto one = hop(point, 1.0);
        ASSERT_EQ(one.end, outcome::ok);
        // contact from v1 = -alpha to alpha: half a period about -1/M and the two arcs up to y1 = 1
        const double w = std::sqrt(0.5);
        const double contact = 2.0 / w * std::atan2(2.0 * point, -w * 4.0);
        // the triple root turns an ulp of alpha into its cube root: (12 * 1e-15)^(1/3)
        EXPECT_NEAR(one.time, 2.0 * point + contact, 5e-5) << k;
        EXPECT_NEAR(one.speed, point, 4e-15 * point);
    }
}

TEST(passive_published,
     landing_is_sustained_right_of_a_lossless_speed_and_bounces_once_left_of_it) {
    for (int k = 1; k <= 12; ++k) {
        const double point = to_double(lossless(k));
        for (const double mass_ratio : {0.05, 0.909, 1.0, 20.0}) {
            for (const double distance : {1e-12, 1e-9, 1e-6, 1e-4}) {
                EXPECT_EQ(hop(point + distance, mass_ratio).bounces, 0.0) << k << " " << distance;
                EXPECT_EQ(hop(point - distance, mass_ratio).bounces, 1.0) << k << " " << distance;
            }
        }
    }
}

TEST(passive_published, juggler_example_has_the_heights_of_equation_14) {
    // Eq (14) of the page's errata E3, from the simulator's own states: ball apex, hand at rest in
    // contact
    const real50 mass_ratio = truth("0.909");
    const real50 alpha = lossless(1);
    const real50 height =
        alpha * alpha * 0.5;  // of the ball above the point where it leaves the hand
    EXPECT_NEAR(to_double(height), 10.0954, printed(4));
    // the hand's amplitude in flight: w2 = -1 + sqrt(1 + alpha^2), its highest point
    EXPECT_NEAR(to_double(sqrt(alpha * alpha + 1.0) - 1.0), 3.60334, printed(5));
    const real50 total = mass_ratio + 1.0;
    // Lowest point of ball and hand together: w2 = y1 - 1 at the turning point of contact
    const real50 y_low =
        -(real50(1.0) / mass_ratio) -
        sqrt(alpha * alpha * total / mass_ratio + total * total / (mass_ratio * mass_ratio));
    const double depth = to_double(real50(1.0) - y_low);
    EXPECT_NEAR(depth, 8.94213, printed(5));
    EXPECT_NEAR(to_double(height) + depth, 19.0375, printed(4));                           // A1
    EXPECT_NEAR(to_double(sqrt(alpha * alpha + 1.0)) - 1.0 + depth, 12.5455, printed(4));  // A2
    EXPECT_NEAR((to_double(height) + depth) / (to_double(sqrt(alpha * alpha + 1.0)) - 1.0 + depth),
                1.51748, printed(5));
    // the air track of Fig. 9, propped up by 1.1 inch over 5 feet: m2 = 0.2657 kg, k = 8.8 N/m
    const double slope = std::atan(1.1 / 60.0);
    EXPECT_NEAR(slope, 1.8331e-2, printed(6));
    const double unit = 0.2657 * 9.81 * std::sin(slope) / 8.8;
    EXPECT_NEAR(unit, 5.429e-3, printed(6));
    EXPECT_NEAR(0.2657 * 9.80 * std::sin(slope) / 8.8, 5.424e-3, printed(6));
    EXPECT_NEAR(unit * (to_double(height) + depth), 0.1034, printed(4));  // Delta u1
    // the model: the juggler that starts at that lowest point leaves at alpha
    const double low = to_double(y_low) - 1.0;
    const auto thrown = run({.model = "passive_juggler",
                             .section = passive_rows::flight,
                             .columns = {{low}, {0.0}, {low}, {0.0}},
                             .mass_ratio = {0.909}});
    ASSERT_EQ(thrown.end[0], outcome::ok);
    // alpha^2 = 20.2 is a difference of 38: a few ulp of that
    EXPECT_NEAR(thrown.speed[0], to_double(alpha), 2e-14);
}

TEST(passive_published, unbounded_mass_ratio_keeps_the_speed_where_contact_is_sustained) {
    for (const double alpha : {0.3, 1.0, 3.0, 4.6, 5.5, 7.8, 9.0}) {
        const auto one =
            run({.model = "passive_juggler", .columns = {{alpha}}, .mass_ratio = {inf}});
        EXPECT_EQ(one.end[0], outcome::ok);
        EXPECT_EQ(one.speed[0], alpha);
        EXPECT_EQ(one.loss[0], 0.0);
    }
}

TEST(passive_published, unbounded_mass_ratio_bounces_for_ever_between_p_pi_and_the_period_two_end) {
    // ends: just above p pi; around sqrt(p^2 pi^2 + 3), where period one hands over; below alpha_2
    // (page, 8)
    const double period_two_end[] = {3.724959635385563, 6.59385040404683};
    for (int p = 1; p <= 2; ++p) {
        const double left = p * M_PI;
        const double middle = std::sqrt(left * left + 3.0);
        EXPECT_NEAR(middle, p == 1 ? 3.58742 : middle, printed(5));
        const double end = period_two_end[p - 1];
        const std::vector<double> inside{left + 1e-3, 0.5 * (left + middle), middle - 1e-2,
                                         middle + 1e-2, end - 1e-3};
        const auto endless = run({.model = "passive_juggler",
                                  .columns = {inside},
                                  .mass_ratio = {inf},
                                  .max_steps = 3000.0});
        for (std::size_t i = 0; i < inside.size(); ++i) {
            EXPECT_EQ(endless.end[i], outcome::budget) << inside[i];
            EXPECT_GE(endless.bounces[i], 2999.0);
        }
        const std::vector<double> outside{left - 1e-3, end + 1e-3};
        const auto caught = run({.model = "passive_juggler",
                                 .columns = {outside},
                                 .mass_ratio = {inf},
                                 .max_steps = 3000.0});
        for (std::size_t i = 0; i < outside.size(); ++i)
            EXPECT_EQ(caught.end[i], outcome::ok) << outside[i];
    }
}

TEST(passive_published, period_one_bouncing_window_ends_at_the_root_of_p2_pi2_plus_3) {
    // Period-one bouncing: V = p pi, hand phase fixed by alpha. Inside the window small deviations
    // die out (multiplier between -1 and 0 or 0 and 1), beyond it they alternate. Bounce speed
    // after 3000 bounces shows it: with M = infinity the juggler's ball returns at v1 = V, so that
    // two successive flights of a period-one motion take the same time, 2 p pi.
    for (const double offset : {-0.05, 0.05}) {
        const double alpha = std::sqrt(M_PI * M_PI + 3.0) + offset;
        const auto at = [&](double steps) {
            return run({.model = "passive_juggler",
                        .columns = {{alpha}},
                        .mass_ratio = {inf},
                        .max_steps = steps});
        };
        const double last = at(4001.0).time[0] - at(4000.0).time[0];
        const double previous = at(4000.0).time[0] - at(3999.0).time[0];
        if (offset < 0.0) {
            // times add up to 25000: an ulp of that is 4e-12
            EXPECT_NEAR(last, 2.0 * M_PI, 1e-10);
            EXPECT_NEAR(previous, 2.0 * M_PI, 1e-10);
        } else {
            EXPECT_GT(std::abs(last - previous), 0.1);  // period two, square-root growth
            const double before = at(3999.0).time[0] - at(3998.0).time[0];
            EXPECT_NEAR(last, before, 1e-10);
        }
    }
}

TEST(passive_published, bounces_per_hop_grow_like_a_tenth_of_the_mass_ratio) {
    for (const double mass_ratio : {1e3, 1e4, 1e5}) {
        double most = 0.0;
        rows of{.mass_ratio = {mass_ratio}};
        of.columns.emplace_back();
        for (int i = 0; i < 60; ++i) of.columns[0].push_back(3.16 + 0.01 * i);
        of.columns[0].push_back(3.7245);
        const auto all = run(of);
        for (std::size_t i = 0; i < all.end.size(); ++i) {
            ASSERT_EQ(all.end[i], outcome::ok);
            EXPECT_GT(all.speed[i], 2.9);  // the page: f falls to just below pi
            EXPECT_LT(all.speed[i], of.columns[0][i]);
            if (all.bounces[i] > 0.02 * mass_ratio) EXPECT_LT(all.speed[i], M_PI);
            if (all.bounces[i] > most) most = all.bounces[i];
        }
        // (alpha_2^2 - pi^2) / (4 pi^2) = 0.10146 per unit of 1/kappa, less end effects of O(sqrt
        // M)
        EXPECT_NEAR(most / mass_ratio, 0.101, 0.101 * 0.05) << mass_ratio;
    }
}

TEST(passive_published, attracting_set_at_mass_ratio_1_is_extremely_small) {
    const double alpha = to_double(lossless(1));
    const rows near{.columns = {{alpha + 0.0159187 * 0.9999, alpha + 0.0159187 * 1.0001}},
                    .returns = 2000,
                    .decided_by = decision::certificate,
                    .died_label = 1};
    const auto ends = run(near);
    EXPECT_EQ(ends.label[0], 2);
    EXPECT_EQ(ends.label[1], 1);
}

TEST(passive_published, damping_shifts_the_map_down_in_general_but_up_on_a_bounce_branch) {
    // page, section 10, last row; four digits after the point printed
    EXPECT_NEAR(hop(6.6, 1.0).speed, 1.3888, printed(4));
    EXPECT_NEAR(hop(6.6, 1.0, 0.0, 0.001).speed, 1.4316, printed(4));
    for (int k = 1; k <= 4; ++k) {
        const double alpha = to_double(lossless(k)) + 1e-3;
        EXPECT_LT(hop(alpha, 1.0, 0.0, 0.001).speed, hop(alpha, 1.0).speed);
    }
}

TEST(passive_published, reference_points_of_the_page) {
    struct point {
        double alpha, mass_ratio, speed;
        double bounces;
    };
    // 15 digits printed: half a unit of the last one, and the rounding of f itself (1 ulp)
    for (const point& p :
         {point{4.6, 1.0, 4.3923267672622, 0.0}, point{4.4, 1.0, 3.79019524258288, 1.0},
          point{6.6, 20.0, 5.50047202255799, 1.0}, point{3.4, 100.0, 3.03935467628838, 5.0}}) {
        const auto one = hop(p.alpha, p.mass_ratio);
        EXPECT_EQ(one.end, outcome::ok);
        EXPECT_NEAR(one.speed, p.speed, p.alpha == 4.6 ? 6e-14 : 6e-15 + 1e-15);
        EXPECT_EQ(one.bounces, p.bounces);
    }
    const history bounce = simulator({}).from_lift_off(4.4);
    EXPECT_NEAR(to_double(bounce.flight_time), 7.99611658215446, printed(14) + 1e-15);
    EXPECT_NEAR(to_double(simulator({}).from_lift_off(4.6).flight_time), 10.1421109948502,
                printed(13));
}

TEST(passive_published, speed_jumps_where_a_landing_has_y1_1_and_rises) {
    // page, section 8: M = 20 across alpha = 2 pi
    EXPECT_NEAR(hop(6.2831, 20.0).speed, 5.684692, printed(6));
    EXPECT_NEAR(hop(6.2833, 20.0).speed, 5.132068, printed(6));
}

}  // namespace
}  // namespace hopscotch
