// What orbits meet at their contact, and how much they stretch: turning points of gaps, impact
// speeds and finite-time exponents against closed forms and 50-digit arithmetic.
#include "analysis/orbit/finite_time_exponent.hpp"
#include "analysis/orbit/turning_points.hpp"
#include "analysis/truth/real50.hpp"
#include "kernels/contract/entry.hpp"
#include "tests/analysis/map_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hopscotch {
namespace {

using testing_maps::map_of;
using number = real50::number;

TEST(turning_points, a_throw_has_its_top_and_nothing_else) {
    const auto gap = [](double t) { return contact_gap{t * (3.0 - 0.5 * t), 3.0 - t}; };
    const phase_course course = turning_points(gap, 6.0, 1e-15);
    ASSERT_EQ(course.turning_points.size(), 1u);
    EXPECT_TRUE(course.turning_points[0].is_maximum);
    EXPECT_NEAR(course.turning_points[0].time, 3.0, 1e-15);
    EXPECT_NEAR(course.turning_points[0].gap, 4.5, 1e-15);
    EXPECT_EQ(course.first_sign, 1);
    EXPECT_EQ(course.last_sign, -1);
}

TEST(turning_points, all_of_many_oscillations_are_found) {
    // 2 + cos(400 t) on (0, 1) turns at k pi / 400
    const auto gap = [](double t) {
        return contact_gap{2.0 + std::cos(400.0 * t), -400.0 * std::sin(400.0 * t)};
    };
    const phase_course course = turning_points(gap, 1.0, 1e-15);
    ASSERT_EQ(course.turning_points.size(), 127u);  // 400 / pi = 127.3
    for (std::size_t k = 0; k < 127; ++k) {
        const turning_point& each = course.turning_points[k];
        EXPECT_NEAR(each.time, static_cast<double>(k + 1) * M_PI / 400.0, 1e-15);
        EXPECT_EQ(each.is_maximum, k % 2 == 1);
        EXPECT_NEAR(each.gap, k % 2 == 1 ? 3.0 : 1.0, 1e-14);
    }
}

TEST(turning_points, a_pair_close_together_between_any_samples_is_found) {
    // the rate (t - 0.37)^2 - e^2 is positive but between the two
    constexpr double e = 1e-4;
    const auto gap = [](double t) {
        const double s = t - 0.37;
        return contact_gap{1.0 + s * (s * s / 3.0 - e * e), s * s - e * e};
    };
    const phase_course course = turning_points(gap, 1.0, 1e-15);
    ASSERT_EQ(course.turning_points.size(), 2u);
    EXPECT_TRUE(course.turning_points[0].is_maximum);
    EXPECT_NEAR(course.turning_points[0].time, 0.37 - e, 1e-12);  // the rate's ulp over 2 e
    EXPECT_FALSE(course.turning_points[1].is_maximum);
    EXPECT_NEAR(course.turning_points[1].time, 0.37 + e, 1e-12);
}

TEST(turning_points, contact_at_the_ends_is_none_however_flat) {
    // triple zeros at both ends, as between two lossless landings; one top
    const auto gap = [](double t) {
        const double u = 1.0 - t;
        return contact_gap{t * t * t * u * u * u, 3.0 * t * t * u * u * (u - t)};
    };
    const phase_course course = turning_points(gap, 1.0, 1e-18);
    ASSERT_EQ(course.turning_points.size(), 1u);
    EXPECT_NEAR(course.turning_points[0].gap, 1.0 / 64.0, 1e-17);
}

std::vector<double> state_after(const map_point& map, const std::vector<double>& start,
                                std::uint32_t returns) {
    const return_jet jet = map.jet(start.data(), returns);
    return {jet.state, jet.state + map.n_columns()};
}

orbit_survey survey(const map_point& map, std::vector<double> start, std::uint32_t returns) {
    jet_query query;
    query.section = map.section;
    query.options = map.options.data();
    query.variant = map.variant;
    query.columns = start.data();
    query.parameters = map.parameters.data();
    query.returns = returns;
    query.max_steps = map.max_steps;
    return map.model->orbits().survey(query);
}

/// The k-th positive root of tan x = x, a lossless lift-off speed.
number lossless(int k) {
    number x = number(k) * acos(number(-1)) + number(1.5);
    for (int i = 0; i < 80; ++i) x = number(k) * acos(number(-1)) + atan(x);
    return x;
}

TEST(contact_survey, a_lossless_hop_comes_as_near_to_the_ground_as_its_closed_form_says) {
    // CPRR: from lift-off the gap is 1 + a t - t^2/2 - cos t - a sin t, symmetric about t = a where
    // tan a = a; there it is 1 + a^2/2 - (1 + a^2) cos a, a minimum for even k, a maximum for odd
    for (const double mass_ratio : {1.0, 0.25}) {
        const map_point map = map_of("passive_hopper", "liftoff", {{"mass_ratio", mass_ratio}});
        const number second = lossless(2);
        const number middle = 1 + second * second / 2 - (1 + second * second) * cos(second);
        const orbit_survey met = survey(map, {static_cast<double>(second)}, 1);
        EXPECT_EQ(met.end, outcome::ok);
        EXPECT_NEAR(met.clearance, static_cast<double>(middle) / (1.0 + mass_ratio), 1e-13);
        // it lands without an impact, but for the half ulp of its start to the power 2/3
        EXPECT_LT(met.impact_speed, 1e-8);

        const number first = lossless(1);
        const number top = 1 + first * first / 2 - (1 + first * first) * cos(first);
        const orbit_survey simple = survey(map, {static_cast<double>(first)}, 1);
        EXPECT_TRUE(std::isnan(simple.clearance));
        EXPECT_NEAR(simple.hop_height, static_cast<double>(top) / (1.0 + mass_ratio), 1e-13);
    }
}

TEST(contact_survey, clearance_height_and_impact_of_a_hop_agree_with_fifty_digits) {
    const number a = 8.5;  // sustained contact after one impact: between tan a = a and 3 pi
    const auto gap = [&](const number& t) { return 1 + a * t - t * t / 2 - cos(t) - a * sin(t); };
    const auto rate = [&](const number& t) { return a - t + sin(t) - a * cos(t); };
    const auto newton = [&](const auto& f, const auto& slope, number t) {
        for (int i = 0; i < 60; ++i) t -= f(t) / slope(t);
        return t;
    };
    const auto curvature = [&](const number& t) { return -1 + cos(t) + a * sin(t); };
    number lowest = 1000;
    number smallest_top = 1000;
    number landing = 0;
    for (int i = 1; i < 20000; ++i) {  // signs 1e-3 apart, then Newton
        const number t = number(i) / 1000;
        const number next = number(i + 1) / 1000;
        if (gap(next) < 0) {
            landing = newton(gap, rate, t);
            break;
        }
        if (rate(t) < 0 && rate(next) >= 0) {
            lowest = std::min<number>(lowest, gap(newton(rate, curvature, t)));
        } else if (rate(t) > 0 && rate(next) <= 0) {
            smallest_top = std::min<number>(smallest_top, gap(newton(rate, curvature, t)));
        }
    }
    ASSERT_LT(lowest, 1000);
    const map_point map = map_of("passive_hopper", "liftoff", {{"mass_ratio", 1.0}});
    const orbit_survey met = survey(map, {8.5}, 1);
    EXPECT_NEAR(met.clearance, static_cast<double>(lowest / 2), 1e-13);
    EXPECT_NEAR(met.hop_height, static_cast<double>(smallest_top / 2), 1e-13);
    EXPECT_NEAR(met.impact_speed, static_cast<double>(-rate(landing) / 2), 1e-13);
}

TEST(contact_survey, a_line_juggler_hits_with_the_speed_of_its_fall) {
    const map_point map = map_of("mirror_line", "apex");
    const orbit_survey met = survey(map, {0.3}, 1);
    const double gravity = map.parameters[1];
    EXPECT_NEAR(met.impact_speed, std::sqrt(2.0 * gravity * 0.3), 1e-15);
    EXPECT_TRUE(std::isnan(met.clearance));
    // after two returns the apex between them has been passed: the state after the first
    const double apex = state_after(map, {0.3}, 1)[0];
    EXPECT_NEAR(survey(map, {0.3}, 2).hop_height, apex, 1e-15);
}

TEST(contact_survey, an_orbit_on_integrated_pieces_turns_between_them_too) {
    // the valve's return ends at its maximum: the height there is the section's own column
    const map_point map = map_of("relief_valve", "maximum", {{"flow_rate", 6.0}});
    const std::vector<double> start = state_after(map, {1.0, 11.0}, 200);
    const std::vector<double> next = state_after(map, start, 1);
    const orbit_survey met = survey(map, start, 2);
    EXPECT_NEAR(met.hop_height, next[0], 1e-12 * next[0]);
}

TEST(finite_time_exponent, at_a_fixed_point_it_is_the_logarithm_of_the_multiplier) {
    // E -> a E exp(-E): E* = ln a, slope 1 - ln a
    const double gain = std::exp(1.5);
    const map_point map = map_of("raibert_pneumatic_simple", "energy", {{"gain", gain}});
    const double start = std::log(gain);
    jet_query query;
    query.section = map.section;
    query.options = map.options.data();
    query.variant = map.variant;
    query.columns = &start;
    query.parameters = map.parameters.data();
    query.returns = 20;
    EXPECT_NEAR(finite_time_exponent(map.model->orbits(), query, map.section, 1, 1), std::log(0.5),
                1e-14);
    query.returns = 0;
    EXPECT_TRUE(std::isnan(finite_time_exponent(map.model->orbits(), query, map.section, 1, 1)));
}

}  // namespace
}  // namespace hopscotch
