// Hopper and juggler states that are the same motion, and orbits taken up in the air
// (models/passive_hopper.md, sections 1 and 13).
#include "tests/models/contact_starts.hpp"

#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hopscotch {
namespace {

using namespace passive_truth;
using namespace testing_models::contact_starts;

TEST(passive_starts, equivalent_hopper_and_juggler_states_give_the_same_orbit) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 300; ++i) {
        // quarters and powers of two: both coordinate sets are exact in double
        const double mass_ratio = std::ldexp(1.0, static_cast<int>(random() % 9) - 4);
        const auto quarter = [&](double range) {
            return std::round(4.0 * range * (2.0 * share(random) - 1.0)) / 4.0;
        };
        const double y1 = quarter(6.0);
        const double v1 = quarter(6.0);
        const double y2 = std::abs(quarter(4.0));
        const double v2 = y2 == 0.0 ? std::abs(quarter(3.0)) : quarter(3.0);
        const double restitution = i % 3 == 0 ? 0.4 : 0.0;
        const single_return hopper = start(y1, v1, y2, v2, mass_ratio, restitution);
        const single_return juggler = juggle(y1 - 1.0 + mass_ratio * y2, v1 + mass_ratio * v2,
                                             y1 - 1.0 - y2, v1 - v2, mass_ratio, restitution);
        ASSERT_EQ(hopper.end, juggler.end) << i;
        // Eq (6) is exact here and one engine serves both: the same bits
        EXPECT_EQ(hopper.speed, juggler.speed) << i;
        EXPECT_EQ(hopper.time, juggler.time) << i;
        EXPECT_EQ(hopper.loss, juggler.loss) << i;
        EXPECT_EQ(hopper.bounces, juggler.bounces) << i;
    }
}

TEST(passive_starts, equivalent_juggler_states_give_the_hopper_orbit_back) {
    for (const double w1 : {0.25, 2.0, 5.5}) {
        for (const double w2 : {-3.25, -1.0, 0.0}) {
            const double mass_ratio =
                3.0;  // inverse of Eq (6): y2 = (w1 - w2) / 4, y1 = 1 + (w1 + 3 w2) / 4
            const single_return juggler = juggle(w1, 0.5, w2, -1.5, mass_ratio);
            const single_return hopper = start(1.0 + (w1 + mass_ratio * w2) / 4.0,
                                               (0.5 - 4.5) / 4.0, (w1 - w2) / 4.0, 0.5, mass_ratio);
            ASSERT_EQ(juggler.end, hopper.end);
            EXPECT_EQ(juggler.speed, hopper.speed);
            EXPECT_EQ(juggler.time, hopper.time);
        }
    }
}

TEST(passive_starts, juggler_of_unbounded_mass_ratio_follows_hand_and_ball_apart) {
    // hand at its lowest -1 - a, ball on it: leaves at w2 = 0 with alpha^2 = a^2 - 1
    const single_return thrown = juggle(-6.0, 0.0, -6.0, 0.0, inf);
    EXPECT_EQ(thrown.end, outcome::ok);
    EXPECT_NEAR(thrown.speed, std::sqrt(24.0), 2e-15);
    EXPECT_NEAR(thrown.time, M_PI - std::acos(0.2), 1e-15 * 4.0);
    const history truth = simulator({.is_unbounded = true})
                              .next_lift_off({0.0, 3.0, 2.0, -1.0}, passive_truth::launch::free);
    const single_return flown = juggle(1.0, 2.0, -1.0, 3.0, inf);
    ASSERT_EQ(flown.end == outcome::ok, truth.lifts);
    EXPECT_NEAR(flown.speed, to_double(truth.speed), 1e-13);
}

// ---- restart ----

