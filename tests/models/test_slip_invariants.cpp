// The spring-mass runner's invariants: energy, mirror symmetry, limits, scaling, orbits taken up in
// the middle (models/slip.md, sections 1, 2 and 5).
#include "tests/models/slip_map.hpp"

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::slip_map;

/// Lift-off and stance states of one stride, in leg lengths and touchdown speeds.
struct stance_watch final : orbit_observer {
    double spring_energy = 0.0;  // least and largest energy over the stance's samples
    double least = 1e300, most = -1e300;
    std::array<double, 4> first{}, last{};  // of the whole stance, whatever its steps
    bool has_first = false;
    std::array<double, 3> numbers{};  // stiffness, gravity, is air
    void phase(const char* mode, double, double duration, const sampler& at) override {
        if (std::string_view(mode) != "stance") return;
        for (int i = 0; i <= 40; ++i) {
            double s[most_columns];
            at.state_at(duration * i / 40.0, s);
            const double length = std::hypot(s[0], s[1]);
            const double spring = numbers[2] > 0 ? 0.5 * numbers[0] * (1 / (length * length) - 1)
                                                 : 0.5 * numbers[0] * (length - 1) * (length - 1);
            const double energy = 0.5 * (s[2] * s[2] + s[3] * s[3]) + numbers[1] * s[1] + spring;
            least = std::min(least, energy);
            most = std::max(most, energy);
            if (!has_first) std::copy(s, s + 4, first.begin());
            has_first = true;
            std::copy(s, s + 4, last.begin());
        }
    }
    void event(const char*, double, const char*, const char*, const double*, const double*,
               double) override {}
};

TEST(slip_folds, leaving_the_ground_downward_above_touchdown_height_is_legal) {
    // page, case 11: heavy gravity, lift-off with w < 0 and y above sin(beta); inputs from a scan
    struct start {
        double beta, stiffness, gravity, angle;
    };
    for (const start& from : {start{1.01, 15.7, 4.06, -0.103},
                              {0.71, 9.95, 1.736, -0.441},
                              {1.18, 40.9, 3.31, -0.075}}) {
        const named_map m =
            by_numbers(from.beta, from.stiffness, from.gravity, from.angle, linear_on);
        stance_watch seen;
        m.trace(seen);
        EXPECT_LT(seen.last[3], 0.0) << from.beta;
        EXPECT_GT(seen.last[1], std::sin(from.beta)) << from.beta;
        const orbit_answer answer = m.answer();
        ASSERT_EQ(answer.end, outcome::ok) << from.beta;
        // D = w^2 + 2 gt (y - sin beta): the fall to the next touchdown
        const double fall =
            seen.last[3] * seen.last[3] + 2 * from.gravity * (seen.last[1] - std::sin(from.beta));
        EXPECT_NEAR(std::sin(std::stod(answer.columns[1])), std::sqrt(fall), 1e-12) << from.beta;
    }
}

TEST(slip_folds, stances_conserve_energy_and_the_next_touchdowns_speed) {
    for (const choices& options : {linear_off, air_off, linear_on, air_on}) {
        const bool is_air = !options.empty() && options[0].second == "air";
        const bool has_gravity = options.empty() || options.back().second == "air";
        const double stiffness = is_air ? 0.8 : 8.0;
        for (const double angle : {0.05, 0.2, 0.35}) {
            const named_map m = by_numbers(1.0, stiffness, 0.1, angle, options);
            stance_watch seen;
            seen.numbers = {stiffness, has_gravity ? 0.1 : 0.0, is_air ? 1.0 : 0.0};
            m.trace(seen);
            EXPECT_LT(seen.most - seen.least, 4e-14) << is_air << has_gravity << angle;
            if (!has_gravity) continue;
            // u^2 + D = 1, D = w^2 + 2 gt (y - sin beta) at lift-off
            const auto& s = seen.last;
            EXPECT_NEAR(s[2] * s[2] + s[3] * s[3] + 0.2 * (s[1] - std::sin(1.0)), 1.0, 2e-14);
        }
    }
}

