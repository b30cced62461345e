// The spring-mass runner's gaps and hard cases next to folds, at high speeds and under heavy
// gravity (models/slip.md, sections 11 and 13).
#include "tests/models/slip_map.hpp"

#include "tests/models/named_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace hopscotch {
namespace {

using namespace testing_models;
using namespace testing_models::slip_map;

/// Does some angle in (0, beta) make the runner stumble? The stumbling angles closest to birth lie
/// around the least D = (angle')^2, so the search narrows on the least next angle.
bool has_gap(named_map m, double beta) {
    double low = 0.0;
    double high = beta;
    for (int level = 0; level < 6; ++level) {
        double place = low;
        double least = 10.0;
        const double step = (high - low) / 60;
        for (int i = 1; i < 60; ++i) {
            m.start[1] = low + i * step;
            const map_image f = m.image();
            if (f.end == outcome::stumble) return true;
            if (f.end != outcome::ok) break;
            if (f.to[0] < least) least = f.to[0], place = m.start[1];
        }
        low = std::max(place - step, 0.0);
        high = place + step;
    }
    return false;
}

TEST(slip_folds, gaps_open_at_the_reproduced_speeds) {
    struct row {
        named_map m;
        double beta, speed, digit;
    };
    const row rows[] = {
        {runner(1.5, 50.0, 0.8, 0.0, 0.0, linear_off), 0.8, 9.58613, 1e-5},
        {runner(1.5, 100.0, 1.0, 0.0, 0.0, linear_off), 1.0, 10.593, 1e-3},
        {figure_9(0.0), M_PI / 4, 3.97090, 1e-5},
        {figure_12(0.0), 0.961, 1.715498, 1e-6},
    };
    for (const row& r : rows) {
        EXPECT_FALSE(has_gap(r.m.with("speed", r.speed - r.digit), r.beta)) << r.speed;
        EXPECT_TRUE(has_gap(r.m.with("speed", r.speed + r.digit), r.beta)) << r.speed;
    }
}

TEST(slip_folds, period_doubles_before_the_gap_only_under_much_gravity) {
    // Fig. 15, air spring, beta = 1.25: gt = 1 flips at ct = 1.33, the gap opens at 1.31; at
    // gt = 0.5 the gap comes first as the spring softens
    const named_map strong =
        point_with_multiplier(by_numbers(1.25, 1.33, 1.0, 0.05, air_on), "stiffness", -1.0);
    EXPECT_NEAR(strong.value("stiffness"), 1.33, 6e-3);
    const auto gap_opens = [](double gravity, double soft, double hard) {
        for (int i = 0; i < 24; ++i) {
            const double middle = 0.5 * (soft + hard);
            (has_gap(by_numbers(1.25, middle, gravity, 0.0, air_on), 1.25) ? soft : hard) = middle;
        }
        return soft;
    };
    const double gap = gap_opens(1.0, 1.25, 1.4);
    EXPECT_NEAR(gap, 1.31, 0.02);               // "~1.31"
    EXPECT_LT(gap, strong.value("stiffness"));  // as the spring softens the flip comes first
    const double weak_gap = gap_opens(0.5, 0.5, 1.2);
    const named_map at_gap = periodic_point(by_numbers(1.25, weak_gap * 1.0001, 0.5, 0.08, air_on));
    EXPECT_GT(largest_multiplier(at_gap), -1.0);
}

TEST(slip_folds, map_falls_to_zero_like_a_root_at_the_gaps_edge) {
    const named_map m = figure_12(1.7163);
    double inside = 0.36359;
    double outside = 0.30;
    ASSERT_EQ(m.with("angle", inside).image().end, outcome::stumble);
    ASSERT_EQ(m.with("angle", outside).image().end, outcome::ok);
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (inside + outside);
        (m.with("angle", middle).image().end == outcome::ok ? outside : inside) = middle;
    }
    const map_image near = m.with("angle", outside - 1e-8).image();
    const map_image far = m.with("angle", outside - 4e-8).image();
    EXPECT_NEAR(far.to[0] / near.to[0], 2.0, 1e-3);
    EXPECT_NEAR(far.jacobian(0, 0) / near.jacobian(0, 0), 0.5, 1e-3);
}

TEST(slip_folds, fixed_points_part_like_the_root_of_the_distance_from_their_fold) {
    const named_map fold =
        point_with_multiplier(runner(1.5, 100.0, 1.25, 4.2325, 0.4, linear_off), "speed", 1.0);
    const auto gap = [&](double distance) {
        named_map upper = fold.with("speed", fold.value("speed") * (1.0 + distance));
        named_map lower = upper;
        upper.start[1] += 2.0 * std::sqrt(distance);
        lower.start[1] -= 2.0 * std::sqrt(distance);
        return angle_of(periodic_point(upper)) - angle_of(periodic_point(lower));
    };
    EXPECT_NEAR(gap(1e-4) / gap(1e-6), 10.0, 0.1);
    EXPECT_NEAR(gap(1e-6) / gap(1e-8), 10.0, 0.01);
    // below the fold a ghost holds the runner up, longer the closer
    const auto strides = [&](double distance) {
        named_map m = fold.with("speed", fold.value("speed") * (1.0 - distance));
        return m.answer(1000000).returns;
    };
    EXPECT_NEAR(strides(1e-8) / static_cast<double>(strides(4e-8)), 2.0, 0.1);
    EXPECT_GT(strides(1e-8), 1000u);
}