TEST(passive_starts, restart_from_any_moment_of_a_flight_reaches_the_same_lift_off) {
    struct orbit {
        double alpha, mass_ratio, damping;
    };
    for (const orbit& of : {orbit{4.6, 1.0, 0.0}, orbit{4.4, 1.0, 0.0}, orbit{7.3, 4.0, 0.0},
                            orbit{10.1, 0.3, 0.0}, orbit{5.0, 1.0, 0.05}}) {
        const simulator hopper({.mass_ratio = of.mass_ratio, .damping = of.damping});
        const motion launched = hopper.lift_off_state(of.alpha);
        const history truth = hopper.from_lift_off(of.alpha);
        ASSERT_TRUE(truth.lifts);
        for (int i = 1; i < 24; ++i) {
            const real50 t = truth.flight_time * (i / 24.0);
            const motion now = hopper.at(launched, t);
            const real50 share = real50(1.0) / (real50(of.mass_ratio) + 1.0);
            const double y2 = to_double(now.gap * share);
            const double v2 = to_double(now.gap_rate * share);
            const double y1 = to_double(now.spring + now.gap * share);
            const double v1 = to_double(now.spring_rate + now.gap_rate * share);
            const single_return rest = start(y1, v1, y2, v2, of.mass_ratio, 0.0, of.damping);
            ASSERT_EQ(rest.end, outcome::ok) << of.alpha << " " << i;
            // the state is rounded to double; |df/dstate| is below 100 on these orbits
            EXPECT_NEAR(rest.speed, to_double(truth.speed), 3e-13) << of.alpha << " " << i;
            EXPECT_NEAR(rest.time, to_double(truth.time - t), 3e-13 * 10.0) << of.alpha << " " << i;
            EXPECT_EQ(rest.bounces, truth.impacts - 1.0);
            EXPECT_NEAR(rest.loss, to_double(truth.loss), 1e-11) << of.alpha << " " << i;
        }
    }
}

TEST(passive_starts, apex_of_the_lossless_motion_leads_back_to_it) {
    // mid-flight: velocities 0, h = c = alpha*^2 / 2, a = -s = (-1)^(k+1) sqrt(1 + alpha*^2) (page,
    // section 6) ten digits, the page's last one of h a unit high
    EXPECT_NEAR(to_double(lossless(1) * lossless(1) * 0.5), 10.0953642783, 1e-10);
    EXPECT_NEAR(to_double(sqrt(lossless(1) * lossless(1) + 1.0)), 4.6033388488, 5e-11);
    for (int k = 1; k <= 5; ++k) {
        const real50 c = lossless(k) * lossless(k) * 0.5;
        const real50 s = sqrt(lossless(k) * lossless(k) + 1.0) * (k % 2 == 0 ? 1.0 : -1.0);
        for (const double mass_ratio : {0.2, 1.0, 7.0}) {
            const double y2 = to_double((c + 1.0 - s) / (real50(mass_ratio) + 1.0));
            const single_return one =
                start(to_double((c + 1.0 + real50(mass_ratio) * s) / (real50(mass_ratio) + 1.0)),
                      0.0, y2, 0.0, mass_ratio);
            ASSERT_EQ(one.end, outcome::ok);
            // rounded state: beta of 1e-15 either side; f' = 1, the loss is its 4/3 power
            EXPECT_NEAR(one.speed, to_double(lossless(k)), 3e-14) << k << " " << mass_ratio;
            EXPECT_LT(one.loss, 1e-10);
        }
    }
}

TEST(passive_starts, two_returns_are_one_return_twice) {
    for (const double alpha : {4.6, 7.9, 9.3, 12.6}) {
        const answers both = run({.columns = {{alpha}}, .mass_ratio = {0.1}, .returns = 2});
        const single_return first = hop(alpha, 0.1);
        const single_return second = hop(first.speed, 0.1);
        ASSERT_EQ(both.end[0], outcome::ok);
        // the lane keeps beta, the second start rounds it into alpha: an ulp, times |f'| < 10
        EXPECT_NEAR(both.speed[0], second.speed, 2e-14);
        EXPECT_NEAR(both.time[0], first.time + second.time, 1e-12);
        EXPECT_EQ(both.bounces[0], first.bounces + second.bounces);
        EXPECT_NEAR(both.loss[0], first.loss + second.loss, 1e-12);
    }
}

}  // namespace
}  // namespace hopscotch
