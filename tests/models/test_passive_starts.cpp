// Starts of every kind: the degenerate states of section 2 row by row, hopper against juggler,
// invalid input, and restarts from the middle of a flight that must not change the orbit.
#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hopscotch {
namespace {

using namespace passive_truth;
using passive_rows::answers;
using passive_rows::hop;
using passive_rows::rows;
using passive_rows::run;
using passive_rows::single_return;
using passive_rows::start;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

single_return juggle(double w1, double w1dot, double w2, double w2dot, double mass_ratio,
                     double restitution = 0.0, double damping = 0.0) {
    const answers one = run({.model = "passive_juggler",
                             .section = passive_rows::flight,
                             .columns = {{w1}, {w1dot}, {w2}, {w2dot}},
                             .mass_ratio = {mass_ratio},
                             .restitution = {restitution},
                             .damping = {damping}});
    return {one.end[0], one.speed[0], one.bounces[0], one.loss[0], one.time[0]};
}

// ---- the degenerate states, y2 = 0 ----

TEST(passive_starts, y1_above_1_at_rest_on_the_ground_flies_at_once_and_counts_the_landing) {
    for (const double mass_ratio : {0.3, 1.0, 5.0}) {
        const history truth = simulator({.mass_ratio = mass_ratio})
                                  .next_lift_off({1.5, 2.0, 0.0, 0.0}, passive_truth::launch::rest);
        const single_return one = start(1.5, 2.0, 0.0, 0.0, mass_ratio);
        ASSERT_EQ(one.end == outcome::ok, truth.lifts);
        if (truth.lifts)
            EXPECT_NEAR(one.speed, to_double(truth.speed), 1e-13);  // well conditioned start
        EXPECT_NEAR(one.loss, to_double(truth.loss), 1e-13);
        EXPECT_EQ(one.bounces, truth.impacts - 1.0);
    }
}

TEST(passive_starts, y1_below_1_at_rest_on_the_ground_stays_in_contact) {
    // from rest at Y: alpha^2 = (Y - 1)(M (Y + 1) + 2) / (1 + M), M = 1, Y = -6: 7 * 3 / 2
    const single_return one = start(-6.0, 0.0, 0.0, 0.0, 1.0);
    EXPECT_EQ(one.end, outcome::ok);
    EXPECT_NEAR(one.speed, std::sqrt(10.5), 1e-15);
    EXPECT_EQ(one.bounces, 0.0);
    EXPECT_EQ(one.loss, 0.0);
    // half a period about -1 minus the arc above y1 = 1: cos(w t) = -2/5 on the way up from -5
    EXPECT_NEAR(one.time, (M_PI - std::acos(0.4)) * std::sqrt(2.0), 4e-15);
}

TEST(passive_starts, y1_1_rising_lifts_off_at_once_with_that_speed) {
    for (const double alpha : {0.5, 4.4, 4.6, 6.6, 9.0}) {
        const single_return lift = hop(alpha, 1.0);
        const single_return state = start(1.0, alpha, 0.0, 0.0, 1.0);
        ASSERT_EQ(state.end, lift.end);
        if (lift.end == outcome::ok) EXPECT_NEAR(state.speed, lift.speed, 1e-13) << alpha;
        EXPECT_EQ(state.bounces, lift.bounces);
        EXPECT_NEAR(state.time, lift.time, 1e-12);
    }
}

TEST(passive_starts, y1_1_falling_is_the_lossless_landing_and_returns_its_speed) {
    for (const double alpha : {0.5, 4.493409457909064, 7.7, 30.0}) {
        const single_return one = start(1.0, -alpha, 0.0, 0.0, 1.0);
        EXPECT_EQ(one.end, outcome::ok);
        EXPECT_NEAR(one.speed, alpha, 2e-16 * alpha);  // a square and a root
        EXPECT_EQ(one.bounces, 0.0);
        EXPECT_EQ(one.loss, 0.0);
    }
}

TEST(passive_starts, y1_1_at_rest_is_absorbing) {
    const single_return one = start(1.0, 0.0, 0.0, 0.0, 1.0);
    EXPECT_TRUE(one.end == outcome::stuck || one.end == outcome::rest);
    EXPECT_EQ(one.time, 0.0);
    EXPECT_TRUE(hop(0.0, 1.0).end == outcome::stuck || hop(0.0, 1.0).end == outcome::rest);
}

TEST(passive_starts, contact_without_enough_energy_is_stuck) {
    // M = 1: alpha^2 = (Y - 1)(Y + 3) / 2 < 0 for -3 < Y < 1 at rest
    for (const double y : {-2.999, -1.0, 0.0, 0.999})
        EXPECT_EQ(start(y, 0.0, 0.0, 0.0, 1.0).end, outcome::stuck);
    EXPECT_EQ(start(-3.001, 0.0, 0.0, 0.0, 1.0).end, outcome::ok);
}

TEST(passive_starts, foot_moving_down_on_the_ground_strikes_first) {
    const double v2 = -2.0;
    const single_return one = start(-6.0, 0.0, 0.0, v2, 1.0);
    EXPECT_EQ(one.end, outcome::ok);
    EXPECT_NEAR(one.speed, std::sqrt(10.5), 1e-15);  // y1, v1 are not changed by the impact
    EXPECT_EQ(one.loss, 4.0);                        // M v2^2 (1 - e^2)
    EXPECT_EQ(one.bounces, 0.0);
    const single_return off = start(1.5, 2.0, 0.0, v2, 1.0);  // F > 1: leaves again at once
    const single_return same = start(1.5, 2.0, 0.0, 0.0, 1.0);
    EXPECT_EQ(off.end, same.end);
    EXPECT_NEAR(off.speed, same.speed, 1e-13);
    EXPECT_EQ(off.bounces, same.bounces + 1.0);
    EXPECT_NEAR(off.loss, same.loss + 4.0, 1e-14);  // two flights, some roundings apart
}

TEST(passive_starts, foot_moving_up_on_the_ground_flies) {
    for (const double y1 : {-3.0, 0.5, 1.0, 2.0}) {
        const simulator hopper({});
        const history truth = hopper.next_lift_off(hopper.hopper_state(y1, 0.5, 0.0, 1.5),
                                                   passive_truth::launch::free);
        const single_return one = start(y1, 0.5, 0.0, 1.5, 1.0);
        ASSERT_EQ(one.end == outcome::ok, truth.lifts) << y1;
        EXPECT_NEAR(one.loss, to_double(truth.loss), 1e-13);
        if (truth.lifts) EXPECT_NEAR(one.speed, to_double(truth.speed), 1e-13) << y1;
    }
}

TEST(passive_starts, foot_below_the_ground_and_numbers_that_are_none_are_invalid_starts) {
    EXPECT_EQ(start(0.0, 0.0, -1e-300, 0.0, 1.0).end, outcome::invalid_start);
    EXPECT_EQ(start(0.0, 0.0, -1.0, 5.0, 1.0).end, outcome::invalid_start);
    EXPECT_EQ(juggle(-1.0, 0.0, 0.0, 0.0, 1.0).end, outcome::invalid_start);
    for (const double bad : {nan, inf, -inf}) {
        for (std::size_t c = 0; c < 4; ++c) {
            double state[4] = {0.5, 0.1, 1.0, 0.2};
            state[c] = bad;
            for (int variant = 0; variant < 4; ++variant) {
                const answers one =
                    run({.section = passive_rows::flight,
                         .columns = {{state[0]}, {state[1]}, {state[2]}, {state[3]}}},
                        backend::scalar, variant);
                EXPECT_EQ(one.end[0], outcome::invalid_start) << c << " " << bad;
            }
        }
        EXPECT_EQ(hop(bad, 1.0).end, outcome::invalid_start);
    }
    EXPECT_EQ(hop(-1e-300, 1.0).end, outcome::invalid_start);
    EXPECT_EQ(hop(-4.6, 1.0).end, outcome::invalid_start);
}

TEST(passive_starts, parameters_that_are_no_numbers_never_end_as_ok) {
    for (int variant = 0; variant < 4; ++variant) {
        for (const double alpha : {4.4, 4.6}) {
            const rows good{.columns = {{alpha}}};
            for (int p = 0; p < 4; ++p) {
                rows bad = good;
                (p == 0   ? bad.mass_ratio
                 : p == 1 ? bad.restitution
                 : p == 2 ? bad.damping
                          : bad.increment) = {nan};
                const answers one = run(bad, backend::scalar, variant);
                EXPECT_TRUE(one.end[0] == outcome::not_finite ||
                            one.end[0] == outcome::unresolved_event)
                    << "parameter " << p << " variant " << variant << " " << name_of(one.end[0]);
            }
        }
    }
}

TEST(passive_starts, huge_states_end_with_an_outcome) {
    // beyond 1e16 no event can be told apart; what matters is that the search comes to an end
    for (const double huge : {1e17, 1e60, 1e160, 1e308}) {
        for (std::size_t c = 0; c < 4; ++c) {
            double state[4] = {0.5, 0.1, 1.0, 0.2};
            state[c] = huge;
            for (const double restitution : {0.0, 0.5}) {
                const single_return one =
                    start(state[0], state[1], state[2], state[3], 1.0, restitution);
                if (one.end == outcome::ok)
                    EXPECT_TRUE(std::isfinite(one.speed)) << huge << " " << c;
            }
        }
        const single_return one = hop(huge, 0.5);
        if (one.end == outcome::ok) EXPECT_LE(one.speed, huge);
    }
}

TEST(passive_starts, damped_hopper_that_starts_above_its_springs_reach_comes_down) {
    // far longer in the air than the spring oscillates
    for (const double height : {1e2, 1e4}) {
        const single_return one = start(height, 0.0, height, 0.0, 1.0, 0.0, 0.1);
        ASSERT_TRUE(one.end == outcome::ok || one.end == outcome::stuck);
        // fall of c = 2 height - 1 with the spring at rest: impact at v = sqrt(4 height), spring
        // relaxed
        const double c = 2.0 * height - 1.0;
        const history truth =
            simulator({.damping = 0.1})
                .next_lift_off({0.0, 0.0, 2.0 * height, 0.0}, passive_truth::launch::free);
        ASSERT_EQ(one.end == outcome::ok, truth.lifts);
        EXPECT_NEAR(one.time / to_double(truth.time), 1.0, 1e-13);
        EXPECT_NEAR(to_double(truth.flight_time), std::sqrt(2.0 * (c + 1.0)), 1e-6);
    }
}

// ---- hopper and juggler ----

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
