// What must hold for ever: a runner's speed, contact that is reached by chatter and never faked.
#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace hopscotch;
using testing_models::named_map;

namespace {

named_map runner(const char* stance_gravity, double touchdown_angle, double speed, double angle) {
    return named_map("slip", "touchdown",
                     {{"leg_length", 1.5},
                      {"stiffness", 100.0},
                      {"touchdown_angle", touchdown_angle},
                      {"speed", speed},
                      {"angle", angle}},
                     {{"stance_gravity", stance_gravity}});
}

void expect_constant_speed(std::uint32_t strides) {
    // gaits that attract: Fig. 8 (no gravity in stance) and Fig. 4 (with it) of Ghigliazza et al.
    for (const named_map& map : {runner("off", 1.25, 4.5, 0.2), runner("on", 1.0, 8.0, 0.1)}) {
        const orbit_answer answer = map.answer(strides);
        EXPECT_EQ(answer.end, outcome::ok);
        EXPECT_EQ(answer.returns, strides);
        EXPECT_EQ(std::stod(answer.columns[0]), map.start[0]);  // not by one ulp
    }
}

named_map elastic_hopper(double restitution, double alpha) {
    return named_map("passive_hopper", "liftoff",
                     {{"mass_ratio", 1.0}, {"restitution", restitution}, {"liftoff_speed", alpha}});
}

}  // namespace

TEST(long_runs, a_runners_speed_does_not_drift_over_many_strides) { expect_constant_speed(3000); }

TEST(long_runs, slow_a_runners_speed_does_not_drift_over_a_million_strides) {
    expect_constant_speed(1'000'000);
}

/// Lift-off speeds of passive hoppers, for ten stretches of returns from one start: none rises over
/// the one before, and none falls through the lossless speed (tan(alpha) = alpha) that a hopper
/// of mass ratio 20 approaches; with 0.3 hops shrink like 1 / n^(1/4). What the
/// impacts took is what the speed has lost, to the sum's roundings.
void expect_no_rise(std::uint32_t returns_per_stretch) {
    struct long_orbit {
        double mass_ratio, start, least;
    };
    constexpr long_orbit orbits[] = {
        {20.0, 4.5934, 4.493409457909064}, {20.0, 7.8252, 7.725251836937707}, {0.3, 4.5934, 0.0}};
    for (const auto& [mass_ratio, start, least] : orbits) {
        double last = start;
        for (std::uint32_t stretch = 1; stretch <= 10; ++stretch) {
            const named_map map("passive_hopper", "liftoff",
                                {{"mass_ratio", mass_ratio}, {"liftoff_speed", start}});
            const orbit_answer answer = map.answer(stretch * returns_per_stretch);
            ASSERT_EQ(answer.end, outcome::ok) << mass_ratio << " " << start;
            const double speed = std::stod(answer.columns[0]);
            EXPECT_LE(speed, last) << mass_ratio << " " << start << " " << stretch;
            EXPECT_GE(speed, least) << mass_ratio << " " << start << " " << stretch;
            const double lost = (start - speed) * (start + speed);
            // one rounding of the sum per return, in random directions
            const double allowed = 1e-15 * lost * std::sqrt(10.0 * returns_per_stretch) * 10.0;
            EXPECT_NEAR(std::stod(answer.extras[1]), lost, allowed);
            last = speed;
        }
    }
}

TEST(long_runs, a_passive_hoppers_energy_never_rises) { expect_no_rise(1000); }

TEST(long_runs, slow_a_passive_hoppers_energy_never_rises_over_ten_million_returns) {
    expect_no_rise(1'000'000);
}

TEST(long_runs, contact_is_reached_by_chatter_for_restitution_below_one) {
    for (const double restitution : {0.1, 0.5, 0.9, 0.99, 0.995}) {
        for (const double alpha : {2.0, 4.4, 6.0}) {
            const orbit_answer answer = elastic_hopper(restitution, alpha).answer(1);
            const bool is_reached = answer.end == outcome::stuck || answer.end == outcome::ok;
            EXPECT_TRUE(is_reached) << restitution << " " << alpha << " " << name_of(answer.end);
            EXPECT_GT(std::stod(answer.extras[1]), 0.0) << "impacts take energy";
        }
    }
}

TEST(long_runs, contact_is_never_faked_where_impacts_are_elastic) {
    for (const double alpha : {2.0, 4.4, 6.0}) {
        const orbit_answer answer = elastic_hopper(1.0, alpha).answer(1);
        EXPECT_EQ(answer.end, outcome::budget) << alpha;  // 10^5 bounces, and still bouncing
        EXPECT_EQ(answer.returns, 0u);
        EXPECT_EQ(std::stod(answer.extras[1]), 0.0);  // not one of them has taken energy
    }
}