TEST(slip_folds, high_speeds_keep_their_digits) {
    // v^2 angle -> J; page, case 6: v = 1000, angle 2.8e-6 for k = 10, beta = pi/4
    const double beta = M_PI / 4;
    const double limit =
        10.0 * 1.5 * 1.5 * std::sin(beta) * (std::asinh(1.0 / std::tan(beta)) - std::cos(beta));
    const named_map fixed = periodic_point(figure_9(1000.0, limit * 1e-6));
    EXPECT_NEAR(angle_of(fixed), 2.8e-6, 6e-8);
    EXPECT_NEAR(angle_of(fixed) * 1e6 / limit, 1.0, 1e-4);  // the correction falls like 1 / v^2
    const double multiplier = -1 - 2 * 9.81 * 1.5 * std::cos(beta) / limit;
    EXPECT_NEAR(multiplier, -8.506, 6e-4);
    EXPECT_NEAR(largest_multiplier(fixed), multiplier, 1e-3);
    const orbit_answer plain = fixed.answer();
    const orbit_answer truth = fixed.answer(1, digits::fifty);
    EXPECT_NEAR(std::stod(plain.columns[1]) / std::stod(truth.columns[1]), 1.0, 1e-9);
    // the air spring's limit
    const double b = 1.5 * std::sin(1.25);
    const double air_limit =
        23.0 * b * (std::cos(1.25) / (2 * b * b * 1.5) + (M_PI / 2 - 1.25) / (2 * b * b * b));
    const named_map air =
        periodic_point(runner(1.5, 23.0, 1.25, 1000.0, air_limit * 1e-6, air_off));
    EXPECT_NEAR(angle_of(air) * 1e6 / air_limit, 1.0, 1e-4);
}

TEST(slip_folds, starts_beyond_the_leg_sweep_backward_and_reverse_next) {
    for (const choices& options : {linear_off, air_off}) {
        const bool is_air = options.size() == 2;
        const auto stride = [&](double angle) {
            return by_numbers(1.2, is_air ? 0.5 : 5.0, 0.1, angle, options).answer();
        };
        EXPECT_NEAR(std::stod(stride(1.3).extras[0]), -std::stod(stride(1.1).extras[0]), 1e-14);
        named_map m = by_numbers(1.2, is_air ? 0.5 : 5.0, 0.1, 1.3, options);
        const orbit_answer two = m.answer(2);
        EXPECT_EQ(two.end, outcome::reverse);
    }
}

TEST(slip_folds, heavy_gravity_is_resolved) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int ok = 0;
    for (int i = 0; i < 320; ++i) {  // the page: no stance without lift-off in 320 random cases
        const double beta = 0.7 + 0.8 * unit(random);
        const named_map m = by_numbers(beta, 2.0 + 40.0 * unit(random), 1.0 + 2.0 * unit(random),
                                       beta * unit(random), i % 2 == 0 ? linear_on : air_on);
        const orbit_answer plain = m.answer();
        EXPECT_NE(plain.end, outcome::no_liftoff);
        EXPECT_NE(plain.end, outcome::unresolved_event);
        ok += plain.end == outcome::ok ? 1 : 0;
        if (i % 40 != 0) continue;
        const orbit_answer truth = m.answer(1, digits::fifty);
        EXPECT_EQ(plain.end, truth.end) << i;
        EXPECT_NEAR(std::stod(plain.extras[0]), std::stod(truth.extras[0]), 1e-12) << i;
    }
    EXPECT_GT(ok, 20);
}

TEST(slip_folds, map_is_a_rounded_v_just_below_its_gap) {
    // page, case 4: P ~ sqrt(Dmin + a (delta - delta*)^2), so second differences of P^2 about its
    // least are those of a parabola: four times as large for twice the distance
    const double edge = 1.715498;
    for (const double below : {1e-4, 1e-5}) {
        const named_map m = figure_12(edge * (1.0 - below));
        const auto squared = [&](double angle) {
            const double next = m.with("angle", angle).image().to[0];
            return next * next;
        };
        double low = 0.35, high = 0.38;
        for (int i = 0; i < 100; ++i) {  // golden section on the least of P^2
            const double span = 0.381966 * (high - low);
            (squared(low + span) < squared(high - span) ? high : low) +=
                squared(low + span) < squared(high - span) ? -span : span;
        }
        const double least = 0.5 * (low + high);
        EXPECT_NEAR(least, 0.363590, 2e-4);  // delta_GP of case 3
        const auto rise = [&](double h) {
            return squared(least + h) + squared(least - h) - 2 * squared(least);
        };
        EXPECT_GT(rise(1e-3), 0.0);
        EXPECT_NEAR(rise(2e-3) / rise(1e-3), 4.0, 0.02) << below;
        // the nearer the gap, the sharper the V: P there is the root of what is left of D
        EXPECT_NEAR(squared(least) / below, 8.95e-7 / 1e-6, 0.01) << below;
    }
}

}  // namespace
}  // namespace hopscotch