TEST(slip_folds, gaits_are_mirror_images_about_midstance) {
    const named_map gait = periodic_point(runner(1.0, 100.0, 1.0, 8.0, 0.16, linear_on)
                                              .with({{"leg_length", 1.5}, {"angle", 0.1412}}));
    stance_watch seen;
    gait.trace(seen);
    EXPECT_NEAR(seen.last[0], -seen.first[0], 1e-12);
    EXPECT_NEAR(seen.last[1], seen.first[1], 1e-12);
    EXPECT_NEAR(seen.last[2], seen.first[2], 1e-12);
    EXPECT_NEAR(seen.last[3], -seen.first[3], 1e-12);
    const auto momentum = [](const std::array<double, 4>& s) { return s[1] * s[2] - s[0] * s[3]; };
    EXPECT_NEAR(momentum(seen.last), momentum(seen.first), 1e-12);
}

TEST(slip_folds, neglecting_gravity_in_stance_is_the_limit_of_little_gravity) {
    for (const bool is_air : {false, true}) {
        const auto difference = [&](double gravity) {
            const double stiffness = is_air ? 0.8 : 8.0;
            const named_map with =
                by_numbers(1.0, stiffness, gravity, 0.25, is_air ? air_on : linear_on);
            const named_map without =
                by_numbers(1.0, stiffness, gravity, 0.25, is_air ? air_off : linear_off);
            return with.image().to[0] - without.image().to[0];
        };
        EXPECT_LT(std::abs(difference(1e-6)), 1e-5);
        EXPECT_NEAR(difference(2e-5) / difference(1e-5), 2.0, 1e-3);  // first order in gravity
    }
}

TEST(slip_folds, only_three_numbers_matter) {
    // gamma = k eta0 / (m g) = kt / gt of Figs. 2 and 4, to the digits printed; the same stride by
    // k, g and the speed, and by the groups
    const std::pair<double, double> rows[] = {{654.0, 100.0},  {163.5, 25.0},   {65.4, 10.0},
                                              {2000.0, 305.8}, {1000.0, 152.9}, {250.0, 38.2},
                                              {100.0, 15.3}};
    for (const auto& [stiffness, gamma] : rows) {
        EXPECT_NEAR(stiffness * 1.5 / 9.81, gamma, 0.051) << stiffness;
        const double gravity = 0.02;
        const double speed = std::sqrt(9.81 * 1.5 / gravity);
        const named_map by_hand = runner(1.5, stiffness, 1.0, speed, 0.1, linear_on);
        const named_map groups =
            by_numbers(1.0, stiffness * 1.5 / 9.81 * gravity, gravity, 0.1, linear_on);
        ASSERT_EQ(by_hand.image().end, groups.image().end) << stiffness;
        EXPECT_NEAR(std::stod(by_hand.answer().extras[0]), std::stod(groups.answer().extras[0]),
                    2e-14)
            << stiffness;
    }
    for (const choices& options : {linear_off, air_off, linear_on, air_on}) {
        const bool is_air = !options.empty() && options[0].second == "air";
        const double stiffness = is_air ? 0.8 : 8.0;
        const named_map one = by_numbers(1.0, stiffness, 0.1, 0.25, options);
        const double leg = 0.7, mass = 3.0, speed = 2.5;
        const double scale =
            is_air ? mass * speed * speed * leg * leg : mass * speed * speed / (leg * leg);
        const named_map other = one.with({{"leg_length", leg},
                                          {"mass", mass},
                                          {"speed", speed},
                                          {"stiffness", stiffness * scale},
                                          {"gravity", 0.1 * speed * speed / leg}});
        EXPECT_NEAR(other.image().to[0], one.image().to[0], 2e-14);
    }
}

TEST(slip_folds, orbits_go_on_from_any_of_their_touchdowns) {
    for (const named_map& m : {runner(1.5, 100.0, 1.25, 4.6, 0.25, linear_off),
                               figure_12(1.65, 0.25), runner(1.5, 100.0, 1.0, 8.0, 0.15, linear_on),
                               runner(0.17, 0.03839, 0.961, 1.65, 0.25, air_on)}) {
        const orbit_answer whole = m.answer(7);
        ASSERT_EQ(whole.end, outcome::ok);
        EXPECT_EQ(m.after(3).answer(4).columns, whole.columns);
    }
}

}  // namespace
}  // namespace hopscotch
