// Starts of the passive hopper: the page's table of degenerate states (models/passive_hopper.md,
// section 2), starts that mean nothing.
#include "tests/models/contact_starts.hpp"

#include "tests/models/passive_rows.hpp"
#include "tests/models/passive_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hopscotch {
namespace {

using namespace passive_truth;
using namespace testing_models::contact_starts;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

}  // namespace
}  // namespace hopscotch
